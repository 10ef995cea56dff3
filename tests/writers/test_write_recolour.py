"""New colours: which drawings have one, and that nothing but the colour changes."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from packwork.readers.builtin import builtin_item
from packwork.readers.svg.item import item_of_svg
from packwork.scene.item import FlatArt, Item, PictureArt, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.recolour import has_one_colour, recoloured
from packwork.writers.bitmaps import png_bytes
from packwork.writers.svg import SvgOptions, svg_text

LayoutMaker = Callable[..., Layout]
Reader = Callable[[bytes], np.ndarray]


def drawing(inside: str, root: str = "") -> Item:
    """Item of a drawing as the gate lets it in."""
    links = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    text = f'<svg {links} viewBox="0 0 9 9" {root}>{inside}</svg>'
    return item_of_svg(text.encode(), "drawing", "drawing.svg", "fill")


TRIANGLE = '<path d="M1 1h7v7z"/>'
ONE = {
    "nothing said": TRIANGLE,
    "an attribute": '<path fill="#123456" d="M1 1h7v7z"/>',
    "a style": '<path style="fill:#123456;stroke:rgb(18,52,86)" d="M1 1h7v7z"/>',
    "a sheet": '<style>.a{fill:#123456}</style><path class="a" d="M1 1h7v7z"/>',
    "inherited": f'<g fill="teal">{TRIANGLE}<g stroke="#008080">{TRIANGLE}</g></g>',
    "a line": '<path fill="none" stroke="teal" stroke-width="2" d="M1 1h7v7"/>',
    "the text's colour": f'<g color="teal" fill="currentColor">{TRIANGLE}</g>',
    "a copy": '<defs><path id="a" d="M1 1h7v7z"/></defs><use xlink:href="#a" fill="teal"/>',
    "a cut": '<clipPath id="c"><path fill="red" d="M0 0h5v9H0z"/></clipPath>'
             '<path clip-path="url(#c)" fill="teal" d="M1 1h7v7z"/>',
    "half clear": '<path fill="teal" fill-opacity="0.5" d="M1 1h7v7z"/>',
}  # fmt: skip
SEVERAL = {
    "two fills": f'<g fill="teal">{TRIANGLE}</g><rect fill="red" width="4" height="3"/>',
    "a line round it": '<path fill="teal" stroke="black" d="M1 1h7v7z"/>',
    "said and not said": f'{TRIANGLE}<rect fill="red" width="4" height="3"/>',
    "a copy beside it": '<path id="a" fill="inherit" d="M1 1h7v7z"/>'
                        '<use xlink:href="#a" fill="teal"/>',
    "a gradient": '<linearGradient id="g"><stop stop-color="red"/></linearGradient>'
                  '<path fill="url(#g)" d="M1 1h7v7z"/>',
}  # fmt: skip


@pytest.mark.parametrize("name", ONE)
def test_a_drawing_of_one_colour_changes_its_colour_alone(
    name: str, make_layout: LayoutMaker, read_picture: Reader
) -> None:
    item = drawing(ONE[name])
    assert has_one_colour(item.art)
    other = recoloured(item, "#ff8000")
    assert isinstance(other.art, VectorArt)
    assert has_one_colour(other.art)
    clear = SvgOptions()
    before, after = (
        read_picture(png_bytes(make_layout([one], [40.0], [30.0], scale=[5.0]), 160, clear))
        for one in (item, other)
    )
    np.testing.assert_allclose(before[..., 3], after[..., 3], atol=1)
    solid = after[..., 3] > 100
    assert solid.sum() > 100
    assert np.abs(after[solid][:, :3] - (255, 128, 0)).max() <= 2


@pytest.mark.parametrize("name", SEVERAL)
def test_a_drawing_of_several_becomes_a_silhouette(name: str) -> None:
    item = drawing(SEVERAL[name])
    assert not has_one_colour(item.art)
    other = recoloured(item, "#ff8000")
    assert other.art == FlatArt("#ff8000")
    assert other.ink is item.ink


@pytest.mark.parametrize(("name", "is_one"), [("bolt", True), ("owl", False), ("star", True)])
def test_bundled_items(name: str, is_one: bool) -> None:
    assert has_one_colour(builtin_item(name).art) is is_one


def picture(*colours: tuple[int, int, int, int]) -> PictureArt:
    target = io.BytesIO()
    Image.fromarray(np.array([colours], np.uint8)).save(target, format="PNG")
    return PictureArt(target.getvalue(), len(colours), 1, np.eye(2, 3))


@pytest.mark.parametrize(
    ("colours", "is_one"),
    [
        ([(9, 9, 9, 255), (12, 9, 5, 255), (255, 255, 255, 40)], True),
        ([(9, 9, 9, 255), (200, 9, 5, 255)], False),
        ([(9, 9, 9, 0)], False),
    ],
)
def test_pictures(colours: list[tuple[int, int, int, int]], is_one: bool) -> None:
    assert has_one_colour(picture(*colours)) is is_one


def test_a_broken_picture_keeps_its_colours() -> None:
    assert not has_one_colour(PictureArt(b"no picture", 1, 1, np.eye(2, 3)))


def test_opacity_is_carried() -> None:
    other = recoloured(drawing(TRIANGLE), "#ff800080")
    assert isinstance(other.art, VectorArt)
    assert 'opacity="0.502"' in other.art.markup
    assert "#ff8000" in other.art.markup


def test_one_drawing_in_two_colours_keeps_its_parts_apart(
    make_layout: LayoutMaker, read_picture: Reader
) -> None:
    item = drawing(ONE["a copy"])
    red, blue = recoloured(item, "#ff0000"), recoloured(item, "#0000ff")
    layout = make_layout([red, blue], [20.0, 60.0], [30.0, 30.0], scale=[4.0, 4.0])
    pixels = read_picture(png_bytes(layout, 160))
    for column, colour in ((40, (255, 0, 0)), (120, (0, 0, 255))):
        assert np.abs(pixels[60, column, :3] - colour).max() <= 2
    text = svg_text(layout)
    ids = [part.split('"')[0] for part in text.split(' id="')[1:]]
    assert len(set(ids)) == len(ids)


def test_the_label_is_kept() -> None:
    item = replace(drawing(TRIANGLE), name="other")
    assert recoloured(item, "#ff0000").name == "other"
