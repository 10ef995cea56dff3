"""Stencil of an item: the whole pixels that it takes, wherever it is put."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from packwork.arrays import BoolArray, IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import grown
from packwork.raster.coverage import Rasteriser
from packwork.start.first_fit import _kernels

TOUCHED = 1e-3
"""Coverage from which on a pixel counts as taken: those that are only grazed are not."""

MOST_OFFSET_PX = 2.0
"""Margin up to which vertices are moved, which takes hardly any time; wider ones are drawn round
the outline. Larger fills more beyond the corners of bays. Chosen."""

TALLEST = 3
"""Log2 of the greatest height of boxes that are looked at in one step. Larger takes more memory and
longer to keep up, smaller cuts stems of letters in more pieces. Chosen."""


@dataclass(frozen=True, eq=False)
class Stencil:
    """Pixels that an item takes, about a pixel's corner.

    Parameters
    ----------
    mask
        ``(rows, columns)`` which pixels of its box it takes; one at least.
    origin
        Row and column of the item's own origin in that box; it may lie off the box.
    boxes
        ``(r, 6)`` the same as boxes, which may overlap: row, first column, height, width, and log2
        of these; large ones first, as they are the first to meet something.
    reach
        Width of the fringe round it, pixels.
    """

    mask: BoolArray
    origin: tuple[int, int]
    boxes: IntArray
    reach: int

    @cached_property
    def fringe(self) -> IntArray:
        """``(m, 2)`` rows and columns of the pixels round it; asked for where it has a place."""
        return np.asarray(_kernels.fringe_of(self.mask, self.reach))


def cut(outline_px: Outline, reach: int, margin_px: float = 0.0) -> Stencil:
    """Stencil of an outline about its origin.

    Parameters
    ----------
    outline_px
        In pixels, origin where a pixel's corner will be put.
    reach
        Width of the fringe round it, pixels.
    margin_px
        How far round the outline pixels count as taken as well.

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


def covered(outline_px: Outline, margin_px: float = 0.0) -> tuple[BoolArray, tuple[int, int]]:
    """Pixels that an outline takes, and the row and column of its origin among them."""
    points, starts = outline_px.points, outline_px.starts
    if margin_px > MOST_OFFSET_PX:
        wide = grown(outline_px, margin_px)
        points, starts = wide.points, wide.starts
    elif margin_px > 0:
        points = _kernels.offset(points, starts, margin_px)
    x, y = points.T.copy()  # in one piece each, which is faster
    column, row = math.floor(x.min()), math.floor(y.min())
    right, bottom = math.ceil(x.max()), math.ceil(y.max())
    width, height = max(right - column, 1), max(bottom - row, 1)
    rasteriser = Rasteriser((height, width))
    rasteriser.sweep(points - (column, row), starts)
    mask = rasteriser.density() > TOUCHED
    if not mask.any():
        mask[height // 2, width // 2] = True
    return mask, (-row, -column)


def stencil_of(mask: BoolArray, origin: tuple[int, int], reach: int) -> Stencil:
    """Stencil of pixels; ``reach`` is the width of its fringe."""
    boxes = _kernels.boxes_of(mask, TALLEST)
    boxes = boxes[np.argsort(-boxes[:, 2] * boxes[:, 3], kind="stable")]
    return Stencil(mask, origin, boxes, reach)
