from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import resvg_py

from packwork.errors import RecipeError, WriteError
from packwork.geometry.affine import identity
from packwork.raster.drawing import drawn_png
from packwork.scene.item import Item, VectorArt
from packwork.scene.layout import Layout
from packwork.writers.bitmaps import ON_WHITE, png_bytes
from packwork.writers.frame import MAX_SIDE_PX, picture_frame
from packwork.writers.svg import SvgOptions, svg_text

WITH_LINE = replace(ON_WHITE, show_container=True)


ReadPicture = Callable[[bytes], np.ndarray]


def test_golden(three: Layout, assert_same_picture: Callable[[bytes, str], None]) -> None:
    assert_same_picture(png_bytes(three, 160, WITH_LINE), "three.png")


@pytest.mark.xfail(
    raises=pytest.fail.Exception, strict=True, reason="proves that the comparison can fail"
)
def test_golden_of_another_layout(
    three: Layout, assert_same_picture: Callable[[bytes, str], None]
) -> None:
    moved = replace(three, poses=replace(three.poses, x=three.poses.x + 0.5))
    assert_same_picture(png_bytes(moved, 160, WITH_LINE), "three.png")


def test_flattened_looks_the_same(three: Layout, read_picture: ReadPicture) -> None:
    used, full = (
        read_picture(drawn_png(svg_text(three, SvgOptions(flatten=flatten))))
        for flatten in (False, True)
    )
    assert np.abs(used - full).max() <= 2


@pytest.mark.parametrize("longer_side_px", [1, 7, 80, 333, 1000])
@pytest.mark.parametrize("height", [60.0, 37.3, 0.1, 80.0, 79.99])
def test_size_is_exact_and_filled(
    three: Layout, read_picture: ReadPicture, longer_side_px: int, height: float
) -> None:
    layout = replace(three, container=replace(three.container, height=height))
    picture = read_picture(png_bytes(layout, longer_side_px))
    frame = picture_frame(layout.container, longer_side_px)
    assert picture.shape[:2] == (frame.rows, frame.columns)
    assert max(frame.rows, frame.columns) == longer_side_px
    assert (picture[..., 3] == 255).all(), "the background reaches every edge"


def test_transparent_background(three: Layout, read_picture: ReadPicture) -> None:
    picture = read_picture(png_bytes(three, 80, SvgOptions(background="transparent")))
    assert picture[0, 0].tolist() == [0, 0, 0, 0]
    assert read_picture(png_bytes(three, 80))[0, 0].tolist() == [255, 255, 255, 255]


@pytest.mark.usefixtures("machine")
@pytest.mark.parametrize("family", ["No Such", "serif", "DejaVu Sans"])
def test_letters_are_painted_whatever_fonts_there_are(
    three: Layout, read_picture: ReadPicture, family: str
) -> None:
    letters = f'<text font-family="{family}" font-size="20" text-anchor="middle" y="8">HO</text>'
    lettered = Item(
        "sign", "", three.items[0].outline, three.items[0].ink, VectorArt(letters, identity())
    )
    layout = replace(three, items=(lettered,) * len(three.items))
    picture = read_picture(png_bytes(layout, 160))
    assert (picture[..., :3].max(axis=2) < 128).mean() > 0.02


@pytest.mark.parametrize("longer_side_px", [0, -5, MAX_SIDE_PX + 1])
def test_size_out_of_bounds(three: Layout, longer_side_px: int) -> None:
    with pytest.raises(RecipeError, match=f"1 to {MAX_SIDE_PX} px, not {longer_side_px}"):
        png_bytes(three, longer_side_px)


def test_too_many_pixels(three: Layout) -> None:
    with pytest.raises(RecipeError, match="20000 x 15000 px are too many"):
        png_bytes(three, MAX_SIDE_PX)


def test_bad_background_is_refused() -> None:
    with pytest.raises(RecipeError, match="background"):
        SvgOptions(background="#12")


class PanicException(BaseException):
    """Named as what a panic of the native library is raised as."""


def test_a_panic_of_the_renderer_is_one_clear_line(
    three: Layout, monkeypatch: pytest.MonkeyPatch
) -> None:
    def panic(**_: object) -> bytes:
        raise PanicException("index out of\nbounds")

    monkeypatch.setattr(resvg_py, "svg_to_bytes", panic)
    with pytest.raises(WriteError, match=r"cannot be rendered .index out of bounds"):
        png_bytes(three, 40)


def test_an_interruption_of_the_renderer_passes(
    three: Layout, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(**_: object) -> bytes:
        raise KeyboardInterrupt

    monkeypatch.setattr(resvg_py, "svg_to_bytes", stop)
    with pytest.raises(KeyboardInterrupt):
        png_bytes(three, 40)


def test_broken_art_is_one_clear_line(make_layout: Callable[..., Layout], star_item: Item) -> None:
    broken = replace(star_item, art=VectorArt("<g>", np.eye(2, 3)))
    with pytest.raises(WriteError, match="cannot be rendered") as caught:
        png_bytes(make_layout([broken]), 40)
    assert "\n" not in str(caught.value)
