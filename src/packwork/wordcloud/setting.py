"""Frequencies to placed words: the engine's part of a cloud."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from packwork import pipeline, uses
from packwork.finish.finish import Finished
from packwork.forces.forces import Forces
from packwork.geometry.outline import Outline
from packwork.pipeline.job import Job
from packwork.pipeline.result import Run
from packwork.pipeline.run import run_along
from packwork.pipeline.start import Beginning
from packwork.pipeline.use import Use
from packwork.progress import Observer, Stop
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.pictures.mask import mask_of_pixels
from packwork.readers.unfit import UnfitError
from packwork.readers.words.items import EM_PX, word_item
from packwork.readers.words.word import Word
from packwork.recipe import make_recipe
from packwork.scene.canvas import placed_container
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.uses.words.letters import held_down

SMALLEST_CANVAS = 4
"""Pixels on a side below which nothing is tried. Chosen."""

TURN_STEPS = 20
"""Steps in which the share of horizontal words is kept. Chosen."""

DENSE = 0.4
"""Share of the room that words cover in a cloud that went well. Larger tries too many words,
which takes time, smaller leaves out some that would fit. Measured on plain canvases."""

FEWER = 0.6
"""Share of the words that is tried next, where the smallest would be too small. Chosen."""


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
    no_room = ValueError(
        "Couldn't find space to draw. Either the Canvas size is too small or too much of the "
        "image is masked out."
    )
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
    >>> (found.layout.poses.scale * EM_PX).round(6).tolist()
    [20.0, 10.0]
    """
    items, undrawn = _items(words, asked.fonts)
    kept = _likely(asked, items, heights)
    seed = random.randrange(2**31)
    while kept:
        layout = _solved(asked, [items[k] for k in kept], heights[kept], seed)
        ems = layout.poses.scale * EM_PX
        if float(ems.min()) >= asked.smallest:
            return Placed(layout, tuple(kept), undrawn)
        kept = kept[: int(FEWER * len(kept))]
    raise ValueError(
        "Couldn't find space to draw. Either the Canvas size is too small or too much of the "
        "image is masked out."
    )


def _items(words: Sequence[str], fonts: Fonts) -> tuple[dict[int, Item], dict[str, str]]:
    items, undrawn = dict[int, Item](), dict[str, str]()
    for number, text in enumerate(words):
        try:
            item = word_item(Word(text.replace("|", " "), 1.0), fonts)
        except UnfitError as error:
            undrawn[text] = str(error)
            continue
        items[number] = replace(item, name=str(number))
    return items, undrawn


def _likely(
    asked: Setting, items: Mapping[int, Item], heights: npt.NDArray[np.float64]
) -> list[int]:
    """As many of the first words as would be large enough in a cloud that went well."""
    kept = list(items)
    areas = np.array([items[k].outline.area * heights[k] ** 2 for k in kept])
    room = DENSE * asked.container.outline.area
    ems = EM_PX * heights[kept] * np.sqrt(room / np.maximum(np.cumsum(areas), 1e-300))
    return kept[: max(int(np.count_nonzero(ems >= asked.smallest)), 1)] if kept else []


@dataclass(frozen=True)
class _LetterBound(Use):
    """Words that are there as items already, no letter larger than so many canvas units."""

    largest: float | None

    def run(self, job: Job, observer: Observer | None, stop: Stop, record: bool) -> Run:
        """The common road."""
        return run_along(job, observer, stop, record)

    def bounded(
        self,
        job: Job,
        start: Beginning,
        exact: Finished,
        observer: Observer | None,
        stop: Stop,
        forces: Forces | None,
    ) -> Finished:
        """Exact poses whose letters are no larger."""
        count = len(job.items)
        return held_down(job, start, exact, count, self.largest, observer, stop, forces)


def _solved(
    asked: Setting, items: Sequence[Item], heights: npt.NDArray[np.float64], seed: int
) -> Layout:
    areas = np.array([item.outline.area for item in items]) * heights**2
    upright = round(TURN_STEPS * min(max(asked.horizontal, 0.0), 1.0))
    turns = ["0"] * upright + ["-90"] * (TURN_STEPS - upright)
    recipe = make_recipe(
        container=asked.container.source,
        items=["-"],
        sizes="shared",
        rotate=",".join(turns),
        padding=asked.margin,
        effort="draft",
        seed=seed,
    )
    job = uses.read(recipe, items, asked.container)
    return pipeline.run(replace(job, weights=areas, use=_LetterBound(asked.largest))).layout


def _is_white(mask: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    whole = mask.astype(np.uint8) if mask.dtype.kind == "f" else mask
    if whole.ndim == 2:
        return np.asarray(whole == 255)
    if whole.ndim == 3:
        return np.asarray((whole[:, :, :3] == 255).all(axis=-1))
    raise ValueError(f"Got mask of invalid shape: {mask.shape}")
