"""Several items chosen on the page are lined up and spaced evenly, each one step back."""

from __future__ import annotations

import json
from collections.abc import Callable

import pytest

from studio.browsing import Desk, in_browser

pytestmark = in_browser


def test_several_are_lined_up_by_a_button_and_by_keys(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    before = desk.rested()
    desk.page.mouse.click(*desk.place(0))
    desk.page.keyboard.down("Shift")
    desk.page.mouse.click(*desk.place(5))
    desk.page.mouse.click(*desk.place(9))
    desk.page.keyboard.up("Shift")
    assert desk.look("studio.choice.ids.size") == 3
    desk.picture("lines")
    sent = "studio.connection.count"
    count = desk.look(sent)
    desk.page.get_by_role("button", name="Align middles down").click()
    assert desk.look(sent) == count + 1
    desk.until(f"JSON.stringify([...studio.collage.poses]) !== {json.dumps(before)}")
    desk.settled()
    desk.page.locator("#canvas").focus()
    desk.page.keyboard.press("Alt+Shift+H")
    assert desk.look(sent) == count + 2
    desk.answered()
    for _ in range(2):
        desk.page.keyboard.press("Control+z")
    desk.until(f"JSON.stringify([...studio.collage.poses]) === {json.dumps(before)}")
    desk.settled()


@pytest.mark.parametrize("key", ["a", "h", "d", "w", "v", "s"])
def test_one_item_alone_is_not_lined_up(open_desk: Callable[..., Desk], key: str) -> None:
    desk = open_desk()
    desk.page.mouse.click(*desk.place(0))
    count = desk.look("studio.connection.count")
    desk.page.keyboard.press(f"Alt+{key}")
    assert desk.look("studio.connection.count") == count
    assert desk.page.locator(".lines").is_hidden()


MIDDLE = "(b => (b[0] + b[2]) / 2)(studio.collage.bounds(0))"


def test_a_drag_snaps_to_the_middle_unless_ctrl_is_held(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.rested()
    x, y = desk.place(0)
    off = desk.look(f"(300 - {MIDDLE}) * studio.view.zoom") - 3
    desk.page.mouse.move(x, y)
    desk.page.mouse.down()
    desk.page.mouse.move(x + off / 2, y)
    desk.page.mouse.move(x + off, y)
    assert desk.look(MIDDLE) == pytest.approx(300, abs=0.01)
    assert desk.look("studio.stage.snapping.guides.map(guide => guide.at)")[0] == pytest.approx(300)
    desk.page.keyboard.down("Control")
    desk.page.mouse.move(x + off, y + 1)
    assert desk.look(f"({MIDDLE} - 300) * studio.view.zoom") == pytest.approx(-3, abs=0.1)
    assert desk.look("studio.stage.snapping.guides.length") == 0
    desk.page.keyboard.up("Control")
    desk.page.keyboard.down("Shift")
    desk.page.mouse.move(x + off, y + 20)
    assert desk.look("studio.collage.target(0).y - studio.hand.began.get(0).y") == 0
    desk.page.keyboard.up("Shift")
    desk.page.keyboard.press("Escape")
    desk.page.mouse.up()
    desk.settled()
