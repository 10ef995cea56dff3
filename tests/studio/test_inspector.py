"""The inspector: numbers of what is chosen are typed and dragged; what cannot be had is said."""

from __future__ import annotations

import json
from collections.abc import Callable

import pytest

from studio.browsing import Desk, in_browser

pytestmark = in_browser


def chosen(desk: Desk, item: int) -> None:
    desk.page.mouse.click(*desk.place(item))
    assert desk.look("[...studio.choice.ids]") == [item]


def asked(desk: Desk, name: str, value: float) -> None:
    field = desk.page.locator(f"[data-number={name}]")
    field.fill(str(value))
    field.press("Enter")


def shown(desk: Desk, name: str) -> float:
    return float(desk.page.locator(f"[data-number={name}]").input_value())


def test_undo_in_a_field_is_of_what_is_typed_then_of_the_document(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    chosen(desk, 0)
    before = shown(desk, "x")
    keys = desk.page.keyboard
    desk.page.locator("[data-number=x]").fill("310")
    keys.press("Enter")
    desk.until("Math.abs(studio.collage.pose(0).x - 310) < 0.01")
    desk.settled()
    keys.press("End")
    keys.type("77")
    for redo in ("Control+Shift+z", "Control+y"):
        keys.press(redo)
        assert shown(desk, "x") == 31077
    keys.press("Control+z")
    assert shown(desk, "x") == 310
    assert desk.look("studio.collage.state.can_undo")
    keys.press("Control+z")
    desk.until(f"Math.abs(studio.collage.pose(0).x - {before}) < 0.1")
    desk.until(f"Number(document.activeElement.value) === {before}")
    keys.press("Control+Shift+z")
    desk.until("Number(document.activeElement.value) === 310")
    keys.press("Control+z")
    desk.until(f"Number(document.activeElement.value) === {before}")
    desk.settled()


WEIGHTS = "studio.collage.items.map((item) => item.weight)"


def test_what_is_typed_is_for_what_was_chosen_then(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.rested()
    chosen(desk, 0)
    weights, names = desk.look(WEIGHTS), desk.look("studio.collage.items.map((one) => one.name)")
    keys, undo = desk.page.keyboard, desk.page.locator("#bar [data-do=undo]")
    x = desk.look("studio.collage.pose(2).x")
    for label, text in (("Weight", "5"), ("Name", "bee"), ("X of the middle", "300")):
        chosen(desk, 0)
        desk.page.get_by_label(label, exact=True).select_text()
        keys.type(text)
        desk.page.mouse.click(*desk.place(2))
        assert desk.look("[...studio.choice.ids]") == [2]
        changed = {
            "Weight": f"{WEIGHTS}[0] === 5",
            "Name": "studio.collage.items[0].name === 'bee'",
        }
        is_so = changed.get(label, "Math.abs(studio.collage.pose(0).x - 300) < 0.1")
        desk.until(is_so)
        desk.settled()
        assert desk.look(WEIGHTS)[1:] == weights[1:]
        assert desk.look("studio.collage.items.map((one) => one.name)")[1:] == names[1:]
        undo.click()
        desk.until(f"!({is_so})")
        desk.settled()
    assert desk.look("studio.collage.pose(2).x") == pytest.approx(x, abs=1e-3)
    # A colour is told once its window is left, which is another click.
    other = desk.look("studio.collage.colour(2)")
    chosen(desk, 0)
    field = desk.page.locator(".editor [type=color]")
    field.dispatch_event("click")
    desk.look(
        "(one => (one.value = '#aa2244', one.dispatchEvent(new Event('input'))))"
        "(document.querySelector('.editor [type=color]'))"
    )
    desk.page.mouse.click(*desk.place(2))
    field.dispatch_event("change")
    desk.until("studio.collage.colour(0) === '#aa2244'")
    assert desk.look("studio.collage.colour(2)") == other
    undo.click()
    desk.settled()


def test_numbers_are_typed_each_one_step_back(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    before = desk.rested()
    chosen(desk, 0)
    desk.page.locator("#canvas").focus()
    desk.page.keyboard.press("i")
    assert desk.look("document.activeElement.dataset.number") == "x"
    asked(desk, "x", 310)
    desk.until("Math.abs(studio.collage.pose(0).x - 310) < 0.01")
    desk.settled()
    asked(desk, "angle", 30)
    desk.until("Math.abs(studio.collage.pose(0).angle * 180 / Math.PI - 30) < 0.01")
    desk.settled()
    desk.picture("inspector")
    assert shown(desk, "angle") == 30
    width = shown(desk, "width")
    asked(desk, "width", 0.8 * width)
    # Free sizes are had to within a tenth.
    field = "studio.panels.items.inspector.now().width"
    desk.until(f"{field} > {0.7 * width} && {field} < {0.89 * width}")
    desk.settled()
    assert shown(desk, "height") / shown(desk, "width") == pytest.approx(
        desk.look("(([w, h]) => h / w)(studio.collage.look(studio.collage.item(0)).size)"), rel=0.01
    )
    desk.page.locator("#canvas").focus()
    for _ in range(3):
        desk.page.keyboard.press("Control+z")
    desk.until(f"JSON.stringify([...studio.collage.poses]) === {json.dumps(before)}")
    desk.settled()


def test_a_label_is_dragged_as_an_item_is(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    before = desk.rested()
    chosen(desk, 2)
    x, zoom = desk.look("[studio.collage.pose(2).x, studio.view.zoom]")
    box = desk.page.locator(".number", has=desk.page.locator("[data-number=x]")).bounding_box()
    start = (box["x"] + 10, box["y"] + 10)
    desk.page.mouse.move(*start)
    desk.page.mouse.down()
    desk.page.mouse.move(start[0] + 12, start[1], steps=4)
    assert desk.look("studio.collage.hand.get(2).pose.x") == pytest.approx(x + 12 / zoom, abs=0.1)
    desk.page.mouse.up()
    desk.settled()
    desk.page.keyboard.press("Control+z")
    desk.until(f"JSON.stringify([...studio.collage.poses]) === {json.dumps(before)}")
    desk.settled()


def test_a_place_that_cannot_be_had_is_said(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    chosen(desk, 1)
    asked(desk, "x", 0)
    toast = desk.page.locator(".toast", has_text="there is no room for it")
    toast.wait_for()
    assert "not at 0, " in toast.inner_text()
    desk.settled()
    # Keys of a field are its own.
    desk.page.locator("#bar [data-do=undo]").click()
    desk.until("!Object.keys(studio.collage.state.unmet).length")
    desk.settled()


def test_places_that_cannot_be_had_are_one_line_until_they_are_had(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    moves = ", ".join(f"{{kind: 'move', item: {k}, x: 0, y: {k}}}" for k in (1, 2, 3))
    desk.look(f"studio.connection.do({{kind: 'together', commands: [{moves}]}})")
    lines = desk.page.locator(".toast", has_text="there is no room for it")
    # It stays under the pointer, however long the rest takes.
    lines.hover()
    desk.settled()
    assert lines.count() == 1
    desk.picture("not-had")
    lines.get_by_role("button", name="And 2 more").click()
    assert desk.page.locator("#why").get_by_text("there is no room for it").count() == 3
    desk.page.keyboard.press("Escape")
    desk.page.keyboard.press("Control+z")
    desk.until("!Object.keys(studio.collage.state.unmet).length")
    lines.wait_for(state="detached")
    desk.settled()
    desk.page.keyboard.press("Control+Shift+z")
    lines.wait_for()
    desk.page.keyboard.press("Control+z")
    desk.settled()


ENDING = """async () => {
  const { tell } = await import("/static/toasts.js");
  const later = globalThis.setTimeout;
  globalThis.setTimeout = (act) => { globalThis.end = act; };
  try { tell("a line to read"); } finally { globalThis.setTimeout = later; }
}"""
"""Shows a line, whose time is over when ``end`` is called."""


def test_a_line_stays_while_pointer_or_focus_is_on_it(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    line = desk.page.locator(".toast", has_text="a line to read")
    desk.page.evaluate(ENDING)
    line.hover()
    desk.until("document.querySelector('.toast:hover')")
    desk.look("end()")
    line.get_by_role("button").focus()
    desk.page.mouse.move(300, 300)
    desk.until("!document.querySelector('.toast:hover')")
    desk.look("end()")
    assert line.count() == 1
    desk.look("document.activeElement.blur()")
    desk.look("end()")
    assert line.count() == 0


def test_what_is_chosen_is_flipped_by_a_key(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.rested()
    chosen(desk, 2)
    outline = "studio.collage.look(studio.collage.item(2)).outline"
    before = desk.look(outline)
    angle = desk.look("studio.collage.pose(2).angle")
    desk.page.keyboard.press("Shift+F")
    desk.until(f"{outline} !== {json.dumps(before)}")
    desk.settled()
    assert desk.look(f"Math.sin(studio.collage.pose(2).angle + {angle})") == pytest.approx(
        0, abs=1e-5
    )
    desk.page.keyboard.press("Shift+F")
    desk.settled()
    for _ in range(2):
        desk.page.keyboard.press("Control+z")
    desk.until(f"{outline} === {json.dumps(before)}")
    desk.settled()


def test_steps_of_a_field_are_kept_while_scenes_are_on_their_way(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    chosen(desk, 0)
    keys = desk.page.keyboard
    fields = {
        "studio.collage.items[0].weight": desk.page.get_by_label("Weight"),
        "studio.collage.pose(0).angle * 180 / Math.PI": desk.page.locator("[data-number=angle]"),
        "studio.collage.items.length": desk.page.locator("#count"),
    }
    for now, field in fields.items():
        desk.settled()
        field.fill("11")
        keys.press("Enter")
        desk.until(f"Math.abs({now} - 11) < 1e-3")
        desk.settled()
        for value in range(12, 15):
            keys.press("ArrowUp")
            assert field.input_value() == str(value)
        desk.until(f"Math.abs({now} - 14) < 1e-3")
        desk.settled()
        assert field.input_value() == "14"
