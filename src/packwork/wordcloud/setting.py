"""Frequencies to placed words: the engine's part of a cloud."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from packwork import pipeline, uses
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.pictures.mask import mask_of_pixels
from packwork.readers.unfit import UnfitError
from packwork.readers.words.items import WordsRead, word_item
from packwork.readers.words.options import WordOptions
from packwork.readers.words.word import Word
from packwork.recipe import make_recipe
from packwork.scene.canvas import placed_container
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.uses.words.letters import Letters
from packwork.uses.words.use import Words

SMALLEST_CANVAS = 4
"""Pixels on a side below which nothing is tried. Chosen."""

TURN_STEPS = 20
"""Steps in which the share of horizontal words is kept. Chosen."""

NO_ROOM = (
    "Couldn't find space to draw. Either the Canvas size is too small or too much of the image is "
    "masked out."
)


@dataclass(frozen=True, eq=False)
class Setting:
    """What a cloud asks of the engine.

    Parameters
    ----------
    container
        In pixels of the canvas.
    fonts
        That set the words.
    margin
        Least distance of two words, pixels.
    horizontal
        Share of words that are not turned.
    smallest, largest
        Bounds of the height of an em, pixels; None for no upper one.
    """

    container: Container
    fonts: Fonts
    margin: float
    horizontal: float
    smallest: float
    largest: float | None


@dataclass(frozen=True, eq=False)
class Placed:
    """A layout of words.

    Parameters
    ----------
    layout
        One item per entry, named by the entry's number.
    entries
        Which of the words are there, in the layout's order.
    undrawn
        Words that no font could draw, each with the reason.
    """

    layout: Layout
    entries: tuple[int, ...]
    undrawn: dict[str, str]


def container_of_mask(mask: npt.NDArray[Any] | None, width: int, height: int) -> Container:
    """Canvas of that size, or what a mask leaves free: all that is not white.

    Raises
    ------
    ValueError
        If the mask is no picture or nothing is free.

    Examples
    --------
    >>> container_of_mask(None, 40, 20).outline.area
    800.0
    """
    no_room = ValueError(NO_ROOM)
    if min(width, height) < SMALLEST_CANVAS:
        raise no_room
    dark = None if mask is None else ~_is_white(mask)
    if dark is None or dark.all():
        outline = Outline.from_region(shapely.box(0, 0, width, height))
        return Container("canvas", "canvas", outline, float(width), float(height))
    if not dark.any():
        raise no_room
    pixels = np.full((*dark.shape, 4), 255, dtype=np.uint8)
    pixels[..., :3] = np.where(dark, 0, 255)[..., None]
    try:
        traced = mask_of_pixels(pixels)
    except UnfitError:
        raise no_room from None
    canvas = (0.0, 0.0, float(width), float(height))
    return placed_container("mask", "mask", traced.region, canvas, float(max(width, height)))


def relative_heights(frequencies: Sequence[float], scaling: float) -> npt.NDArray[np.float64]:
    """``(n,)`` heights of words, the first as 1: each from the one before it.

    Examples
    --------
    >>> relative_heights([1.0, 0.5], 1.0).tolist(), relative_heights([1.0, 0.5], 0.5).tolist()
    ([1.0, 0.5], [1.0, 0.75])
    """
    known = np.array(frequencies, dtype=np.float64)
    steps = scaling * known[1:] / known[:-1] + 1 - scaling
    return np.cumprod([1.0, *steps])


def placed(
    asked: Setting, words: Sequence[str], heights: npt.NDArray[np.float64], random: Random
) -> Placed:
    """Words in the proportion of their heights; fewer where the least would be too small.

    Raises
    ------
    ValueError
        If not even one word is large enough.

    Examples
    --------
    >>> from packwork.readers.fonts.fallback import open_fonts
    >>> asked = Setting(container_of_mask(None, 90, 60), open_fonts([]), 1.0, 1.0, 4.0, 20.0)
    >>> found = placed(asked, ["ox", "bee"], np.array([1.0, 0.5]), Random(0))
    >>> (100 * found.layout.poses.scale).round(6).tolist()
    [20.0, 10.0]
    """
    read = _read(words, heights, asked.fonts)
    if not read.items:
        raise ValueError(NO_ROOM)
    upright = round(TURN_STEPS * min(max(asked.horizontal, 0.0), 1.0))
    turns = ["0"] * upright + ["-90"] * (TURN_STEPS - upright)
    recipe = make_recipe(
        container=asked.container.source,
        items=["-"],
        sizes="shared",
        rotate=",".join(turns),
        padding=asked.margin,
        effort="draft",
        seed=random.randrange(2**31),
    )
    job = uses.read(recipe, read.items, asked.container)
    use = Words(read, WordOptions(source={}), Letters(asked.smallest, asked.largest))
    try:
        layout = pipeline.run(replace(job, weights=read.areas, use=use)).layout
    except RecipeError:
        raise ValueError(NO_ROOM) from None
    return Placed(layout, tuple(int(item.name) for item in layout.items), dict(read.undrawn))


def _read(words: Sequence[str], heights: npt.NDArray[np.float64], fonts: Fonts) -> WordsRead:
    """Words as items, each named by its number."""
    items, kept, undrawn = list[Item](), list[int](), dict[str, str]()
    for number, text in enumerate(words):
        try:
            item = word_item(Word(text.replace("|", " "), 1.0), fonts)
        except UnfitError as error:
            undrawn[text] = str(error)
            continue
        items.append(replace(item, name=str(number)))
        kept.append(number)
    areas = np.array([item.outline.area for item in items]) * heights[kept] ** 2
    said = tuple(Word(words[k], float(heights[k])) for k in kept)
    return WordsRead(tuple(items), areas, said, undrawn, len(words))


def _is_white(mask: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    whole = mask.astype(np.uint8) if mask.dtype.kind == "f" else mask
    if whole.ndim == 2:
        return np.asarray(whole == 255)
    if whole.ndim == 3:
        return np.asarray((whole[:, :, :3] == 255).all(axis=-1))
    raise ValueError(f"Got mask of invalid shape: {mask.shape}")
