"""Words that come beside icons, each kind with its share; and files for a print shop."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from studio.browsing import PHONE, WIDE, Desk, in_browser

pytestmark = in_browser

SHARE = "(([words, others]) => words / (words + others))(studio.words.mixing.weights)"

STILL_MS = 250
"""How long the slider is still until it asks."""

HELD = f"""(globalThis.later = setTimeout, globalThis.setTimeout = (call, ms, ...more) =>
  ms === {STILL_MS} ? ((globalThis.ask = call), -1) : later(call, ms, ...more)) && null"""
"""Keeps what the slider would call after that, instead of calling it."""


@pytest.fixture
def desk(open_desk: Callable[..., Desk]) -> Desk:
    return open_desk()


def test_words_come_beside_icons_with_a_share_that_a_slider_changes(desk: Desk) -> None:
    page = desk.page
    page.mouse.click(*desk.place(0))
    page.keyboard.press("h")
    desk.until("studio.areHeld")
    held = desk.look("studio.collage.pose(0)")
    page.locator("#tab-words").click()
    page.locator("#text").fill("hope, 6\njoy, 4\npeace, 3\nsea, 2\nsun, 2")
    page.get_by_label("Where the words come").select_option("beside")
    page.get_by_label("Share of words, %").fill("40")
    assert page.get_by_text("put somewhere by hand").filter(visible=True).count() == 1
    page.get_by_role("button", name="Fill with words").click()
    desk.until("studio.collage.items.length === 19")
    desk.settled()
    assert desk.look(SHARE) == pytest.approx(0.4, abs=1e-3)
    assert desk.look("studio.collage.scene.options.sizes") == "shared"
    desk.picture("mixing")
    slider = page.locator("#share-of-words")
    slider.focus()
    for _ in range(4):
        page.keyboard.press("ArrowRight")
    desk.until(f"Math.abs({SHARE} - 0.6) < 1e-3")
    desk.settled()
    pose = desk.look("studio.collage.pose(0)")
    assert (pose["x"], pose["y"]) == (held["x"], held["y"])
    desk.picture("mixing-more")
    # A line of something else does not change what is about to be asked for, and neither does a
    # key back; what is refused then is not shown as if it were there. It asks when it is told to,
    # however slow the machine is.
    no = "studio.said({ type: 'line', text: 'there is no room', is_error: true })"
    desk.look("(globalThis.sent = [], studio.connection.send = (one) => sent.push(one)) && null")
    desk.look(HELD)
    for keys, percent in ((["ArrowRight"], 65), (["ArrowLeft", "ArrowRight"], 60)):
        for key in keys:
            page.keyboard.press(key)
        desk.look(f"{no}, studio.refresh()")
        assert slider.input_value() == str(percent)
        assert desk.look("(ask(), sent.splice(0))") == [{"type": "mix", "share": percent / 100}]
        desk.look(no)
        assert slider.input_value() == "60"
    desk.look("(globalThis.setTimeout = later, delete studio.connection.send)")
    desk.resize(PHONE)
    desk.picture("mixing-phone")
    desk.resize(WIDE)
    for _ in range(3):
        page.locator("#bar [data-do=undo]").click()
    desk.until("studio.collage.items.length === 14 && !studio.anyHeld")


def test_a_pdf_has_marks_and_spot_inks_and_others_say_why_not(desk: Desk) -> None:
    page = desk.page
    page.locator("#export").click()
    dialog = page.locator("dialog.export")
    dialog.locator("input[value=png]").check()
    dialog.get_by_text("More, for print").click()
    assert dialog.locator("[name=marks]").is_disabled()
    assert dialog.get_by_text("PDF alone has it").count() == 3
    dialog.locator("input[value=pdf]").check()
    dialog.get_by_text("More, for print").click()
    # Only a canvas that repeats has several tiles.
    assert dialog.locator("[name=tiles]").count() == 0
    dialog.locator("[name=marks]").select_option("all")
    dialog.locator("[name=spot]").fill("Gold=#b58b2a")
    desk.picture("printing")
    with page.expect_download() as waited:
        dialog.locator("button.primary").click()
    data = Path(waited.value.path()).read_bytes()
    assert b"/TrimBox" in data
    page.locator("#export").click()
    dialog.get_by_text("More, for print").click()
    with page.expect_file_chooser() as chooser:
        dialog.get_by_role("button", name="Its profile").click()
    wrong = Path(waited.value.path()).with_name("wrong.icc")
    wrong.write_bytes(b"no profile")
    chooser.value.set_files(wrong)
    dialog.get_by_role("button", name="wrong.icc").wait_for()
    dialog.locator("button.primary").click()
    dialog.locator(".note[data-is=bad]", has_text="wrong.icc").wait_for()
    page.keyboard.press("Escape")
    # The browser notes that the file was refused.
    desk.faults.clear()
