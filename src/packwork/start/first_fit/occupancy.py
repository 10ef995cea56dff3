"""A container as whole pixels, each taken or not, and stencils: the pixels that an item takes."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.fields.distance_transform import distance_inside, distance_to
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import grown
from packwork.raster.coverage import TOUCHED, Rasteriser
from packwork.start.first_fit.kernels import row_bits, touching

Bits: TypeAlias = NDArray[np.uint64]
"""Rows of pixels, 64 in a word, the lowest bit leftmost."""

REACH = 3
"""Width of a fringe, pixels, in which taken pixels are counted. More tell better which place is
best, up to a point, and take longer. Tried."""

NOISE = 0.01
"""Random part of a place's score, which is 0 to 1: it makes seeds differ. Chosen."""

MOST_OFFSET_PX = 2.0
"""Margin up to which vertices are moved, which takes hardly any time; wider ones are drawn round
the outline. Larger fills more beyond the corners of bays. Chosen."""

TALLEST = 3
"""Log2 of the greatest height of boxes that are looked at in one step. Larger takes more memory and
longer to keep up, smaller cuts stems of letters in more pieces. Chosen."""

WIDEST = 7
"""The same of their widths."""


@dataclass(frozen=True, eq=False)
class Stencil:
    """Pixels that an item takes, about a pixel's corner.

    ``mask``: ``(rows, columns)`` which pixels of its box it takes; one at least.
    ``origin``: row and column of the item's own origin in that box; it may lie off the box.
    ``boxes``: ``(r, 6)`` the same as boxes, which may overlap: row, first column, height, width,
    and log2 of these; large ones first, as they are the first to meet something.
    ``reach``: width of the fringe round it, pixels.
    """

    mask: BoolArray
    origin: tuple[int, int]
    boxes: IntArray
    reach: int

    @cached_property
    def fringe(self) -> IntArray:
        """``(m, 2)`` rows and columns of the pixels round it; asked for where it has a place."""
        return np.asarray(row_bits.fringe_of(self.mask, self.reach))


def cut(outline_px: Outline, reach: int, margin_px: float = 0.0) -> Stencil:
    """Stencil of an outline about its origin.

    ``outline_px``: in pixels, origin where a pixel's corner will be put.
    ``reach``: width of the fringe round it, pixels.
    ``margin_px``: how far round the outline pixels count as taken as well.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [2, -1], [2, 1], [-1, 1]])])
    >>> one = cut(tile, 1)
    >>> one.mask.tolist(), one.origin, len(one.fringe)
    ([[True, True, True], [True, True, True]], (1, 1), 14)
    >>> cut(tile, 1, 0.5).mask.shape
    (4, 5)
    """
    return stencil_of(*covered(outline_px, margin_px), reach)


def covered(
    outline_px: Outline, margin_px: float = 0.0, is_quick: bool = False
) -> tuple[BoolArray, tuple[int, int]]:
    """Pixels that an outline takes, and the row and column of its origin among them.

    Wide margins are drawn round the outline by a buffer of it; those that are quick by distances of
    pixels, which takes up to a tenth of a pixel more, and of letters a tenth of the time.
    """
    points, starts = outline_px.points, outline_px.starts
    reach = margin_px if is_quick and margin_px > MOST_OFFSET_PX else 0.0
    if margin_px > MOST_OFFSET_PX and not is_quick:
        wide = grown(outline_px, margin_px)
        points, starts = wide.points, wide.starts
    elif margin_px > 0 and not reach:
        points = row_bits.offset(points, starts, margin_px)
    x, y = points.T.copy()  # in one piece each, which is faster
    column, row = math.floor(x.min() - reach), math.floor(y.min() - reach)
    right, bottom = math.ceil(x.max() + reach), math.ceil(y.max() + reach)
    width, height = max(right - column, 1), max(bottom - row, 1)
    rasteriser = Rasteriser((height, width))
    here = points - (column, row)
    rasteriser.sweep(here, starts)
    mask = rasteriser.density() > TOUCHED
    if reach:
        row_bits.mark_near(here, starts, reach, mask)
    if not mask.any():
        mask[height // 2, width // 2] = True
    return mask, (-row, -column)


def stencil_of(mask: BoolArray, origin: tuple[int, int], reach: int) -> Stencil:
    """Stencil of pixels; ``reach`` is the width of its fringe."""
    boxes = row_bits.boxes_of(mask, TALLEST, WIDEST)
    boxes = boxes[np.argsort(-boxes[:, 2] * boxes[:, 3], kind="stable")]
    return Stencil(mask, origin, boxes, reach)


MOST_FRINGE = 96
"""Pixels of a fringe that are looked at, unless more are asked for."""


class Occupancy:
    """Bitmap of the taken pixels; it finds places by bits, 64 pixels at a time.

    ``free``: ``(rows, columns)`` the pixels that may be taken.
    ``margin``: pixels by which a fringe may reach out of a box.
    ``most_fringe``: pixels round a stencil that are looked at, at most: every so manieth of a
    longer fringe.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.start.first_fit.occupancy import cut
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]])])
    >>> stencil = cut(tile, 1)
    >>> occupancy = Occupancy(np.ones((2, 5), dtype=bool), 1)
    >>> worth = np.zeros((2, 5))
    >>> while (place := occupancy.best_place(stencil, worth)) is not None:
    ...     score, row, column = place
    ...     print(round(score, 2), row, column)
    ...     occupancy.take(stencil.mask, row, column)
    0.83 0 0
    0.83 0 2
    """

    def __init__(self, free: BoolArray, margin: int, most_fringe: int = MOST_FRINGE) -> None:
        height, width = free.shape
        self.shape = (height, width)
        self._margin, self._most_fringe = margin, most_fringe
        # Beyond the picture all is taken; bits, and bytes to count touched ones on.
        self.taken = np.ones((height + 2 * margin, width + 2 * margin), dtype=np.uint8)
        self.taken[margin : margin + height, margin : margin + width] = ~free
        self._words = -(-width // 64)
        boxes = TALLEST + 1, WIDEST + 1
        self._rows = np.full((*boxes, height, self._words + 1), row_bits.ALL, dtype=np.uint64)
        self._clearance: NearestTaken | None = None
        self._refresh(0, height, 0, width)

    def _refresh(self, top: int, bottom: int, left: int, right: int) -> None:
        """Bitmaps of what was taken in a part of the image."""
        m, width = self._margin, self.shape[1]
        first, end = max(left + 1 - (1 << WIDEST), 0) // 64, -(-right // 64)
        bits = np.ones((bottom - top, (end - first) * 64), dtype=np.uint8)
        inner = self.taken[m + top : m + bottom, m + 64 * first : m + min(64 * end, width)]
        bits[:, : inner.shape[1]] = inner
        words = np.packbits(bits, axis=1, bitorder="little").view("<u8")
        self._rows[0, 0, top:bottom, first:end] = words
        row_bits.smear(self._rows, self._words, top, bottom, first, end)

    def best_place(
        self,
        stencil: Stencil,
        worth: FloatArray,
        is_everywhere: bool = False,
        field: FloatArray | None = None,
        pull: float = 1.0,
        rows: tuple[int, int] | None = None,
        keep: Callable[[Stencil, Bits], None] | None = None,
    ) -> tuple[float, int, int] | None:
        """Score, row and column for the stencil's box where it touches most; None if none.

        ``worth``: ``(rows, columns)`` added to the score, which is 0 to 1, where the origin comes
        to; minus infinity where it may not.
        ``is_everywhere``: look at places that touch nothing, too.
        ``field``, ``pull``: ``(rows, columns)`` that is added as well, so many times; None for
        none.
        ``rows``: first one and end of those that its box may take; None for all.
        ``keep``: clears bits of free places, of all rows, that are out of the question.
        """
        top, bottom = rows or (0, self.shape[0])
        free = self.free_places(stencil, top, bottom)
        is_left = free.any()
        if is_left and keep is not None:
            keep(stencil, free)
            is_left = free.any()
        if not is_left:
            return None
        fringe = stencil.fringe
        if len(fringe) > self._most_fringe:
            fringe = fringe[:: -(-len(fringe) // self._most_fringe)]
        width = self.taken.shape[1]
        steps, begin = fringe[:, 0] * width + fringe[:, 1], self._margin * (width + 1)
        score, row, column = touching.best_touching(
            free, self.taken[top:], begin, steps, stencil.reach, worth[top:],
            worth[top:] if field is None else field[top:], 0.0 if field is None else float(pull),
            np.array(stencil.origin), is_everywhere,
        )  # fmt: skip
        return (float(score), int(row) + top, int(column)) if row >= 0 else None

    def free_places(self, stencil: Stencil, top: int = 0, bottom: int | None = None) -> Bits:
        """``(rows, words + 1)`` bits of the places at which a stencil's box meets nothing.

        ``top``, ``bottom``: first row and end of those that its box may take; None for all.
        """
        bottom = self.shape[0] if bottom is None else bottom
        free = np.full((bottom - top, self._words + 1), row_bits.ALL)
        height = stencil.mask.shape[0]
        row_bits.clear_rows(self._rows, stencil.boxes, height, top, bottom, free)
        return free

    def clear(self, boxes: IntArray, height: int, free: Bits, top: int = 0, word: int = 0) -> bool:
        """Clear bits for the corner of a stencil so high where its boxes meet what is taken.

        ``free``: ``(rows, words)`` of 64 pixels each, from a row and a word on; changed in place.
        Returns whether any is left.
        """
        bottom = self.shape[0]
        return bool(row_bits.clear_taken(self._rows, boxes, height, top, bottom, word, free))

    def take(self, mask: BoolArray, row: int, column: int) -> None:
        """Take the pixels of a mask put there; what of it lies off the image is not kept."""
        height, width = mask.shape
        top, left = max(row, 0), max(column, 0)
        bottom, right = min(row + height, self.shape[0]), min(column + width, self.shape[1])
        if top >= bottom or left >= right:
            return
        m = self._margin
        part = mask[top - row : bottom - row, left - column : right - column]
        self.taken[top + m : bottom + m, left + m : right + m] |= part
        self._refresh(top, bottom, left, right)
        if self._clearance is not None:
            self._clearance.add(part, top, left)

    @property
    def clearance(self) -> NearestTaken:
        """Clearance of each pixel; kept up from the first call on."""
        if self._clearance is None:
            height, width = self.shape
            m = self._margin
            free = self.taken[m : m + height, m : m + width] == 0
            self._clearance = NearestTaken(distance_inside(free), 0.5)
        return self._clearance


class NearestTaken:
    """Distances of all pixels to the nearest of some, which become more and more.

    ``distances``: ``(rows, columns)`` pixels, at first; changed in place.
    ``edge``: from a taken pixel's centre to where it begins.
    """

    def __init__(self, distances: FloatArray, edge: float = 0.0) -> None:
        self.distances, self._edge = distances, edge
        self._farthest = distances.max(axis=1)  # of each row: most rows stay as they are

    @property
    def farthest(self) -> float:
        """Largest of all distances."""
        return float(self._farthest.max())

    def add(self, mask: BoolArray, top: int, left: int) -> None:
        """Take the pixels of a mask that lies there, inside the image."""
        if not mask.any():
            return
        reach = math.ceil(self.farthest)
        above, before = min(top, reach), min(left, reach)
        rows = slice(top - above, top + mask.shape[0] + reach)
        window = self.distances[rows, left - before : left + mask.shape[1] + reach]
        shown = np.zeros(window.shape, dtype=bool)
        shown[above : above + mask.shape[0], before : before + mask.shape[1]] = mask
        np.minimum(window, np.maximum(distance_to(shown) - self._edge, 0.0), out=window)
        self._farthest[rows] = self.distances[rows].max(axis=1)
