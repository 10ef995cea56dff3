"""Items grouped on the page are one item in the hand and in the list, and come apart again."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from studio.browsing import Desk, in_browser

pytestmark = in_browser

COUNT = "studio.collage.items.length"
CHOSEN = "[...studio.choice.ids]"


def test_a_group_is_made_dragged_and_taken_apart_by_keys(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.rested()
    count = desk.look(COUNT)
    desk.page.mouse.click(*desk.place(2))
    desk.page.keyboard.down("Shift")
    desk.page.mouse.click(*desk.place(7))
    desk.page.keyboard.up("Shift")
    desk.page.keyboard.press("Control+g")
    desk.until(f"{COUNT} === {count - 1} && studio.choice.ids.size === 1")
    desk.settled()
    (group,) = desk.look(CHOSEN)
    desk.picture("grouped")
    row = desk.page.get_by_role("button", name="2 items", exact=True)
    assert row.get_attribute("aria-pressed") == "true"
    before = desk.look(f"studio.collage.pose({group})")
    desk.page.keyboard.press("ArrowRight")
    desk.answered()
    after = desk.look(f"studio.collage.pose({group})")
    assert after["scale"] == pytest.approx(before["scale"], rel=0.6)
    assert after != before
    desk.page.keyboard.press("Control+Shift+g")
    desk.until(f"{COUNT} === {count} && studio.choice.ids.size === 2")
    desk.settled()
    parts = desk.look(f"{CHOSEN}.map(id => studio.collage.item(id).parts)")
    assert parts == [0, 0]
    for _ in range(3):
        desk.page.keyboard.press("Control+z")
        desk.settled()
    desk.until(f"{COUNT} === {count} && studio.collage.rows.has(2)")
