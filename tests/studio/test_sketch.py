"""The container drawn freehand, and a hole in it."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from studio.browsing import Desk, in_browser

pytestmark = in_browser


@pytest.fixture
def desk(open_desk: Callable[..., Desk]) -> Desk:
    return open_desk()


def draw(desk: Desk, radius: Callable[[float], float], turns: float = 1.0) -> None:
    """Draw round the middle of the canvas, at a distance in px by the angle."""
    x, y = desk.look(
        "(() => { const { width, height } = studio.view.whole; const box = "
        "studio.canvas.getBoundingClientRect(); const at = studio.view.toScreen(width / 2, "
        "height / 2); return [at.x + box.left, at.y + box.top]; })()"
    )
    angles = [math.tau * turns * k / 60 for k in range(60)]
    points = [(x + radius(a) * math.cos(a), y + radius(a) * math.sin(a)) for a in angles]
    desk.page.mouse.move(*points[0])
    desk.page.mouse.down()
    for point in points[1:]:
        desk.page.mouse.move(*point)
    desk.picture("sketch-line")
    desk.page.mouse.up()


def covered(desk: Desk) -> float:
    return float(desk.look("studio.collage.state.covered"))


def test_an_outline_and_a_hole_are_drawn_and_undone(desk: Desk) -> None:
    first = desk.look("studio.collage.scene.outline")
    desk.page.locator("#tab-room").click()
    desk.page.get_by_role("button", name="Draw one").click()
    # A flower, whose line goes on past its beginning.
    draw(desk, lambda a: 230 + 50 * math.sin(3 * a), turns=1.06)
    desk.until(f"studio.collage.scene.outline !== {first!r}")
    desk.settled()
    drawn = desk.look("studio.collage.scene.outline")
    assert drawn.count("M") == 1
    assert covered(desk) > 0.5
    desk.picture("sketch-drawn")
    desk.page.locator("#canvas").focus()
    desk.page.keyboard.press("Shift+K")
    draw(desk, lambda _: 60.0)
    desk.until("studio.collage.scene.outline.split('M').length === 3")
    desk.settled()
    desk.picture("sketch-hole")
    for before in (drawn, first):
        desk.page.locator("#bar [data-do=undo]").click()
        desk.until(f"studio.collage.scene.outline === {before!r}")
    desk.settled()


def test_escape_and_a_button_leave_off_and_a_short_line_is_none(desk: Desk) -> None:
    first = desk.look("studio.collage.scene.outline")
    desk.page.keyboard.press("k")
    draw(desk, lambda _: 2.0)
    assert desk.look("studio.sketch.isDrawing")
    desk.page.keyboard.press("Escape")
    assert not desk.look("studio.sketch.isDrawing")
    for ways, said in (("k", "Draw the outline"), ("q", "Draw round"), ("g", "Draw an arrow")):
        desk.page.keyboard.press(ways)
        bar = desk.page.locator("#choice")
        bar.get_by_text(said).wait_for()
        bar.get_by_role("button").click()
        bar.wait_for(state="hidden")
        assert not desk.look("Boolean(studio.gestures.drawer)")
    assert desk.look("studio.collage.scene.outline") == first
