"""Copy, cut, paste and copies that are dragged away, in one studio and between two."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from studio.browsing import WIDE, Desk, Server, in_browser

pytestmark = in_browser

COUNT = "studio.collage.items.length"
CHOSEN = "[...studio.choice.ids]"
FIRST = "studio.collage.item([...studio.choice.ids][0])"


def undone(desk: Desk, count: int) -> None:
    for _ in range(20):
        if not desk.look("studio.collage.state.can_undo"):
            break
        desk.page.keyboard.press("Control+z")
        desk.settled()
    desk.until(f"{COUNT} === {count}")


def test_a_copy_is_pasted_at_the_pointer_and_chosen(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    count = desk.look(COUNT)
    desk.page.mouse.click(*desk.place(3))
    desk.page.keyboard.press("Control+c")
    name, scale = desk.look(f"[{FIRST}.name, studio.collage.pose(3).scale]")
    x, y = desk.place(6)
    desk.page.mouse.move(x, y)
    desk.page.keyboard.press("Control+v")
    desk.until(f"{COUNT} === {count + 1} && studio.choice.ids.size === 1 && !studio.choice.has(3)")
    desk.settled()
    assert desk.look(f"{FIRST}.name") == name
    (new,) = desk.look(CHOSEN)
    assert desk.look(f"studio.collage.pose({new}).scale") == pytest.approx(scale, rel=0.6)
    undone(desk, count)


def test_what_is_cut_is_gone_until_it_is_pasted(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    count = desk.look(COUNT)
    desk.page.mouse.click(*desk.place(1))
    desk.page.keyboard.press("Control+x")
    desk.until(f"{COUNT} === {count - 1}")
    desk.settled()
    desk.page.keyboard.press("Control+v")
    desk.until(f"{COUNT} === {count}")
    desk.settled()
    undone(desk, count)


def test_a_drag_with_alt_leaves_a_copy_in_its_place(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.rested()
    count = desk.look(COUNT)
    there = desk.look("studio.collage.pose(4)")
    desk.page.keyboard.down("Alt")
    desk.page.mouse.move(*desk.place(4))
    desk.page.mouse.down()
    desk.page.mouse.move(*desk.place(9), steps=8)
    desk.until(f"{COUNT} === {count + 1}")
    new = desk.look("studio.collage.items.at(-1)")
    assert new["name"] == desk.look("studio.collage.item(4).name")
    desk.page.mouse.up()
    desk.page.keyboard.up("Alt")
    desk.settled()
    desk.rested()
    copy = desk.look(f"studio.collage.pose({new['id']})")
    assert math.dist((copy["x"], copy["y"]), (there["x"], there["y"])) < 60
    desk.picture("copied")
    desk.page.keyboard.press("Control+z")
    desk.until(f"{COUNT} === {count}")
    desk.settled()
    assert not desk.look("studio.collage.state.can_undo")


def test_a_copy_comes_to_another_studio_and_goes_out_as_svg(open_desk: Callable[..., Desk]) -> None:
    other = Server("heart", "moon", "-n", "3").start()
    try:
        desk = open_desk()
        desk.page.mouse.click(*desk.place(0))
        desk.page.keyboard.press("Control+c")
        name = desk.look(f"{FIRST}.name")
        second = Desk(desk.page.context.new_page(), other.address)
        second.settled()
        second.page.keyboard.press("Control+v")
        second.until(f"{COUNT} === 4")
        second.settled()
        assert second.look("studio.collage.items.at(-1).name") == name
        assert second.faults == []
        desk.page.context.grant_permissions(["clipboard-read"], origin=other.address)
        text = second.page.evaluate("() => navigator.clipboard.readText()")
        assert text.startswith("<svg ")
        assert "<path" in text
        second.look(f"document.dispatchEvent({pasting('<svg onload=alert(1)><g')})")
        second.page.locator(".toast.error").wait_for()
        assert second.look(COUNT) == 4
    finally:
        other.stop()


def test_a_studio_started_anew_pastes_what_the_page_has(
    browser: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    first, context = Server("heart", "moon", "-n", "3").start(), browser.new_context(viewport=WIDE)
    second = Server("--again", "--port", first.port)
    try:
        desk = Desk(context.new_page(), first.address)
        desk.settled()
        desk.page.mouse.click(*desk.place(0))
        desk.page.keyboard.press("Control+c")
        desk.until("studio.collage.state.clip === studio.clipboard.last.token")
        first.kill()
        desk.until("!studio.connection.isOpen")
        second.start()
        desk.until("studio.connection.isOpen")
        desk.settled()
        assert desk.look("studio.collage.state.clip") == ""
        desk.page.keyboard.press("Control+v")
        desk.until(f"{COUNT} === 4")
        desk.settled()
        desk.look("studio.clipboard.askPaste()")
        desk.until(f"{COUNT} === 5")
        assert desk.faults == []
    finally:
        context.close()
        first.stop()
        second.stop()


def pasting(text: str) -> str:
    """Event of a paste of a text that a stranger has put there."""
    return (
        "(data => (data.setData('text/plain', "
        f"'{text}'), new ClipboardEvent('paste', {{clipboardData: data}})))(new DataTransfer())"
    )
