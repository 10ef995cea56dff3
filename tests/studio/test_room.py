"""The container in the hand: moved, scaled, turned, reshaped, put on a sheet."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from studio.browsing import Desk, in_browser

pytestmark = in_browser

BOUNDS = (
    "(() => { const n = studio.collage.scene.outline.match(/-?[0-9.]+/g).map(Number);"
    " const xs = n.filter((_, k) => k % 2 === 0); const ys = n.filter((_, k) => k % 2);"
    " return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)]; })()"
)


def grip(desk: Desk, kind: str, number: int = 0) -> tuple[float, float]:
    """Where a handle of the container is on the window."""
    x, y = desk.look(
        f"(() => {{ const g = studio.room.grips().filter(one => one.grip.kind === '{kind}')"
        f"[{number}]; return [g.x, g.y + studio.canvas.getBoundingClientRect().top]; }})()"
    )
    return x, y


def changed(desk: Desk, act: Callable[[], object]) -> list[float]:
    """Bounds of the container after it was changed."""
    before = desk.look("studio.collage.scene.version")
    act()
    desk.until(f"studio.collage.scene.version > {before}")
    return desk.look(BOUNDS)


def test_its_frame_moves_scales_and_turns_it(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.keyboard.press("c")
    first = desk.look(BOUNDS)
    corner = grip(desk, "scale", 2)
    inner = (corner[0] - 80, corner[1] - 80)
    smaller = changed(desk, lambda: desk.drag(corner, inner))
    assert smaller[2] - smaller[0] < 0.9 * (first[2] - first[0])
    desk.picture("container-frame")
    turn = grip(desk, "turn")
    turned = changed(desk, lambda: desk.drag(turn, (turn[0] + 120, turn[1] + 60)))
    assert turned == pytest.approx(smaller, abs=2)
    moved = changed(desk, lambda: desk.page.keyboard.press("Shift+ArrowLeft"))
    assert moved[0] < turned[0] - 10
    desk.page.keyboard.press("Escape")
    assert not desk.look("studio.room.isOn")
    for _ in range(3):
        desk.page.keyboard.press("Control+z")
    desk.until(f"JSON.stringify({BOUNDS}) === '{str(first).replace(' ', '')}'")
    desk.settled()


def test_its_points_are_pulled_by_hand_and_by_keys(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.locator("#tab-room").click()
    desk.page.get_by_role("button", name="Edit its outline").click()
    count = desk.look("studio.room.grips().filter(one => one.grip.kind === 'point').length")
    assert 6 <= count <= 40
    first = desk.look(BOUNDS)
    x, y = grip(desk, "point", 0)
    middle = desk.look("studio.view.toScreen(300, 300)")
    away = (x + 0.4 * (middle["x"] - x), y + 0.4 * (middle["y"] + 50 - y))
    pulled = changed(desk, lambda: desk.drag((x, y), away))
    assert pulled != first
    desk.settled()
    desk.picture("container-points")
    desk.page.locator("#canvas").focus()
    desk.page.keyboard.press("n")
    changed(desk, lambda: desk.page.keyboard.press("Shift+ArrowDown"))
    desk.page.keyboard.press("c")
    for _ in range(2):
        desk.page.keyboard.press("Control+z")
    desk.until(f"JSON.stringify({BOUNDS}) === '{str(first).replace(' ', '')}'")
    desk.settled()


def test_it_is_put_on_a_sheet_of_paper(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.locator("#tab-room").click()
    desk.page.get_by_label("Sheet").select_option("A5")
    desk.until("studio.collage.scene.width === 148 && studio.collage.scene.unit === 'mm'")
    desk.settled()
    desk.picture("sheet")
    assert desk.look("studio.view.whole.height") == 210
    desk.page.locator("#bar [data-do=undo]").click()
    desk.until("studio.collage.scene.unit === 'px'")
    desk.settled()


def test_what_is_free_and_covered_is_shown_in_colours(open_desk: Callable[..., Desk]) -> None:
    desk = open_desk()
    desk.page.keyboard.press("v")
    assert desk.page.locator("#key").is_visible()
    x, y = desk.place(0)
    shown = (
        f"studio.canvas.getContext('2d').getImageData({x} * studio.stage.ratio,"
        f" ({y} - studio.canvas.getBoundingClientRect().top) * studio.stage.ratio, 1, 1).data"
    )
    desk.until(f"(([red, , blue]) => blue > red - 60)({shown})")
    desk.picture("faults")
    desk.page.keyboard.press("v")
    assert not desk.page.locator("#key").is_visible()
