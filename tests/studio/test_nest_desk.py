"""A nest on the desk: parts are dragged, held and turned as they may be, certified, and cut."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import ezdxf
import pytest

import packwork as pw
from studio.browsing import Desk, Server, in_browser

pytestmark = in_browser

HOOK = [(0, 0), (60, 0), (60, 15), (15, 15), (15, 45), (0, 45)]
DISC = [(15 * math.cos(k / 9), 15 * math.sin(k / 9)) for k in range(56)]


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    file = tmp_path_factory.mktemp("shop") / "sheet.packwork"
    pw.nest("300x200mm", [(HOOK, 9), (DISC, 6)], kerf=2, passes=80).save(file)
    made = Server(str(file)).start()
    yield made
    made.stop()


def test_parts_are_moved_turned_and_cut_in_true_size(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = open_desk()
    desk.picture("nest")
    assert desk.page.get_by_role("button", name="Nest anew").count() == 1
    panel = desk.page.locator("#panel")
    for name in ("Show a picture by their colours", "Like beside like", "Put them in an order"):
        assert panel.get_by_text(name).is_hidden()
    first = desk.look("studio.collage.items.find(item => item.name === 'part').id")
    scale = desk.look(f"studio.collage.pose({first}).scale")
    desk.page.mouse.click(*desk.place(first))
    assert desk.look("studio.stage.handles().map(handle => handle.kind)") == ["turn"]
    assert desk.page.locator(".editor label:has-text('Weight')").is_hidden()
    desk.page.keyboard.press("+")
    middle = desk.look("(p => [p.x, p.y + 49])(studio.view.toScreen(150, 100))")
    desk.drag(desk.place(first), middle)
    desk.settled()
    assert desk.look(f"studio.collage.pose({first}).x") == pytest.approx(150, abs=2)
    angle = desk.look(f"studio.collage.pose({first}).angle")
    desk.page.keyboard.press(".")
    desk.until(f"Math.sin(studio.collage.pose({first}).angle - {angle}) > 0.99999")
    desk.settled()
    assert desk.look(f"studio.collage.pose({first}).scale") == scale
    desk.page.keyboard.press("h")
    desk.until("studio.areHeld")
    desk.picture("nest-moved")
    with desk.page.expect_download() as waiting:
        desk.page.keyboard.press("Control+e")
        desk.page.locator("dialog.export summary >> nth=0").click()
        desk.page.locator("dialog.export input[value=dxf]").check()
        desk.page.locator("dialog.export button[type=submit]").click()
    file = tmp_path / "sheet.dxf"
    waiting.value.save_as(file)
    drawing = ezdxf.readfile(file)
    assert drawing.units == ezdxf.units.MM
    widths = [_width(line) for line in drawing.modelspace().query("LWPOLYLINE")]
    assert sum(math.isclose(width, 60, abs_tol=1e-3) for width in widths) >= 1
    assert pw.Layout.load(file).certified


def test_pouring_lays_the_nest_anew_about_what_is_held(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.keyboard.press("Control+a")
    desk.page.keyboard.press("Shift+H")
    desk.until("!studio.anyHeld")
    desk.page.keyboard.press("Escape")
    held = desk.look("studio.collage.items[0].id")
    desk.page.mouse.click(*desk.place(held))
    desk.page.keyboard.press("h")
    desk.until("studio.areHeld")
    before = desk.look("[...studio.collage.poses]")
    desk.pour(lambda: desk.page.keyboard.press("r"))
    after = desk.look("[...studio.collage.poses]")
    assert after[:4] == before[:4]
    assert after != before


def _width(line: Any) -> float:
    xs = [point[0] for point in line.get_points()]
    return max(xs) - min(xs)
