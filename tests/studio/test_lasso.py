"""Items chosen by a line that is drawn round them: by mouse, by finger, and left off by keys."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from studio.browsing import PHONE, Desk, in_browser

pytestmark = in_browser

WINDOW = (
    "(() => { const r = studio.canvas.getBoundingClientRect(); return studio.collage.items.map("
    "(item) => { const p = studio.collage.pose(item.id); const s = studio.view.toScreen(p.x, p.y);"
    " return [s.x + r.left, s.y + r.top]; }); })()"
)
CHOSEN = "[...studio.choice.ids].sort((a, b) => a - b)"


@pytest.fixture
def desk(open_desk: Callable[..., Desk]) -> Desk:
    return open_desk()


def wedge(places: np.ndarray) -> tuple[np.ndarray, list[int]]:
    """A triangle from the middle to the right edge, beyond all, and the items that lie in it."""
    middle, far = places.mean(axis=0), np.ptp(places, axis=0).max()
    ways = places - middle
    inside = [k for k, (x, y) in enumerate(ways) if x > 0 and abs(y) < 0.8 * x]
    corners = middle + far * np.array([[0, 0], [0.75, -0.6], [0.75, 0.6]])
    return corners, inside


def test_a_line_round_items_chooses_them_and_shift_adds(desk: Desk) -> None:
    places = np.array(desk.look(WINDOW))
    (start, upper, lower), inside = wedge(places)
    page = desk.page
    page.keyboard.press("q")
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*upper, steps=6)
    page.mouse.move(*lower, steps=6)
    desk.picture("lasso-line")
    page.mouse.up()
    ids = desk.look("studio.collage.items.map((item) => item.id)")
    assert desk.look(CHOSEN) == sorted(ids[k] for k in inside)
    assert not desk.look("studio.lasso.isDrawing")
    other = next(k for k in range(len(ids)) if k not in inside)
    page.keyboard.press("Shift+Q")
    x, y = places[other]
    page.mouse.move(x - 3, y - 3)
    page.mouse.down()
    for corner in ((x + 3, y - 3), (x + 3, y + 3), (x - 3, y + 3)):
        page.mouse.move(*corner, steps=3)
    page.mouse.up()
    assert desk.look(CHOSEN) == sorted(ids[k] for k in (*inside, other))
    page.keyboard.press("Escape")
    assert desk.look(CHOSEN) == []


def test_escape_leaves_off_and_a_press_alone_draws_nothing(desk: Desk) -> None:
    desk.page.keyboard.press("q")
    assert desk.look("studio.lasso.isDrawing")
    desk.page.keyboard.press("Escape")
    assert not desk.look("studio.lasso.isDrawing")
    left, top = desk.look(
        "(r => [r.right - 40, r.bottom - 160])(studio.canvas.getBoundingClientRect())"
    )
    desk.page.keyboard.down("Alt")
    desk.page.mouse.click(left, top)
    desk.page.keyboard.up("Alt")
    assert not desk.look("studio.lasso.isDrawing")


def test_escape_in_a_drag_chooses_what_was_chosen_before(desk: Desk) -> None:
    page, ids = desk.page, desk.look("studio.collage.items.map((item) => item.id)")
    (start, upper, lower), _ = wedge(np.array(desk.look(WINDOW)))
    desk.look(f"studio.choice.set([{ids[0]}])")
    # Another tool that was taken before is put back.
    page.keyboard.press("k")
    page.keyboard.press("q")
    assert not desk.look("studio.sketch.isDrawing")
    assert desk.look("studio.canvas.dataset.over") == "draw"
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*upper, steps=3)
    page.mouse.move(*lower, steps=3)
    assert len(desk.look(CHOSEN)) > 1
    page.keyboard.press("Escape")
    assert desk.look(CHOSEN) == ids[:1]
    assert desk.look("[studio.canvas.dataset.over, studio.choice.isBusy]") == ["", False]
    page.mouse.up()
    assert desk.look(CHOSEN) == ids[:1]
    # So it is with a frame that is drawn, by which all else is chosen meanwhile.
    left, top = desk.look("(r => [r.left, r.top])(studio.canvas.getBoundingClientRect())")
    page.mouse.move(left + 420, top + 80)
    page.mouse.down()
    page.mouse.move(*start, steps=3)
    assert desk.look("studio.stage.marquee") is not None
    page.keyboard.press("Escape")
    page.mouse.move(*lower, steps=3)
    assert desk.look("studio.stage.marquee") is None
    assert desk.look(CHOSEN) == ids[:1]
    page.mouse.up()
    assert desk.look(CHOSEN) == ids[:1]
    page.keyboard.press("Escape")
    assert desk.look(CHOSEN) == []


def test_a_second_finger_zooms_and_the_line_begins_anew(desk: Desk) -> None:
    (start, upper, lower), inside = wedge(np.array(desk.look(WINDOW)))
    touch = desk.page.context.new_cdp_session(desk.page)

    def fingers(kind: str, *places: np.ndarray) -> None:
        points = [{"x": float(x), "y": float(y), "id": k} for k, (x, y) in enumerate(places)]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    desk.page.keyboard.press("q")
    fingers("touchStart", start)
    for corner in (upper, lower):
        fingers("touchMove", corner)
    desk.until("studio.choice.ids.size > 0")
    fingers("touchStart", lower, start)
    desk.until("studio.choice.ids.size === 0")
    zoom = desk.look("studio.view.zoom")
    fingers("touchMove", lower + 20, start)
    desk.until(f"studio.view.zoom !== {zoom}")
    fingers("touchEnd")
    assert desk.look("[studio.lasso.isDrawing, studio.lasso.line.length]") == [True, 0]
    desk.page.keyboard.press("0")
    desk.until(f"studio.view.zoom === {zoom}")
    fingers("touchStart", start)
    for corner in (upper, lower):
        fingers("touchMove", corner)
    fingers("touchEnd")
    ids = desk.look("studio.collage.items.map((item) => item.id)")
    desk.until("!studio.lasso.isDrawing")
    assert desk.look(CHOSEN) == sorted(ids[k] for k in inside)
    desk.page.keyboard.press("Escape")


def test_a_finger_draws_it_from_the_menu_of_a_long_press(desk: Desk) -> None:
    desk.resize(PHONE)
    desk.settled()
    places = np.array(desk.look(WINDOW))
    (start, upper, lower), inside = wedge(places)
    touch = desk.page.context.new_cdp_session(desk.page)

    def finger(kind: str, *at: float) -> None:
        points = [{"x": float(at[0]), "y": float(at[1])}] if at else []
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    bare = (20.0, float(places[:, 1].min() - 60))
    finger("touchStart", *bare)
    item = desk.page.get_by_role("menuitem", name="Choose by a line drawn round them")
    item.wait_for()
    finger("touchEnd")
    item.click()
    finger("touchStart", *start)
    for corner in np.linspace(start, upper, 6), np.linspace(upper, lower, 6):
        for x, y in corner:
            finger("touchMove", x, y)
    finger("touchEnd")
    ids = desk.look("studio.collage.items.map((item) => item.id)")
    assert desk.look(CHOSEN) == sorted(ids[k] for k in inside)
    desk.picture("lasso-phone")
