"""The list of items: found by name, each of those that look alike, what is held marked."""

from __future__ import annotations

from collections.abc import Callable

from studio.browsing import Desk, in_browser

pytestmark = in_browser

ROWS = "[...document.querySelectorAll('.items > li .name')].map(one => one.textContent)"
CHOSEN = "[...studio.choice.ids].map(id => studio.collage.item(id).name)"


def test_items_are_found_by_name_without_a_mouse(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.locator("#canvas").focus()
    desk.page.keyboard.press("/")
    desk.page.keyboard.type("MOO")
    assert desk.look(ROWS) == ["moon"]
    assert "of 14" in desk.page.locator("#panel [role=status]").inner_text()
    desk.page.keyboard.press("ArrowDown")
    assert desk.look(CHOSEN) == ["moon"]
    first = desk.look("[...studio.choice.ids]")
    desk.page.keyboard.press("ArrowDown")
    assert desk.look(CHOSEN) == ["moon"]
    assert desk.look("[...studio.choice.ids]") != first
    desk.page.keyboard.press("Enter")
    assert set(desk.look(CHOSEN)) == {"moon"}
    assert desk.look("studio.choice.ids.size") == desk.look(
        "studio.collage.items.filter(item => item.name === 'moon').length"
    )
    # Keys are then for what was found; Escape leaves a field as it was.
    assert desk.look("document.activeElement.id") == "canvas"
    desk.page.locator("#find").fill("")
    assert desk.look(ROWS) == ["heart", "moon", "star"]
    desk.page.keyboard.type("sta")
    desk.page.keyboard.press("Escape")
    assert desk.look(ROWS) == ["heart", "moon", "star"]
    title = desk.page.locator("#title")
    name = title.input_value()
    title.press("x")
    title.press("Escape")
    assert title.input_value() == name
    assert desk.look("document.activeElement.id") == "canvas"
    assert desk.look("studio.choice.ids.size") > 1


def test_each_of_those_that_look_alike_has_a_row(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    ids = desk.look("studio.collage.items.filter(one => one.name === 'star').map(one => one.id)")
    desk.page.get_by_role("button", name="Each star").click()
    assert desk.look(ROWS)[2:] == ["star", *(f"star #{k + 1}" for k in range(len(ids)))]
    desk.page.locator("button.item", has_text="star #2").click()
    desk.page.locator("button.item", has_text="star #1").click(modifiers=["Shift"])
    assert set(desk.look("[...studio.choice.ids]")) == set(ids[:2])
    desk.page.locator("button.item", has_text="star #2").click()
    desk.page.locator("#canvas").focus()
    desk.page.keyboard.press("h")
    pin = desk.page.locator("button.item", has_text="star #2").locator(".icon")
    pin.wait_for()
    assert desk.page.locator("button.item", has_text="star #1").locator(".icon").count() == 0
    desk.picture("list")
    desk.page.keyboard.press("Control+z")
    pin.wait_for(state="detached")
