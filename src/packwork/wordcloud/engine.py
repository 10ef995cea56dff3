"""Frequencies to placed words, and these to pixels: the engine's part of a cloud."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from random import Random
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely
from PIL import Image

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser
from packwork.readers.fonts.drawn import drawn_outline
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.pictures.mask import mask_of_shares
from packwork.readers.reading import UnfitError
from packwork.readers.words.shaping import (
    EM_PX,
    WORD_SPACE,
    ShapedWord,
    lines_to_set,
    shaped_word,
)
from packwork.readers.words.word import Word
from packwork.scene.container import Container, placed_container
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.start.first_fit.graded import graded_fit
from packwork.start.first_fit.greedy_board import Candidate, image_side

SMALLEST_CANVAS = 4
"""Pixels on a side below which nothing is tried. Chosen."""

PATIENCE = 10
"""Words in a row that may find no place before all others are left out. Larger looks longer for
short words that would still fit. Chosen."""

MOST_HELD = 300
"""Words up to which those in the middle leave room for the last; of thousands, the last would be
specks in place of words that fill. Tried."""

UPRIGHT = 10
"""Words, the first, that are not turned where most are not: one large turned word is what is seen
first. By eye."""

REGAINED = 0.7
"""How much of what a word lacks at its size, since no larger one found a place, later ones have
again. With 0 one long phrase makes specks of what follows, with 1 emoji come out alike. Tried."""

LEAST_PX, MOST_PX = 800, 1_200
"""Sides of the image on which places are sought, at least and at most. Smaller lose ink, larger
take longer. Tried."""

WHOLE = 1.75
"""How many pixels of that image one of the canvas is worth from which on they are a whole number,
so that margins are too. Chosen."""

SHOWN_PX, COARSEST = 2_500.0, 32.0
"""Pixels of the side of a picture in which curves are followed as finely: a twentieth of one of the
canvas; and coarseness at most. Smaller shows in enlarged clouds, larger takes longer. Chosen."""

EDGE = 0.01
"""Room along the edge of a canvas, as a share of its shorter side, where margins are narrower:
words cut off by the edge is what it looks like with less. By eye."""

NO_ROOM = (
    "Couldn't find space to draw. Either the Canvas size is too small or too much of the "
    "image is masked out."
)


@dataclass(frozen=True, eq=False)
class CloudSettings:
    """Settings of a cloud for the engine; lengths in pixels of the canvas.

    ``margin`` is twice the least distance of two words, and of a word and the edge: what the other
    package leaves round the box of a word. ``horizontal`` is the share of words that are not
    turned; ``smallest`` and ``largest`` (None for no bound) are heights of an em, ``step`` by how
    much sizes that are tried differ at least.
    """

    container: Container
    fonts: Fonts
    margin: float
    horizontal: float
    smallest: float
    largest: float | None
    step: float = 1.0


@dataclass(frozen=True, eq=False)
class DrawnWord:
    """A word as it is drawn on pixels: rings about their centre, an em being ``EM_PX``.

    ``place`` (2 x 3) brought them there. Rings may lie over each other: where letters meet, their
    union would take several times as long as all else.
    """

    word: Word
    outline: Outline
    place: FloatArray
    has_pictures: bool = False

    @classmethod
    def of(cls, word: Word, fonts: Fonts, em: float) -> DrawnWord:
        """Word of an em of such a share of the picture's side; an UnfitError if it has no form."""
        found = drawn_outline(fonts, lines_to_set(word), em, COARSEST, EM_PX)
        if found is not None:
            return cls(word, *found)
        shaped = shaped_word(word, fonts, "keep", em, COARSEST)
        return cls(word, shaped.ink, shaped.place, bool(shaped.drawn.pictures))


@dataclass(frozen=True, eq=False)
class PlacedWords:
    """Words in place, by number of those asked for, and why others could not be drawn."""

    container: Container
    words: tuple[DrawnWord, ...]
    poses: Poses
    entries: tuple[int, ...]
    undrawn: dict[str, str]
    fonts: Fonts

    @cached_property
    def outlines(self) -> tuple[Outline, ...]:
        """Outlines of the words, in place."""
        return tuple(word.outline.mapped(self.poses.matrix(k)) for k, word in enumerate(self.words))

    @cached_property
    def layout(self) -> Layout:
        """One item per entry, its curves followed as finely as in a print."""
        shaped = [self._as_in_a_print(word.word) for word in self.words]
        items = tuple(word.item for word in shaped)
        areas = np.array([item.outline.area for item in items]) * self.poses.scale**2
        # Centres of what is drawn and of what it covers are not quite the same.
        off = [
            one.place[:, 2] - two.place[:, 2] for one, two in zip(self.words, shaped, strict=True)
        ]
        moved = [affine.apply(self.poses.matrix(k), way[None])[0] for k, way in enumerate(off)]
        x, y = np.reshape(moved, (-1, 2)).T
        return Layout(self.container, items, replace(self.poses, x=x, y=y), areas)

    def _as_in_a_print(self, word: Word) -> ShapedWord:
        """The word, as coarse as it may be drawn where its font is too rich for more."""
        try:
            return shaped_word(word, self.fonts, "keep")
        except UnfitError:
            return shaped_word(word, self.fonts, "keep", 1e-6, COARSEST)


def container_of_mask(mask: npt.NDArray[Any] | None, width: int, height: int) -> Container:
    """Canvas of that size, or what a mask leaves free: all that is not white."""
    no_room = ValueError(NO_ROOM)
    if min(width, height) < SMALLEST_CANVAS:
        raise no_room
    dark = None if mask is None else ~_is_white(mask)
    if dark is None or dark.all():
        outline = Outline.from_region(shapely.box(0, 0, width, height))
        return Container("canvas", "canvas", outline, float(width), float(height))
    if not dark.any():
        raise no_room
    try:
        traced = mask_of_shares(dark.astype(np.float64))
    except UnfitError:
        raise no_room from None
    canvas = (0.0, 0.0, float(width), float(height))
    return placed_container("mask", "mask", traced.region, canvas, float(max(width, height)))


def scaled_layout(layout: Layout, scale: float) -> Layout:
    """The same layout on a canvas ``scale`` times as large."""
    canvas, poses = layout.container, layout.poses
    larger = replace(
        canvas,
        outline=canvas.outline.mapped(similarity(0.0, 0.0, 0.0, scale)),
        width=canvas.width * scale,
        height=canvas.height * scale,
    )
    moved = replace(poses, x=poses.x * scale, y=poses.y * scale, scale=poses.scale * scale)
    return replace(layout, container=larger, poses=moved)


def relative_steps(frequencies: Sequence[float], scaling: float) -> FloatArray:
    """``(n,)`` how many times as high as the word before each may be; the first 1.

    Examples
    --------
    >>> relative_steps([1.0, 0.5], 1.0).tolist(), relative_steps([1.0, 0.5], 0.5).tolist()
    ([1.0, 0.5], [1.0, 0.75])
    """
    known = np.array(frequencies, dtype=np.float64)
    return np.concatenate([[1.0], scaling * known[1:] / known[:-1] + 1 - scaling])


def place_words(
    asked: CloudSettings, words: Sequence[str], steps: FloatArray, random: Random
) -> PlacedWords:
    """Words one after another, each as large as it finds a place, none larger than one before.

    A ValueError if not even one word is large enough.

    Examples
    --------
    >>> from packwork.readers.fonts.fallback import open_fonts
    >>> asked = CloudSettings(container_of_mask(None, 90, 60), open_fonts([]), 1.0, 1.0, 4.0, 20.0)
    >>> found = place_words(asked, ["ox", "bee"], np.array([1.0, 0.5]), Random(0))
    >>> (found.poses.scale * EM_PX).tolist()
    [20.0, 10.0]
    """
    read = _ReadCloud(asked, words, steps, random)
    container = _with_edge(asked)
    largest = asked.largest or float(asked.container.height)
    rng = np.random.default_rng(random.randrange(2**31))
    found = graded_fit(
        container,
        read.candidates(largest),
        len(words),
        rng,
        smallest=asked.smallest / EM_PX,
        grid=1 / EM_PX,
        drop=asked.step / EM_PX,
        margin_cu=asked.margin / 2,
        patience=PATIENCE,
        lengths=[len(word) for word in words] if len(words) <= MOST_HELD else (),
        is_first_bounded=asked.largest is not None,
        regained=REGAINED,
        side_px=_image_side(asked.container, len(words)),
    )
    if len(found.placed) == 0:
        raise ValueError(NO_ROOM)
    entries = tuple(read.numbers[k] for k in found.placed)
    shown = tuple(read.shaped[number] for number in entries)
    return PlacedWords(asked.container, shown, found.poses, entries, read.undrawn, asked.fonts)


def _image_side(container: Container, count: int) -> int:
    """Pixels of the side of the image on which places are sought."""
    side = image_side(count, LEAST_PX, MOST_PX)
    times = side / container.side
    return round(round(times) * container.side) if times >= WHOLE else side


class _ReadCloud:
    """Words that are set when their turn comes: most of a long text finds no room.

    ``shaped`` are those read so far, ``numbers`` those of the candidates given, in their order.
    """

    def __init__(
        self, asked: CloudSettings, words: Sequence[str], steps: FloatArray, random: Random
    ) -> None:
        self.shaped, self.undrawn = dict[int, DrawnWord](), dict[str, str]()
        self.numbers: list[int] = []
        self._asked, self._words, self._steps = asked, words, steps
        upright, turned = 0.0, -np.pi / 2
        self._angles = [
            (upright, turned) if random.random() < asked.horizontal else (turned, upright)
            for _ in words
        ]

    def candidates(self, largest: float) -> Iterator[Candidate]:
        """All words, the first of an em of ``largest`` pixels at most."""
        step = largest / EM_PX
        # Powers of two, as words are remembered by them.
        most = np.maximum(np.cumprod(self._steps) * largest, 1.0)
        ems = np.exp2(np.ceil(np.log2(most / SHOWN_PX)))
        has_kinds = len(set(self._words)) > 1
        for number in range(len(self._words)):
            step *= self._steps[number]
            word = self._word(number, float(ems[number]))
            if word is None:
                continue
            self.numbers.append(number)
            kind = self._words[number] if has_kinds else None
            yield Candidate(word.outline, step, self._angles_of(number), WORD_SPACE, kind)
            step = 1.0

    def _angles_of(self, number: int) -> tuple[float, ...]:
        """The angles to try in turn; the largest words are upright where most are."""
        angles, horizontal = self._angles[number], self._asked.horizontal
        if number < UPRIGHT and horizontal >= 0.5:
            return (0.0,)
        return angles[: 1 if horizontal >= 1 else 2]

    def _word(self, number: int, em: float) -> DrawnWord | None:
        """The word in its font, its counters open; None if it cannot be drawn."""
        text = self._words[number]
        if number not in self.shaped and text not in self.undrawn:
            try:
                word = Word(text.replace("|", " "), 1.0)
                self.shaped[number] = DrawnWord.of(word, self._asked.fonts, em)
            except UnfitError as error:
                self.undrawn[text] = str(error)
        return self.shaped.get(number)


def _with_edge(asked: CloudSettings) -> Container:
    """Container of words: of a canvas, without the pixels along its edge."""
    container = asked.container
    if container.outline.area < container.width * container.height:
        return container
    edge = max(asked.margin / 2, EDGE * min(container.width, container.height)) - asked.margin / 2
    left, top, right, bottom = container.outline.bounds
    if right - left <= 4 * edge or bottom - top <= 4 * edge:
        return container
    inner = Outline.box(left + edge, top + edge, right - edge, bottom - edge)
    return replace(container, outline=inner)


def _is_white(mask: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    whole = mask.astype(np.uint8) if mask.dtype.kind == "f" else mask
    if whole.ndim == 2:
        return np.asarray(whole == 255)
    if whole.ndim == 3:
        return np.asarray((whole[:, :, :3] == 255).all(axis=-1))
    raise ValueError(f"Got mask of invalid shape: {mask.shape}")


FAINT = 4
"""Coverage, of 255, below which a pixel of an edge is left out, so that clouds in other
colours fill the same pixels. Chosen."""

Colour = tuple[int, int, int, int]


def paint(picture: Image.Image, words: Iterable[tuple[Outline, Colour]], scale: float) -> None:
    """Lay words over a picture (RGBA), ``scale`` of its pixels to one unit of theirs."""
    for outline, colour in words:
        seen = outline if scale == 1 else outline.mapped(similarity(0.0, 0.0, 0.0, scale))
        left, top = (max(math.floor(v), 0) for v in seen.bounds[:2])
        ends = zip(seen.bounds[2:], picture.size, strict=True)
        right, bottom = (min(math.ceil(v), most) for v, most in ends)
        if left < right and top < bottom:
            mask = _opacity(seen, left, top, right, bottom, colour[3])
            tile = Image.new("RGBA", mask.size, colour)
            tile.putalpha(mask)
            picture.alpha_composite(tile, (left, top))


def _opacity(
    outline: Outline, left: int, top: int, right: int, bottom: int, most: int
) -> Image.Image:
    """Share of each pixel of a box that an outline covers, of ``most``."""
    rasteriser = Rasteriser((bottom - top, right - left))
    rasteriser.sweep(outline.points - (left, top), outline.starts)
    covered = rasteriser.density().clip(0.0, 1.0)
    covered[covered < FAINT / 255] = 0.0
    return Image.fromarray(np.rint(covered * most).astype(np.uint8))
