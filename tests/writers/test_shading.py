"""Drawings of several colours in a palette's: shading stays, in drawings and pictures alike."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from packwork import uses
from packwork.geometry.outline import Outline
from packwork.recipe import make_recipe
from packwork.scene.contrast import oklab
from packwork.scene.item import FlatArt, Item, PictureArt, VectorArt
from packwork.uses.words.recipe import words_recipe
from packwork.writers.recolour_drawings import APART, in_palette, in_shades_of
from scenes import box

BLUE = "#0072b2"
APPLE = (
    '<g fill="#dd2e44"><path d="M0 2h9v7H0z"/></g><path fill="#77b255" d="M5 0h3v2H5z"/>'
    '<path d="M4 0h1v2H4z"/><path fill="white" d="M1 3h1v1H1z"/>'
)


def drawn(markup: str) -> Item:
    ink = box(0, 0, 9, 9)
    return Item("apple", "apple", ink, ink, VectorArt(markup, np.eye(2, 3)))


def pictured(pixels: Any) -> Item:
    array = np.array(pixels, dtype=np.uint8)
    out = io.BytesIO()
    Image.fromarray(array).save(out, "PNG")
    height, width = array.shape[:2]
    ink: Outline = box(0, 0, width, height)
    return Item("photo", "", ink, ink, PictureArt(out.getvalue(), width, height, np.eye(2, 3)))


def markup(item: Item) -> str:
    assert isinstance(item.art, VectorArt)
    return item.art.markup


def pixels(item: Item) -> Any:
    assert isinstance(item.art, PictureArt)
    with Image.open(io.BytesIO(item.art.png)) as picture:
        return np.asarray(picture.convert("RGBA"))


def colours(text: str) -> list[str]:
    return re.findall(r'(?:fill|stroke|stop-color)="(#[0-9a-f]+)"', text)


def hue(colour: str) -> float:
    return float(np.arctan2(*oklab(colour)[[2, 1]]))


def test_shades_are_of_one_hue_and_keep_their_order() -> None:
    found = markup(in_shades_of(drawn(APPLE), BLUE))
    black, red, green, white = colours(found)
    assert (black, white) == ("#000000", "#ffffff")
    assert [hue(red), hue(green)] == pytest.approx([hue(BLUE)] * 2, abs=0.15)
    assert oklab(red)[0] + APART <= oklab(green)[0] + 0.01
    assert oklab(red)[0] == pytest.approx(oklab(BLUE)[0], abs=0.1)


def test_what_says_no_colour_is_black() -> None:
    assert colours(markup(in_shades_of(drawn(APPLE), BLUE)))[0] == "#000000"


def test_gradients_and_lines_are_shaded_too() -> None:
    text = (
        '<defs><linearGradient id="g"><stop stop-color="red"/><stop stop-color="#400"/>'
        '</linearGradient></defs><path fill="url(#g)" stroke="lime" d="M0 0h9v9z"/>'
    )
    found = markup(in_shades_of(drawn(text), BLUE))
    assert len(colours(found)) == 4
    assert "red" not in found
    assert "lime" not in found
    assert re.search(r'fill="url\(#g[^)]*\)"', found)


def test_masks_keep_their_colours_and_opacity_stays() -> None:
    text = (
        '<mask id="m"><path fill="white" d="M0 0h5v9z"/></mask>'
        '<path mask="url(#m)" fill="#ff000080" d="M0 0h9v9z"/><path fill="blue" d="M0 0h2v2z"/>'
    )
    found = markup(in_shades_of(drawn(text), "#00aa00"))
    assert '<path fill="white"' in found
    assert re.search(r'fill="#[0-9a-f]{6}80"', found)


def test_one_colour_becomes_that_colour() -> None:
    assert BLUE in markup(in_shades_of(drawn('<path fill="red" d="M0 0h9v9z"/>'), BLUE))
    flat = replace(drawn(""), art=FlatArt("red"))
    assert in_shades_of(flat, BLUE).art == FlatArt(BLUE)


def test_each_colour_becomes_the_nearest() -> None:
    found = markup(in_palette(drawn(APPLE), ("#d55e00", "#009e73")))
    assert colours(found) == ["#000000", "#d55e00", "#009e73", "#ffffff"]


@pytest.mark.parametrize(
    "change", [lambda i: in_shades_of(i, BLUE), lambda i: in_palette(i, (BLUE,))]
)
def test_pictures_and_pictures_in_drawings_alike(change: Callable[[Item], Item]) -> None:
    item = pictured([[[200, 30, 30, 255], [255, 255, 255, 255], [90, 10, 10, 100]]])
    after = pixels(change(item))
    assert after[0, :, 3].tolist() == [255, 255, 100]
    assert after[0, 1, :3].tolist() == [255, 255, 255]
    assert after[0, 0, 2] > after[0, 0, 0]
    assert isinstance(item.art, PictureArt)
    data = base64.b64encode(item.art.png).decode()
    image = f'<image width="3" height="1" href="data:image/png;base64,{data}"/>'
    found = markup(change(drawn(image)))
    again = base64.b64decode(found.partition("base64,")[2].partition('"')[0])
    with Image.open(io.BytesIO(again)) as picture:
        assert np.asarray(picture)[0, 0, 2] > np.asarray(picture)[0, 0, 0]


def dressed(shades: str, **options: Any) -> list[str]:
    recipe = make_recipe(
        container="circle", items=["owl", "star"], count=4, palette=[BLUE, "#d55e00"],
        shades=shades, epochs=3, levels="16", **options,
    )  # fmt: skip
    layout = uses.fill(recipe).layout
    return [i.art.markup if isinstance(i.art, VectorArt) else str(i.art) for i in layout.items]


def test_a_palette_reaches_drawings_of_several_colours_unless_they_keep_theirs() -> None:
    kept, tinted, nearest = (dressed(shades)[0] for shades in ("keep", "tint", "nearest"))
    assert len({kept, tinted, nearest}) == 3
    assert set(colours(nearest)) - set(colours(kept)) <= {BLUE, "#d55e00", "#000000"}
    for shades in ("keep", "tint", "nearest"):
        assert dressed(shades)[1] in {str(FlatArt(BLUE)), str(FlatArt("#d55e00"))}


def test_a_rule_goes_before_the_palette() -> None:
    rules = [{"items": "owl", "color": "#009e73"}]
    for shades in ("tint", "nearest"):
        assert dressed(shades, rules=rules)[0] == str(FlatArt("#009e73"))


def test_among_words_icons_keep_their_colours() -> None:
    plain = uses.fill(make_recipe(container="circle", items=["owl"], epochs=3, levels="16"))
    recipe = words_recipe("circle", {"ox": 1}, add=["owl"], effort="draft")
    assert uses.fill(recipe).layout.items[1].art is not None
    before, after = plain.layout.items[0].art, uses.fill(recipe).layout.items[1].art
    assert isinstance(before, VectorArt)
    assert isinstance(after, VectorArt)
    assert before.markup == after.markup
