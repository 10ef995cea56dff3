"""A photograph is moved in its frame by hand and by keys, as one command."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator

import pytest
from PIL import Image

import packwork as pw
from studio.browsing import Desk, Server, in_browser

pytestmark = in_browser

CROP = "JSON.stringify(studio.collage.item(0).crop)"
WHOLE = json.dumps([1, 0, 0], separators=(",", ":"))


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    folder = tmp_path_factory.mktemp("album")
    for k in range(3):
        Image.effect_noise((90, 60), 60 + k).convert("RGB").save(folder / f"{k}.png")
    pw.photos("square", [folder], effort="draft", levels="50").save(folder / "album.packwork")
    made = Server(str(folder / "album.packwork")).start()
    yield made
    made.stop()


def test_a_photograph_is_dragged_in_its_frame(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    before = desk.rested()
    x, y = desk.place(0)
    desk.page.mouse.dblclick(x, y)
    assert desk.look("studio.cropping.isOn")
    sent = desk.look("studio.connection.count")
    desk.page.mouse.wheel(0, -200)
    desk.until("studio.cropping.now.zoom > 1.2")
    desk.drag((x, y), (x + 900, y))
    zoom, at = desk.look("[studio.cropping.now.zoom, studio.cropping.now.x]")
    assert at == pytest.approx((zoom - 1) / 2)
    desk.picture("cropping")
    desk.page.keyboard.press("Enter")
    desk.until(f"{CROP} !== '{WHOLE}'")
    assert desk.look("studio.connection.count") == sent + 1
    desk.settled()
    assert desk.look("JSON.stringify([...studio.collage.poses])") == before
    assert desk.look("studio.collage.look(studio.collage.item(0)).whole.length") > 0
    desk.page.keyboard.press("Control+z")
    desk.until(f"{CROP} === '{WHOLE}'")


def test_keys_crop_and_escape_leaves_all_as_it_was(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    keys = desk.page.keyboard
    desk.page.locator("#canvas").focus()
    keys.press("n")
    sent = desk.look("studio.connection.count")
    keys.press("Enter")
    for key in ("+", "+", "ArrowLeft", "Escape"):
        keys.press(key)
    assert not desk.look("studio.cropping.isOn")
    assert desk.look("studio.connection.count") == sent
    keys.press("Enter")
    keys.press("+")
    keys.press("ArrowLeft")
    assert desk.look("studio.cropping.now.x") < 0
    keys.press("Enter")
    assert desk.look("studio.connection.count") == sent + 1
    desk.until(f"{CROP} !== '{WHOLE}'")
    keys.press("Control+z")
    desk.until(f"{CROP} === '{WHOLE}'")


def test_two_fingers_zoom_the_photograph_and_not_the_page(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.rested()
    x, y = desk.place(0)
    desk.page.mouse.dblclick(x, y)
    zoom = desk.look("studio.view.zoom")
    touch = desk.page.context.new_cdp_session(desk.page)

    def pinch(x: float, y: float) -> None:
        first = {"x": x - 10, "y": y, "id": 0}
        touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [first]})
        for kind, off in (("touchStart", 10), ("touchMove", 16), ("touchMove", 22)):
            points = [{**first, "x": x - off}, {"x": x + off, "y": y, "id": 1}]
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

    pinch(x, y)
    desk.until("studio.cropping.now.zoom > 1.5")
    # Beside it, too; one finger there keeps the crop.
    edge = desk.look("studio.canvas.getBoundingClientRect().bottom")
    pinch(x, edge - 120)
    desk.until("studio.cropping.now.zoom > 3")
    assert desk.look("studio.view.zoom") == zoom
    assert desk.look("studio.cropping.isOn")
    assert desk.look(CROP) == WHOLE
    for kind, points in (("touchStart", [{"x": x, "y": edge - 120}]), ("touchEnd", [])):
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    desk.until(f"!studio.cropping.isOn && {CROP} !== '{WHOLE}'")
    desk.settled()
    desk.page.keyboard.press("Control+z")
    desk.until(f"{CROP} === '{WHOLE}'")
    desk.page.mouse.dblclick(x, y)
    desk.page.keyboard.press("+")
    desk.page.keyboard.press("Enter")
    desk.until(f"{CROP} !== '{WHOLE}'")
    desk.settled()
    desk.page.keyboard.press("Control+z")
    desk.until(f"{CROP} === '{WHOLE}'")


def test_buttons_keep_a_crop_and_leave_it_as_it_was(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.rested()
    x, y = desk.place(0)
    bar = desk.page.locator("#choice")
    for name, ends in (("none", WHOLE), ("keep", None)):
        desk.page.mouse.dblclick(x, y)
        bar.get_by_text("The picture in its frame").wait_for()
        desk.picture(f"cropping-{name}")
        desk.page.mouse.wheel(0, -200)
        desk.until("studio.cropping.now.zoom > 1.2")
        bar.locator(f"[data-do={name}]").click()
        assert not desk.look("studio.cropping.isOn")
        desk.until(f"{CROP} {'===' if ends else '!=='} '{WHOLE}'")
    # What is chosen has its own buttons again.
    bar.locator("[data-do=crop]").wait_for()
    assert not bar.locator("[data-do=none]").is_visible()
    desk.page.keyboard.press("Control+z")
    desk.until(f"{CROP} === '{WHOLE}'")
