"""A picture that the items show from afar: dropped, its likeness, saved, exported, replayed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from studio.browsing import PHONE, Desk, Server, in_browser

pytestmark = in_browser

FILLS = "studio.collage.items.map((item) => studio.collage.look(item).fill.slice(0, 7))"
X = "studio.collage.items.map((item) => studio.collage.pose(item.id).x)"


@pytest.fixture(scope="module")
def halves(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A picture whose left half is dark and whose right half is light."""
    path = tmp_path_factory.mktemp("pictures") / "halves.png"
    picture = Image.new("RGB", (400, 300), "#102a6e")
    picture.paste("#f2c14e", (200, 0, 400, 300))
    picture.save(path)
    return path


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    made = Server("circle", "star", "heart", "-n", "16").start()
    yield made
    made.stop()


@pytest.fixture
def desk(open_desk: Callable[..., Desk]) -> Iterator[Desk]:
    made = open_desk()
    yield made
    made.undo_all()


def drop(desk: Desk, picture: Path, answer: str) -> None:
    """Choose a picture as if it were dropped, and say what it is for."""
    with desk.page.expect_file_chooser() as chooser:
        desk.page.keyboard.press("Control+o")
    chooser.value.set_files(picture)
    dialog = desk.page.get_by_role("dialog", name="What the picture is for")
    dialog.wait_for()
    desk.picture("mosaic-question")
    dialog.get_by_role("button", name=answer).click()


def contrast(desk: Desk) -> float:
    """How much lighter items on the right are than those on the left, 0..255."""
    fills, x = desk.look(FILLS), np.array(desk.look(X))
    light = np.array([np.mean([int(one[k : k + 2], 16) for k in (1, 3, 5)]) for one in fills])
    middle = desk.look("studio.view.whole.width / 2")
    return float(light[x > middle].mean() - light[x < middle].mean())


def test_a_dropped_picture_is_shown_as_much_as_the_slider_says(desk: Desk, halves: Path) -> None:
    own = desk.look(FILLS)
    drop(desk, halves, "The picture of a mosaic")
    desk.until("studio.collage.scene.likeness === 1")
    desk.settled()
    whole = contrast(desk)
    assert whole > 60
    assert [one["faint"] for one in desk.look("studio.collage.scene.under")] == [True]
    desk.page.keyboard.press("6")
    slider = desk.page.get_by_label("Likeness")
    desk.picture("mosaic-whole")
    slider.focus()
    for _ in range(10):
        desk.page.keyboard.press("ArrowLeft")
    desk.until("studio.collage.scene.likeness === 0.5")
    assert 0.2 * whole < contrast(desk) < 0.8 * whole
    desk.page.get_by_role("button", name="their own", exact=True).click()
    desk.until("studio.collage.scene.likeness === null")
    assert desk.look(FILLS) == own
    assert desk.look("studio.collage.scene.under") == []


def test_an_item_that_is_dragged_takes_on_the_colour_where_it_lies(
    desk: Desk, halves: Path
) -> None:
    drop(desk, halves, "The picture of a mosaic")
    desk.until("studio.collage.scene.likeness === 1")
    desk.settled()
    left = int(np.argmin(desk.look(X)))
    item, before = desk.look(f"studio.collage.items[{left}].id"), desk.look(FILLS)[left]
    at = desk.place(item)
    right = desk.look("studio.view.toScreen(studio.view.whole.width * 0.9, 0).x")
    desk.drag(at, (right, at[1]))
    desk.until(f"{FILLS}[{left}] !== {before!r}")
    desk.settled()
    assert int(desk.look(FILLS)[left][1:3], 16) > int(before[1:3], 16) + 40


def test_its_colours_become_a_palette_and_it_lies_behind_all(desk: Desk, halves: Path) -> None:
    drop(desk, halves, "Its colours")
    desk.until("studio.collage.scene.palette.length === 2")
    assert set(desk.look("studio.collage.scene.palette")) == {"#102a6e", "#f2c14e"}
    drop(desk, halves, "The background")
    desk.until("studio.collage.scene.under.length === 1 && !studio.collage.scene.under[0].faint")
    desk.settled()
    desk.picture("mosaic-behind")
    # The picture is kept as a JPEG.
    away = np.subtract(corners_of_export(desk), [(0x10, 0x2A, 0x6E), (0xF2, 0xC1, 0x4E)])
    assert np.abs(away).max() <= 4


def test_a_gradient_is_behind_all_on_the_page_and_in_files(desk: Desk) -> None:
    desk.page.keyboard.press("6")
    desk.page.get_by_label("Colour 1 of the gradient").fill("#ff0000")
    # An answer to the first, that comes when the second is asked for, takes nothing back.
    desk.answered()
    late = "(ground.shown = '', ground.refresh(), ground.ends[1].value)"
    asked = "Object.assign(ground.ends[1], {value: '#0000ff'}).dispatchEvent(new Event('change'))"
    assert desk.look(f"(ground => ({asked}, {late}))(studio.panels.look.ground)") == "#0000ff"
    desk.page.get_by_label("Way of the gradient").select_option(label="across")
    desk.answered()
    assert desk.look("studio.collage.scene.under.length") == 1
    desk.picture("gradient")
    for edge in ("none", "as of a print"):
        left, right = corners_of_export(desk, edge)
        assert left[0] > 240 > 20 > left[2]
        assert right[2] > 240 > 20 > right[0]
    undo = desk.page.locator("#bar [data-do=undo]")
    undo.click()
    desk.until("studio.panels.look.ground.way.selectedOptions[0].label === 'down'")
    for _ in range(2):
        undo.click()
    desk.until("studio.collage.scene.under.length === 0")


def corners_of_export(desk: Desk, edge: str = "none") -> list[tuple[int, ...]]:
    """Colours at the upper corners of the PNG that the dialogue makes with a free edge."""
    desk.page.locator("#export").click()
    desk.page.locator("dialog.export input[value=png]").check()
    desk.page.locator("dialog.export [name=margin]").select_option(label=edge)
    desk.page.locator("dialog.export [name=pixels]").fill("600")
    with desk.page.expect_download() as waited:
        desk.page.locator("dialog.export button.primary").click()
    with Image.open(BytesIO(Path(waited.value.path()).read_bytes())) as picture:
        shown = picture.convert("RGB")
        return [shown.getpixel((x, 2)) for x in (2, shown.width - 3)]


def test_the_mosaic_fits_on_a_phone(desk: Desk, halves: Path) -> None:
    desk.resize(PHONE)
    drop(desk, halves, "The picture of a mosaic")
    desk.until("studio.collage.scene.likeness === 1")
    desk.page.locator("#tab-look").click()
    box = desk.page.get_by_label("Likeness").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= PHONE["width"]
    desk.picture("mosaic-phone")
