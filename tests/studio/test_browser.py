"""The studio as people use it, in a Chromium that is there; skipped where none is."""

from __future__ import annotations

import json
import math
import socket
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from studio.browsing import PHONE, WIDE, Desk, Server, as_new, in_browser, new_page

pytestmark = in_browser

TILE = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">'
    '<path fill="teal" d="M0 0h9v4H5v5H0z"/></svg>'
)


CORNER, TURN = 2, 4
"""Handles of what is chosen: one of its corners, and what turns it."""

MENU_IS_OPEN = "document.querySelector('[role=menu]').matches(':popover-open')"


def test_a_drag_is_followed_settles_and_is_undone(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.picture("laid")
    before = desk.look("[...studio.collage.poses]")
    start = desk.place(0)
    middle = desk.look("[studio.view.toScreen(300, 300).x, studio.view.toScreen(300, 300).y + 49]")
    desk.page.mouse.move(*start)
    desk.page.mouse.down()
    desk.page.mouse.move(*middle, steps=8)
    desk.until("studio.collage.state.moving")
    desk.picture("dragged")
    desk.page.mouse.up()
    desk.settled()
    desk.picture("dropped")
    assert desk.look("[...studio.choice.ids]") == [0]
    assert desk.look("[...studio.collage.poses]") != before
    desk.page.keyboard.press("Control+z")
    was = json.dumps(before, separators=(",", ":"))
    desk.until(f"JSON.stringify([...studio.collage.poses]) === {json.dumps(was)}")
    desk.page.keyboard.press("Control+Shift+z")
    desk.settled()


def test_each_move_of_the_pointer_is_told_at_once(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    x, y = desk.place(0)
    desk.page.mouse.move(x, y)
    desk.page.mouse.down()
    told = desk.page.evaluate(
        "([x, y]) => { const { connection, canvas } = studio, told = [];"
        " connection.send = (message) => told.push(message.command?.kind);"
        " for (const clientX of [x + 10, x + 20, x + 30]) canvas.dispatchEvent(new PointerEvent("
        "'pointermove', { clientX, clientY: y, pointerId: 1, pointerType: 'mouse' }));"
        " delete connection.send; return told; }",
        [x, y],
    )
    desk.page.keyboard.press("Escape")
    desk.page.mouse.up()
    desk.settled()
    assert told == ["grab", "move", "move", "move"]


def test_the_badge_has_two_states_and_no_more(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.certified()
    desk.look(
        "(badge => new MutationObserver(() => {"
        " const now = `${badge.dataset.is}: ${badge.querySelector('.word').textContent}`;"
        " if (now !== log.at(-1)) log.push(now);"
        " }).observe(badge, {attributes: true, subtree: true, childList: true}))"
        "(document.getElementById('badge'), globalThis.log = [])"
    )
    desk.drag(desk.place(0), desk.place(3))
    desk.certified()
    # What is won back while nobody touches anything is no work.
    desk.settled()
    log = desk.look("log")
    # Where a hand is slow, all may rest on its way too; nothing else is ever said.
    assert [one.partition(": ")[0] for one in log] == ["working", "certified"] * (len(log) // 2)
    assert log[-2] == "working: making room"
    # Whether there is a hint is said with it, not later.
    assert log[-1].startswith("certified: covered · certified"), log
    # Nor what was missed: it comes and goes while gaps are closed, and is told after that.
    told = "document.querySelector('#badge .word').textContent"
    missed = "studio.stated({ ...studio.collage.state, polishing: %s, unmet: { 0: 'is off' } })"
    desk.look(missed % "true")
    assert "not as asked" not in desk.look(told)
    desk.look(missed % "false")
    assert "1 not as asked" in desk.look(told)
    desk.look("studio.stated({ ...studio.collage.state, unmet: {} })")
    desk.page.keyboard.press("Control+z")
    desk.settled()


def test_escape_in_a_drag_takes_back_that_drag_alone(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    poses = "JSON.stringify([...studio.collage.poses])"
    first = desk.rested()
    desk.drag(desk.place(0), desk.place(3))
    desk.settled()
    before = desk.rested()
    assert before != first
    desk.page.mouse.move(*desk.place(5))
    desk.page.mouse.down()
    desk.page.mouse.move(*desk.place(2), steps=8)
    desk.until(f"{poses} !== {json.dumps(before)}")
    desk.page.keyboard.press("Escape")
    desk.page.mouse.up()
    desk.until("studio.collage.hand.size === 0")
    desk.settled()
    assert desk.look(poses) == before
    desk.page.keyboard.press("Control+z")
    desk.until(f"{poses} === {json.dumps(first)}")
    desk.settled()


def test_a_reload_lets_go_of_what_is_dragged(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.mouse.move(*desk.place(0))
    desk.page.mouse.down()
    desk.page.mouse.move(*desk.place(3), steps=4)
    desk.page.reload()
    desk.settled()
    desk.page.mouse.up()
    before = desk.look("studio.collage.pose(1).x")
    desk.drag(desk.place(1), desk.place(4))
    desk.settled()
    assert desk.look("studio.collage.pose(1).x") != before
    assert desk.page.locator(".toast.error").count() == 0
    for _ in range(2):
        desk.page.keyboard.press("Control+z")
    desk.settled()


SIDE = """(isFit => { const { stage, choice } = studio, frame = stage.frame();
 for (let k = 0; k < 4; k++) for (let t = 0.2; t < 0.8; t += 0.005) {
  const [from, to, inner] = [0, 1, 3].map((step) => frame[(k + step) % 4]);
  const [dx, dy] = [inner[0] - from[0], inner[1] - from[1]], in2 = 2 / Math.hypot(dx, dy);
  const x = from[0] + t * (to[0] - from[0]) + in2 * dx;
  const y = from[1] + t * (to[1] - from[1]) + in2 * dy;
  const id = stage.itemAt(x, y, 1), top = studio.canvas.getBoundingClientRect().top;
  const isFar = stage.handles().every(({ at }) => Math.hypot(at[0] - x, at[1] - y) > 10);
  const near = stage.itemAt(x, y);
  if (isFar && isFit(id, choice, near)) return [x, y + top, near]; } })"""
"""A place on the window just within a side of the frame, by the item that lies there and the one
that lies there or near; and this one."""


def test_handles_turn_and_scale(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.mouse.click(*desk.place(1))
    assert desk.look("[...studio.choice.ids]") == [1]
    desk.take_handle(TURN, 1)
    # A quarter turn about where it is when it is taken.
    about = desk.look("studio.gestures.doing.about")
    start = desk.look("studio.gestures.doing.from")
    top = desk.look("studio.canvas.getBoundingClientRect().top")
    across, along = start["x"] - about["x"], start["y"] - about["y"]
    desk.page.mouse.move(about["x"] - along, about["y"] + across + top, steps=8)
    began = desk.look("studio.hand.began.get(1).angle")
    turned = desk.look("studio.hand.held(1).angle")
    assert math.remainder(turned - began - math.pi / 2, math.tau) == pytest.approx(0, abs=0.05)
    desk.page.mouse.up()
    desk.settled()
    # What the hand has turned stays turned, also when neighbours win back what was lost.
    assert math.remainder(desk.look("studio.collage.pose(1).angle") - turned, math.tau) == (
        pytest.approx(0, abs=1e-4)
    )
    desk.take_handle(CORNER, 1)
    about, start = desk.look("studio.gestures.doing.about"), desk.look("studio.gestures.doing.from")
    scale = desk.look("studio.collage.pose(1).scale")
    x, y = (about[axis] + 0.6 * (start[axis] - about[axis]) for axis in "xy")
    desk.page.mouse.move(x, y + top, steps=8)
    desk.page.mouse.up()
    desk.settled()
    assert desk.look("studio.collage.pose(1).scale") < 0.85 * scale
    # A side of the frame does so too, of an item that leaves one free; a finger there drags.
    item, (x, y, _) = desk.look(
        f"(side => studio.collage.items.map(({{ id }}) => studio.choice.set([id]) ?? [id, side()])"
        f".find(([, at]) => at))(() => {SIDE}((id, choice) => id === null || choice.has(id)))"
    )
    desk.look(f"studio.choice.set([{item}])")
    assert desk.look(f"studio.stage.handleAt({x}, {y - top}, 11)") is None
    scale = desk.look(f"studio.collage.pose({item}).scale")
    desk.page.mouse.move(x, y)
    desk.page.mouse.down()
    assert desk.look("studio.gestures.doing.act") == "scale"
    about = desk.look("studio.gestures.doing.about")
    x, y = (about[axis] + 0.6 * (at - about[axis]) for at, axis in ((x, "x"), (y - top, "y")))
    desk.page.mouse.move(x, y + top, steps=8)
    desk.page.mouse.up()
    desk.settled()
    assert desk.look(f"studio.collage.pose({item}).scale") < 0.85 * scale
    for _ in range(3):
        desk.page.keyboard.press("Control+z")
    desk.settled()


def test_a_side_of_the_frame_keeps_no_item_from_being_chosen(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    mouse, chosen, doing = desk.page.mouse, "[...studio.choice.ids]", "studio.gestures.doing"
    desk.look("studio.choice.set([0, 3])")
    x, y, other = desk.look(f"{SIDE}((id, choice) => id !== null && !choice.has(id))")
    desk.page.keyboard.down("Shift")
    mouse.click(x, y)
    desk.page.keyboard.up("Shift")
    assert desk.look(chosen) == [0, 3, other]
    desk.look("studio.choice.set([0, 3])")
    # What drags there drags that item.
    mouse.move(x, y)
    mouse.down()
    assert (desk.look(f"{doing}.act"), desk.look(chosen)) == ("item", [other])
    mouse.up()
    # Between items it is a handle, and a click is for what lies nearest.
    desk.look("studio.choice.set([0, 3])")
    x, y, near = desk.look(f"{SIDE}((id, choice, near) => id === null && near !== null)")
    mouse.move(x, y)
    mouse.down()
    assert desk.look(f"{doing}.act") == "scale"
    mouse.up()
    assert desk.look(chosen) == [near]
    desk.look("studio.choice.set([])")


def test_the_canvas_is_finished_where_it_is_zoomed_while_gaps_are_closed(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    desk.until("studio.stage.backdrop.picture")
    desk.look("(state => { state.polishing = true; })(studio.collage.state)")
    desk.look("studio.view.zoomAt(1.5, 700, 400)")
    desk.until("studio.stage.backdrop.key[0] === studio.view.zoom")
    desk.until("studio.stage.backdrop.picture")
    desk.look("(state => { state.polishing = false; })(studio.collage.state)")
    desk.look("studio.view.refit()")


def test_the_keyboard_alone_chooses_moves_holds_and_exports(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    keys = desk.page.keyboard
    keys.press("n")
    keys.press("n")
    assert desk.look("studio.choice.ids.size") == 1
    keys.press("ArrowRight")
    desk.answered()
    keys.press("h")
    desk.until("studio.areHeld")
    desk.picture("held")
    keys.press("Shift+H")
    desk.until("!studio.anyHeld")
    count = desk.look("studio.collage.items.length")
    keys.press("d")
    desk.until(f"studio.collage.items.length === {count + 1}")
    desk.settled()
    keys.press("?")
    keys.type("choose all")
    desk.picture("palette")
    keys.press("Enter")
    desk.until(f"studio.choice.ids.size === {count + 1}")
    keys.press("Escape")
    assert desk.look("studio.choice.ids.size") == 0
    for _ in range(3):
        keys.press("Control+z")
    desk.settled()


BEGINS = {
    "svg": b"<?xml",
    "pdf": b"%PDF",
    "png": b"\x89PNG",
    "geojson": b"{",
    "packwork": b"PK",
}


def test_exports_are_files(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    for kind, begin in BEGINS.items():
        desk.page.keyboard.press("Control+e")
        desk.until("document.querySelector('dialog.export').open")
        if not desk.look("document.querySelector('dialog.export summary').parentElement.open"):
            desk.page.locator("dialog.export summary >> nth=0").click()
        desk.page.locator(f"dialog.export input[value={kind}]").check()
        desk.picture("export")
        with desk.page.expect_download() as waiting:
            desk.page.locator("dialog.export button[type=submit]").click()
        assert Path(waiting.value.path()).read_bytes().startswith(begin)
        assert waiting.value.suggested_filename.endswith(f".{kind}")
        desk.until("!document.querySelector('dialog.export').open")


def test_any_colour_behind_an_export_can_be_typed_on_a_phone(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk(PHONE, color_scheme="dark")
    # F6 goes round all parts, past what is not shown.
    desk.look("studio.canvas.focus()")
    seen = []
    for _ in range(4):
        desk.page.keyboard.press("F6")
        seen.append(desk.look("document.activeElement.closest('#canvas, #bar, #tabs, #foot').id"))
    assert sorted(seen) == ["bar", "canvas", "foot", "tabs"]
    desk.page.keyboard.press("Control+e")
    field = desk.page.locator("dialog.export input[name=background]")
    field.wait_for()
    assert field.bounding_box()["width"] > 100
    desk.picture("export-phone")


def test_an_export_is_shown_as_it_will_be(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.settled()
    desk.page.keyboard.press("Control+e")
    corner = """(() => {
        const image = studio.exporting.preview, made = document.createElement("canvas");
        if (!image.complete || !image.naturalWidth) return null;
        [made.width, made.height] = [image.naturalWidth, image.naturalHeight];
        const drawn = made.getContext("2d");
        drawn.drawImage(image, 0, 0);
        return [...drawn.getImageData(2, made.height - 3, 1, 1).data].join(" ");
    })()"""
    desk.until(f"{corner} === '0 0 0 0'")
    desk.page.locator("dialog.export input[value=png]").check()
    desk.until(f"{corner} === '255 255 255 255'")
    desk.page.get_by_label("Black").click()
    desk.until(f"{corner} === '23 23 23 255'")
    desk.page.get_by_label("Transparent").click()
    desk.until(f"{corner} === '0 0 0 0'")
    desk.page.get_by_label("Size by name").select_option("A5, 300 dpi")
    desk.page.get_by_label("Free edge").select_option("5%")
    with desk.page.expect_download() as waiting:
        desk.page.locator("dialog.export button[type=submit]").click()
    with Image.open(waiting.value.path()) as made:
        assert max(made.size) == 2480
        assert made.getpixel((2, made.height - 3))[3] == 0
        left, top, right, bottom = made.getbbox()
        edge = 0.05 / 1.1 * 2480
        assert min(left, top, made.width - right, made.height - bottom) > 0.98 * edge
        assert min(left, top, made.width - right, made.height - bottom) < 1.2 * edge
    # The next time nothing is shown until it is what is exported then, and nothing is kept.
    assert desk.look(
        "(revoke => { const { preview } = studio.exporting, was = preview.src; let gone;"
        " URL.revokeObjectURL = (one) => { gone = one; revoke.call(URL, one); };"
        " studio.exporting.open(); URL.revokeObjectURL = revoke;"
        " return was.startsWith('blob:') && gone === was && !preview.hasAttribute('src'); })"
        "(URL.revokeObjectURL)"
    )


def test_files_are_brought_and_what_fails_is_a_line(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = open_desk()
    count = desk.look("studio.collage.items.length")
    (tmp_path / "tile.svg").write_text(TILE, encoding="utf-8")
    (tmp_path / "broken.svg").write_text("<svg", encoding="utf-8")
    desk.page.locator("input[type=file]").first.set_input_files(
        [tmp_path / "tile.svg", tmp_path / "broken.svg"]
    )
    desk.until(f"studio.collage.items.length === {count + 1}")
    assert desk.look("studio.collage.items.at(-1).name") == "tile"
    toast = desk.page.locator(".toast", has_text="broken.svg")
    toast.wait_for()
    text = toast.inner_text()
    assert "/" not in text.replace("left out", "")
    desk.picture("brought")
    desk.settled()
    desk.page.keyboard.press("Control+z")
    desk.until(f"studio.collage.items.length === {count}")
    desk.settled()


def test_files_in_place_of_the_items_keep_the_container_full(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = open_desk()
    count = desk.look("studio.collage.items.length")
    for name in ("tile", "slab"):
        (tmp_path / f"{name}.svg").write_text(TILE, encoding="utf-8")
    desk.page.locator("select[aria-label='What files do']").select_option("items")
    with desk.page.expect_file_chooser() as waiting:
        desk.page.get_by_text("Choose files").click()
    waiting.value.set_files([tmp_path / "tile.svg", tmp_path / "slab.svg"])
    desk.until("studio.collage.items.every(item => ['tile', 'slab'].includes(item.name))")
    desk.settled()
    assert desk.look("studio.collage.items.length") == count
    desk.page.keyboard.press("Control+z")
    desk.until("studio.collage.items.some(item => item.name === 'star')")
    desk.settled()


def test_escape_closes_the_menu_and_leaves_what_is_chosen(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    x, y = desk.place(desk.look("studio.collage.items[0].id"))
    desk.page.mouse.click(x, y)
    desk.page.mouse.click(x, y, button="right")
    desk.until(MENU_IS_OPEN)
    desk.page.keyboard.press("Escape")
    desk.until(f"!{MENU_IS_OPEN}")
    assert desk.look("studio.choice.ids.size") == 1
    desk.page.mouse.click(x, y, button="right")
    desk.page.keyboard.press("h")
    desk.until("studio.collage.items[0].held[0]")
    assert not desk.look(MENU_IS_OPEN)
    desk.page.keyboard.press("Control+z")
    desk.until("!studio.collage.items[0].held[0]")
    desk.settled()


def test_a_finger_that_stays_has_the_menu_and_one_on_what_is_small_drags_it(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk(PHONE)
    desk.page.keyboard.press("Escape")
    touch = desk.page.context.new_cdp_session(desk.page)

    def finger(kind: str, *points: tuple[float, float]) -> None:
        at = [{"x": x, "y": y} for x, y in points]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})

    number = desk.look("studio.collage.items[0].id")
    x, y = desk.place(number)
    sent = desk.look("studio.connection.count")
    finger("touchStart", (x, y))
    desk.until(MENU_IS_OPEN)
    finger("touchEnd")
    desk.page.wait_for_timeout(100)
    # What lies under the finger that asked for it is not pressed.
    assert desk.look(MENU_IS_OPEN)
    assert desk.look("studio.connection.count") == sent
    desk.page.keyboard.press("Escape")
    desk.look(f"studio.choice.set([{number}])")
    # Its handles are all within a finger's reach.
    desk.look("studio.view.zoomAt(0.2, 195, 400)")
    x, y = desk.place(number)
    finger("touchStart", (x, y))
    finger("touchMove", (x + 12, y))
    assert desk.look("studio.gestures.doing.act") == "item"
    finger("touchEnd")
    desk.answered()
    desk.page.keyboard.press("Control+z")
    desk.answered()


def test_the_menu_stays_when_the_button_is_let_go_and_closes_at_the_next_press(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    x, y = desk.place(desk.look("studio.collage.items[0].id"))
    desk.page.mouse.move(x, y)
    desk.page.mouse.down(button="right")
    # Browsers ask for it at the press or at the letting go, by the system.
    desk.page.evaluate(
        "at => studio.canvas.dispatchEvent(new MouseEvent('contextmenu', at))",
        {"clientX": x, "clientY": y, "button": 2, "bubbles": True},
    )
    assert desk.look(MENU_IS_OPEN)
    desk.page.mouse.up(button="right")
    desk.page.wait_for_timeout(50)
    assert desk.look(MENU_IS_OPEN)
    # Some browsers close one of "auto" at the letting go, others leave it.
    assert desk.look("document.querySelector('[role=menu]').popover") == "manual"
    desk.page.mouse.click(20, 400)
    assert not desk.look(MENU_IS_OPEN)


def test_another_container_is_chosen_by_its_picture(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.locator("#tab-room").click()
    desk.page.locator(".grid [aria-label=cat]").click()
    desk.until("studio.collage.scene.name === 'cat'")
    desk.settled()
    desk.picture("container")
    desk.page.keyboard.press("Control+z")
    desk.until("studio.collage.scene.name === 'circle'")
    desk.settled()


def test_words_of_two_scripts_fill_it_and_undo_brings_the_old_back(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    count = desk.look("studio.collage.items.length")
    desk.page.locator("#tab-words").click()
    desk.page.locator("#text").fill("Straße, 9\nسلام, 7\nGarten, 5\nhope, 3")
    desk.page.get_by_text("Fill with words").click()
    desk.until("studio.collage.items.some(item => item.name === 'Straße')")
    desk.settled()
    names = set(desk.look("studio.collage.items.map(item => item.name)"))
    assert names == {"Straße", "سلام", "Garten", "hope"}
    desk.picture("words")
    desk.page.locator("#canvas").click(position={"x": 1420, "y": 820})
    desk.page.keyboard.press("Control+z")
    desk.until(f"studio.collage.items.length === {count}")
    desk.settled()


def test_one_of_six_others_is_taken(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    before = desk.look("[...studio.collage.poses]")
    desk.page.locator("#tab-more").click()
    desk.page.get_by_text("Try six others").click()
    desk.until("studio.variants.found.length === 6")
    desk.picture("more")
    desk.page.locator(".variants .choice").nth(2).click()
    was = json.dumps(before, separators=(",", ":"))
    desk.until(f"JSON.stringify([...studio.collage.poses]) !== {json.dumps(was)}")
    desk.settled()
    desk.page.locator("#tab-options").click()
    desk.page.locator("#panel select").first.select_option("shared")
    desk.until("studio.collage.scene.options.sizes === 'shared'")
    desk.picture("options")
    for _ in range(2):
        desk.page.keyboard.press("Control+z")
    desk.until("studio.collage.scene.options.sizes === 'free'")
    desk.settled()


def test_a_reload_and_a_second_page_show_the_same(open_desk: Callable[..., Desk]) -> None:
    desk, other = open_desk(), open_desk(PHONE)
    desk.page.keyboard.press("n")
    desk.page.keyboard.press("h")
    other.until("studio.collage.items.some(item => item.held[0])")
    desk.page.reload()
    desk.settled()
    assert desk.look("studio.collage.items.some(item => item.held[0])")
    assert desk.look("studio.collage.state.can_undo")
    desk.page.keyboard.press("Control+z")
    other.until("!studio.collage.items.some(item => item.held[0])")


def test_a_turn_of_the_wheel_zooms_a_little_with_ctrl_too(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.mouse.move(*desk.place(0))
    for key, delta in ((None, -100), ("Control", -120), ("Control", -1200)):
        before = desk.look("studio.view.zoom")
        if key:
            desk.page.keyboard.down(key)
        desk.page.mouse.wheel(0, delta)
        desk.until(f"studio.view.zoom > {before}")
        assert desk.look("studio.view.zoom") < 1.4 * before
        if key:
            desk.page.keyboard.up(key)


def test_options_follow_what_is_undone(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.locator("#tab-options").click()
    slider = desk.page.locator("#ask-padding")
    before = slider.input_value()
    slider.fill("4")
    desk.until("studio.collage.scene.options.padding === 4")
    desk.settled()
    desk.page.locator("#ask-sizes").select_option("shared")
    desk.until("studio.collage.scene.options.sizes === 'shared'")
    desk.settled()
    desk.page.locator("#canvas").focus()
    for _ in range(2):
        desk.page.keyboard.press("Control+z")
    desk.until("document.querySelector('#ask-sizes').value === 'free'")
    desk.until(f"document.querySelector('#ask-padding').value === '{before}'")
    assert desk.page.locator("label[for=ask-padding] output").inner_text().startswith(before)
    desk.settled()


def test_the_list_of_items_stays_while_the_hand_is_on_the_canvas(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk({"width": 1440, "height": 460})
    scroll = "document.querySelector('#panel .body').scrollTop"
    desk.page.mouse.move(*desk.place(2))
    desk.page.mouse.down()
    desk.until("studio.choice.ids.has(2)")
    assert desk.look(scroll) == 0
    desk.page.mouse.up()
    desk.until(f"{scroll} > 0")


def test_what_a_finger_meets_is_large_enough(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk(PHONE, has_touch=True, is_mobile=True)
    for panel in ("room", "items", "words", "options", "more", "look"):
        desk.page.locator(f"#tab-{panel}").tap()
        desk.until(
            f"document.getElementById('tab-{panel}').ariaPressed === 'true'"
            " && document.querySelector('#panel .body').children.length > 0"
        )
        small = desk.look(
            "[...document.querySelectorAll('button, input:not([type=checkbox], .unseen), select')]"
            ".filter(e => e.checkVisibility() && e.getBoundingClientRect().height < 44)"
            ".map(e => e.outerHTML)"
        )
        assert small == []
        assert desk.look(
            "(body => body.scrollWidth <= body.clientWidth)(document.querySelector('#panel .body'))"
        )


def test_a_finger_names_the_document(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk(PHONE, has_touch=True, is_mobile=True)
    desk.page.on("dialog", lambda asked: asked.accept("of my own"))
    desk.page.locator("#files").tap()
    desk.page.get_by_role("menuitem", name="Rename").tap()
    desk.until("studio.collage.scene.title === 'of my own'")
    desk.undo_all()


@pytest.mark.parametrize("size", [PHONE, {"width": 1024, "height": 768}], ids=["phone", "tablet"])
def test_nothing_reaches_out_of_the_window(
    open_desk: Callable[..., Desk], size: dict[str, int]
) -> None:
    desk = open_desk(size, has_touch=size is PHONE)
    for scheme in ("light", "dark"):
        desk.page.emulate_media(color_scheme=scheme)
        desk.picture(f"{size['width']}-{scheme}")
        assert desk.look("document.documentElement.scrollWidth <= innerWidth")
        assert desk.look(
            "[...document.querySelectorAll('#bar button, #tabs button, #badge')]"
            ".filter(b => b.offsetParent).every(b => { const r = b.getBoundingClientRect();"
            " return r.left >= 0 && r.right <= innerWidth && r.bottom <= innerHeight; })"
        )


def test_every_button_and_field_has_a_name(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    for panel in ("room", "items", "words", "options", "more", "look"):
        if desk.look(f"document.getElementById('tab-{panel}').ariaPressed") != "true":
            desk.page.locator(f"#tab-{panel}").click()
        desk.until("studio.panels.choices !== null")
        nameless = desk.look(
            "[...document.querySelectorAll('button, input, select, textarea')].filter(e =>"
            " !(e.ariaLabel || e.textContent.trim() || e.labels?.length || e.ariaHidden))"
            ".map(e => e.outerHTML)"
        )
        assert nameless == []


def test_a_page_that_does_not_know_the_token_sees_nothing(browser: Any, server: Server) -> None:
    page = browser.new_page()
    page.goto(server.address.partition("#")[0])
    page.locator("#outage", has_text="Open the address").wait_for()
    assert page.evaluate("() => studio.collage.scene === null && !studio.connection.isOpen")
    assert page.locator("#badge").inner_text().endswith("not connected")
    page.close()


def test_a_page_goes_on_by_itself_after_a_crash(
    browser: Any, tmp_path: Path, monkeypatch: Any
) -> None:
    """At a port that was asked for; that it does at any other is shown with proofs."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = ("--port", str(probe.getsockname()[1]))
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    first = Server("circle", "star", "-n", "6", *port).start()
    context = browser.new_context(viewport=WIDE)
    second = Server("--again", *port)
    try:
        desk = Desk(context.new_page(), first.address)
        desk.settled()
        desk.until("studio.collage.state.saved")
        desk.page.keyboard.press("n")
        # What was only just moved is settled by the server that comes after.
        desk.page.keyboard.press("ArrowRight")
        desk.answered()
        desk.page.keyboard.press("h")
        desk.until("studio.areHeld")
        first.kill()
        desk.until("!studio.connection.isOpen")
        desk.page.locator("#outage", has_text="packwork studio --again").wait_for()
        desk.picture("stopped")
        second.start()
        assert second.port == first.port
        assert second.address != first.address
        desk.until("studio.connection.isOpen")
        desk.settled()
        assert not desk.page.locator("#outage").is_visible()
        assert desk.look("location.href") == second.address
        assert desk.look("studio.collage.items.filter(item => item.held[0]).length") == 1
        assert desk.look("studio.collage.state.can_undo")
        assert desk.faults == []
    finally:
        first.stop()
        second.stop()
        context.close()


def test_items_show_a_picture_by_their_colours(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = open_desk()
    halves = Image.new("RGB", (40, 40), "#101090")
    halves.paste("#f0c000", (0, 20, 40, 40))
    halves.save(tmp_path / "halves.png")
    Image.new("RGB", (40, 40), "#808080").save(tmp_path / "plain.png")

    def show(name: str) -> None:
        with desk.page.expect_file_chooser() as waiting:
            desk.page.get_by_text("Show a picture by their colours").click()
        waiting.value.set_files(tmp_path / name)

    colours = "JSON.stringify(studio.collage.items.map(item => studio.collage.colour(item.id)))"
    before = desk.look(colours)
    show("plain.png")
    toast = desk.page.locator(".toast", has_text="one colour only")
    toast.wait_for()
    toast.get_by_role("button").first.click()
    show("halves.png")
    desk.until(f"{colours} !== {json.dumps(before)}")
    desk.settled()
    blues = desk.look(
        "studio.collage.items.map(item => [studio.collage.pose(item.id).y,"
        " parseInt((studio.collage.colour(item.id) ?? '#808080').slice(5, 7), 16)])"
    )
    middle = sum(y for y, _ in blues) / len(blues)
    upper = [blue for y, blue in blues if y < middle]
    lower = [blue for y, blue in blues if y > middle]
    assert sum(upper) / len(upper) > sum(lower) / len(lower) + 60
    desk.picture("mosaic")
    desk.page.keyboard.press("Control+z")
    desk.until(f"{colours} === {json.dumps(before)}")
    desk.settled()


def test_items_are_put_in_an_order_and_by_a_table(
    open_desk: Callable[..., Desk], tmp_path: Path
) -> None:
    desk = open_desk()
    names = sorted(set(desk.look("studio.collage.items.map(item => item.name)")))
    table = tmp_path / "vectors.csv"
    rows = [f"{name},{int(k % 2 == 0)},{int(k % 2)}" for k, name in enumerate(names)]
    table.write_text("\n".join(rows), encoding="utf-8")

    def is_left(one: str, other: str) -> str:
        """Whether things of one name lie to the left of those of another, on the average."""
        middle = (
            "(items => items.reduce((sum, i) => sum + studio.collage.pose(i.id).x, 0)"
            " / items.length)(studio.collage.items.filter(i => i.name === '{}'))"
        )
        return f"{middle.format(one)} < {middle.format(other)}"

    first, last = names[0], names[-1]
    # As they do not lie now.
    if desk.look(is_left(first, last)):
        way, ordered = "left", is_left(last, first)
    else:
        way, ordered = "right", is_left(first, last)
    desk.page.keyboard.press("o")
    desk.page.get_by_label("By what").select_option("name")
    desk.page.get_by_label("Which way").select_option(way)
    desk.page.get_by_text("Put in order", exact=True).click()
    desk.until(f"!studio.collage.state.busy && studio.collage.state.certified && {ordered}")
    desk.settled()
    desk.picture("ordered")
    with desk.page.expect_file_chooser() as waiting:
        desk.page.get_by_text("Like beside like, by a table").click()
    desk.pour(lambda: waiting.value.set_files(table))
    desk.picture("alike")


def test_what_is_drawn_anew_while_dragging_is_all_that_has_changed(browser: Any) -> None:
    server, context = (
        Server("heart", "builtin:icons", "-n", "24"),
        browser.new_context(viewport=WIDE),
    )
    try:
        desk = Desk(context.new_page(), server.start().address)
        desk.settled()
        desk.look("studio.connection.do({ kind: 'halos', choice: 'all' })")
        desk.answered()
        desk.look(_WATCH)
        start, end = desk.place(0), desk.place(12)
        desk.page.mouse.move(*start)
        desk.page.mouse.down()
        for step in range(1, 17):
            drawn, share = desk.look("seen.frames"), step / 16
            desk.page.mouse.move(*(a + share * (b - a) for a, b in zip(start, end, strict=True)))
            desk.until(f"seen.frames > {drawn}")
        off, was_partial = desk.look(_OFF % ("true", "true", 90))
        desk.page.mouse.up()
        desk.settled()
        assert was_partial
        assert off < 1e-3
        assert desk.look("seen.amiss") == []
        # At rest it is the same to the last shade.
        desk.until("!studio.stage.backdrop.loose.includes(1)")
        assert desk.look(_OFF % ("false", "false", 0)) == [0, False]
    finally:
        context.close()
        server.stop()


_WATCH = (
    "(() => { const { stage, collage, view } = studio, { backdrop } = stage;"
    " globalThis.seen = { frames: 0, amiss: [] }; const found = new Set();"
    " const [draw, drawItem] = [stage.draw.bind(stage), stage.drawItem.bind(stage)];"
    " stage.drawItem = (k, ...more) => { found.add(k); drawItem(k, ...more); };"
    " stage.draw = (isMoving) => { found.clear(); const isLast = draw(isMoving); seen.frames++;"
    " const isOff = (k) => [0, 1].some((axis) => view.zoom * Math.abs("
    "backdrop.drawn[4 * k + axis] - collage.shown[4 * k + axis]) > 0.25);"
    " for (const k of collage.items.keys()) if (!backdrop.picture || backdrop.loose[k]"
    " ? !found.has(k) : isOff(k)) seen.amiss.push([seen.frames, k]); return isLast; }; })()"
)
"""Notes each picture in which an item is missing, or lies still elsewhere than it is."""


_OFF = (
    "(() => { const { stage, canvas } = studio; const seen = () => stage.pen.getImageData(0, 0,"
    " canvas.width, canvas.height).data; stage.draw(%s); const now = seen();"
    " const { regions } = stage.backdrop; stage.backdrop.key = []; for (const _ of [1, 2])"
    " stage.draw(%s); const anew = seen(); return [now.filter((value, k) => Math.abs(value -"
    " anew[k]) > %d).length / now.length, regions !== null]; })()"
)
"""Share of what is seen that is another once all is drawn anew; whether only parts had been."""


def test_items_that_are_stretched_or_have_rims_are_drawn_and_found_to_their_ends(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    # A drag takes some out of the picture of what lies still, which is compared with a whole one.
    far, parts, found = desk.look(
        "(() => { const { stage, collage, view } = studio, { backdrop } = stage;"
        " const { width, height } = stage.canvas; const seen = () => backdrop.picture.getContext("
        "'2d').getImageData(0, 0, width, height).data;"
        " const rim = collage.scene.rim; collage.scene.rim = 12; for (const item of collage.items)"
        " [item.stretch, item.halo] = [item.id % 2 ? 16 : 1 / 16, '#d00000'];"
        " backdrop.key = []; for (const _ of [1, 2]) stage.draw(); collage.shown[0] += 30;"
        " stage.draw(true); const now = seen(), parts = backdrop.regions?.length ?? 0;"
        " backdrop.regions = null; stage.drawBackdrop(width, height); const anew = seen();"
        " const far = now.reduce((most, value, k) => Math.max(most, Math.abs(value - anew[k])), 0);"
        " const [x, y, angle, scale] = collage.shown.subarray(52); const [px, py] = collage.look("
        "collage.items[13]).points.reduce((a, b) => Math.abs(a[0]) > Math.abs(b[0]) ? a : b);"
        " const [u, v] = [4 * px * scale, py * scale / 4]; const end = view.toScreen("
        "x + u * Math.cos(angle) - v * Math.sin(angle),"
        " y + u * Math.sin(angle) + v * Math.cos(angle));"
        " const found = stage.itemAt(end.x, end.y, 2);"
        " collage.scene.rim = rim; for (const item of collage.items)"
        " [item.stretch, item.halo] = [1, '']; collage.shown[0] -= 30; backdrop.key = [];"
        " studio.redraw(); return [far, parts, found]; })()"
    )
    assert parts > 0
    assert far < SHADES
    assert found == 13


SHADES = 100
"""By which a long curve differs at most where only a part of it is drawn; of what is left out or
drawn over more is off."""


def test_what_moves_by_less_than_can_be_seen_is_drawn_once_it_rests(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    looked = desk.look(
        "(() => { const { stage, collage } = studio, { backdrop } = stage, drawn = [];"
        " for (const _ of [1, 2]) stage.draw(); const { isStale } = backdrop;"
        " backdrop.isStale = (k, part) => { const is = isStale.call(backdrop, k, part);"
        " if (is) drawn.push(k); return is; };"
        " collage.shown[0] += 0.02 / studio.view.zoom; stage.draw(true); const whileMoving ="
        " drawn.length; stage.draw(false); const atRest = drawn.includes(0);"
        " const [was] = backdrop.drawn; drawn.length = 0; stage.draw(false);"
        " delete backdrop.isStale; return [whileMoving, atRest, was === collage.shown[0],"
        " drawn.length]; })()"
    )
    assert looked == [0, True, True, 0]


def test_numbers_follow_a_drag_now_and_then_and_its_end_at_once(
    open_desk: Callable[..., Desk],
) -> None:
    desk = open_desk()
    start = desk.place(0)
    desk.page.mouse.move(*start)
    desk.page.mouse.down()
    desk.page.mouse.move(start[0] + 30, start[1], steps=3)
    field = "studio.panels.items.inspector.field('x')"
    is_there = f"Math.abs({field}.value - studio.collage.target(0).x) < 0.06"
    desk.until(is_there)
    changed = desk.look(
        "(() => { const { inspector } = studio.panels.items, follow = inspector.follow; let n = 0;"
        " inspector.follow = () => n++; for (let k = 0; k < 5; k++) studio.draw(studio.last);"
        " delete inspector.follow; return n; })()"
    )
    desk.page.mouse.up()
    desk.settled()
    assert changed == 0
    assert desk.look(is_there)


def test_a_page_is_waited_for_and_left_as_new(browser: Any, server: Server) -> None:
    page = new_page(browser, WIDE)
    desk = Desk(page, server.address)
    desk.settled()
    told = ("print", "(prefers-color-scheme: dark)", "(prefers-reduced-motion: reduce)",
            "(forced-colors: active)", "(prefers-contrast: more)")  # fmt: skip
    fresh = desk.look(f"{json.dumps(told)}.map((one) => matchMedia(one).matches)")
    desk.page.emulate_media(
        media="print", color_scheme="dark", contrast="more", forced_colors="active",
        reduced_motion="no-preference" if fresh[2] else "reduce",
    )  # fmt: skip
    desk.look("void (globalThis.looks = 0)")
    desk.until("new Promise((done) => setTimeout(done, 1, ++looks === 3))")
    assert desk.look("looks") == 3
    desk.page.route("**/*", lambda route: route.abort())
    desk.leave()
    as_new(page)
    assert desk.look(f"{json.dumps(told)}.map((one) => matchMedia(one).matches)") == fresh
    # The same address is loaded anew, nothing of which is caught any more.
    Desk(page, server.address).settled()
    assert not desk.look("'looks' in globalThis")
    page.context.close()
