"""A seamless tile on the desk: what is dragged over an edge comes in again, seen and exported."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from studio.browsing import PHONE, Desk, Server, in_browser

pytestmark = in_browser

RIGHTMOST = "studio.collage.items.map((item, k) => [studio.collage.poses[4 * k], item.id]).sort((a, b) => b[0] - a[0])[0][1]"  # noqa: E501

ON_TORUS = """studio.collage.items.map((item, k) => {
  const [x, y] = studio.collage.poses.subarray(4 * k, 4 * k + 2);
  const [width, height, drop] = studio.collage.scene.repeat;
  const column = Math.floor(x / width);
  const down = y - column * drop;
  return [x - column * width, down - Math.floor(down / height) * height];
})"""
"""Where items are, whichever image of them is shown."""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    file = tmp_path_factory.mktemp("paper") / "paper.packwork"
    items = ["leaf", "flower", "mushroom", "bird"]
    pw.fill("page", items, count=16, tile="half-drop", effort="draft", padding="0.7%").save(file)
    made = Server(str(file)).start()
    yield made
    made.stop()


def test_what_goes_over_the_edge_comes_in_again_is_undone_and_exported(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = open_desk()
    desk.settled()
    desk.picture("tile")
    assert desk.look("studio.words.lines.refresh() ?? studio.words.lines.element.hidden")
    desk.rested()
    before = np.array(desk.look(ON_TORUS))
    number = desk.look(RIGHTMOST)
    where = desk.look(f"studio.collage.pose({number})")
    width, height = desk.look("[studio.collage.scene.width, studio.collage.scene.height]")
    # An image of it is taken, in the other column, and dragged over the right edge.
    x, y = where["x"] + width / 2, (where["y"] + height / 2) % height
    at, to = (desk.look(_on_window(one, y)) for one in (x, x + width / 3))
    desk.page.mouse.move(*at)
    desk.page.mouse.down()
    assert desk.look("[...studio.choice.ids]") == [number]
    assert desk.look(f"studio.collage.pose({number})")["x"] == pytest.approx(x, abs=0.01)
    desk.page.mouse.move(*to, steps=6)
    desk.picture("tile-dragged")
    desk.page.mouse.up()
    desk.answered()
    there = desk.look(f"studio.collage.pose({number})")
    assert 0 <= there["x"] <= width
    assert (there["x"] - x - width / 3) % (width / 2) == pytest.approx(0, abs=2)
    # As a person would take it up again, on the left, where it came in.
    assert (
        desk.look(f"(s => studio.stage.itemAt(...s))({_window(there['x'], there['y'])})") == number
    )
    desk.page.keyboard.press("Control+z")
    desk.answered()
    desk.rested()
    assert np.array(desk.look(ON_TORUS)) == pytest.approx(before, abs=1e-3)

    desk.page.keyboard.press("1")
    assert desk.page.get_by_label("Repeats").input_value() == "half-drop"
    assert desk.page.get_by_role("button", name="Edit its outline").is_hidden()
    desk.page.get_by_label("Show three by three tiles").check()
    assert desk.look("studio.view.whole.width") == 3 * width
    desk.picture("tile-preview")
    desk.page.keyboard.press("Escape")
    desk.page.keyboard.press("Shift+T")
    assert desk.look("studio.view.whole.width") == width
    with desk.page.expect_download() as waiting:
        desk.page.keyboard.press("Control+e")
        desk.page.locator("dialog.export input[value=png]").check()
        assert desk.page.locator("dialog.export input[value=dxf]").is_disabled()
        desk.page.locator("dialog.export input[name=pixels]").fill("300")
        desk.page.get_by_label("Tiles side by side").select_option("2")
        desk.until("studio.exporting.preview.naturalWidth > 0 && !studio.exporting.dialog.ariaBusy")
        desk.picture("tile-export")
        desk.page.locator("dialog.export button[type=submit]").click()
    waiting.value.save_as(tmp_path / "four.png")
    four = np.array(Image.open(tmp_path / "four.png"))
    assert np.array_equal(four, np.tile(four[:150, :150], (2, 2, 1)))


def test_keys_and_a_finger_take_an_item_over_the_edge(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.settled()
    before = np.array(desk.look(ON_TORUS))
    number = desk.look(RIGHTMOST.replace("b[0] - a[0]", "a[0] - b[0]"))
    width, height = desk.look("[studio.collage.scene.width, studio.collage.scene.height]")

    def is_on_canvas() -> bool:
        pose = desk.look(f"studio.collage.pose({number})")
        at = _window(pose["x"], pose["y"])
        is_taken = desk.look(f"(s => studio.stage.itemAt(...s))({at})") == number
        return 0 <= pose["x"] <= width and 0 <= pose["y"] <= height and is_taken

    desk.page.locator("#canvas").focus()
    desk.look(f"studio.choice.set([{number}])")
    was = desk.look(f"studio.collage.pose({number})")["x"]
    for _ in range(math.ceil(was / 8)):
        desk.page.keyboard.press("Shift+ArrowLeft")
    desk.answered()
    assert desk.look(f"studio.collage.pose({number})")["x"] > was
    assert is_on_canvas()
    desk.undo_all()
    assert np.array(desk.look(ON_TORUS)) == pytest.approx(before, abs=1e-3)

    touch = desk.page.context.new_cdp_session(desk.page)

    def finger(kind: str, *at: float) -> None:
        points = [dict(zip("xy", at, strict=True))] if at else []
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    where = desk.look(f"studio.collage.pose({number})")
    start = desk.look(_on_window(where["x"], where["y"]))
    end = desk.look(_on_window(where["x"] - width / 3, where["y"]))
    finger("touchStart", *start)
    for share in np.linspace(0.1, 1.0, 8).tolist():
        finger("touchMove", *(np.array(start) + share * np.subtract(end, start)).tolist())
    desk.until(f"studio.collage.hand.has({number})")
    finger("touchEnd")
    desk.answered()
    assert is_on_canvas()
    there = desk.look(f"studio.collage.pose({number})")
    far = (there["x"] - where["x"] + width / 3) / (width / 2)
    assert far == pytest.approx(round(far), abs=0.01)
    desk.undo_all()


def test_a_line_chooses_and_edges_draw_by_images_of_items(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.settled()
    number = desk.look(RIGHTMOST)
    where = desk.look(f"studio.collage.pose({number})")
    width, height = desk.look("[studio.collage.scene.width, studio.collage.scene.height]")
    # Round the image of it in the column before.
    x, y = where["x"] - width / 2, (where["y"] - height / 2) % height
    left, top = desk.look(_on_window(x, y))
    desk.page.keyboard.press("q")
    desk.page.mouse.move(left - 4, top - 4)
    desk.page.mouse.down()
    for corner in ((left + 4, top - 4), (left + 4, top + 4), (left - 4, top + 4)):
        desk.page.mouse.move(*corner, steps=3)
    desk.page.mouse.up()
    assert desk.look("[...studio.choice.ids]") == [number]
    boxes = desk.look(
        "(s => { s.begin(new Set()); const found = s.others; s.end(); return found; })"
        "(studio.stage.snapping)"
    )
    middles = [((a + c) / 2, (b + d) / 2) for a, b, c, d in boxes]
    box = desk.look(f"studio.collage.bounds({number})")
    off = ((box[0] + box[2]) / 2 - where["x"], (box[1] + box[3]) / 2 - where["y"])
    assert any(one == pytest.approx((x + off[0], y + off[1]), abs=1e-3) for one in middles)


ASKED_OF_ANOTHER = """(({ connection, document, panels }) => {
    const [sent, before] = [[], panels.repeating.before];
    connection.send = (message) => sent.push(message);
    studio.opened(document);
    panels.repeating.ask("");
    delete connection.send;
    panels.repeating.before = before;
    return sent[0].canvas;
})(studio)"""
"""Canvas without a repeat that is asked for just after another document was opened."""


def test_a_canvas_repeats_another_way_and_gets_its_edge_back(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    desk.settled()
    desk.page.keyboard.press("1")
    desk.page.get_by_label("Repeats").select_option("hexagon")
    desk.until("studio.collage.scene.height < studio.collage.scene.width")
    desk.settled()
    desk.picture("tile-hexagon")
    # Of another document, or another sheet, the canvas before is not this one's.
    canvas = desk.look("[studio.collage.scene.width, studio.collage.scene.height]")
    assert desk.look(ASKED_OF_ANOTHER) == "{}x{}px".format(*canvas)
    desk.page.get_by_label("Repeats").select_option("")
    desk.until("!studio.collage.scene.repeat && studio.collage.scene.kind === 'collage'")
    desk.settled()
    # The canvas is as high again as before.
    assert desk.look("studio.collage.scene.height === studio.collage.scene.width")
    desk.undo_all()
    assert desk.look("studio.collage.scene.repeat") == [300, 600, 300]
    desk.resize(PHONE)
    desk.picture("tile-phone")


def _window(x: float, y: float) -> str:
    return f"(p => [p.x, p.y])(studio.view.toScreen({x}, {y}))"


def _on_window(x: float, y: float) -> str:
    return (
        f"(([x, y], box) => [x + box.left, y + box.top])({_window(x, y)}, "
        "studio.canvas.getBoundingClientRect())"
    )
