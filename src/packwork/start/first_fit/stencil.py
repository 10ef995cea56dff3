"""What an item takes of an image of whole pixels, wherever it is put."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from packwork.arrays import BoolArray, IntArray
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser
from packwork.start.first_fit import _kernels

Key = TypeVar("Key", bound=Hashable)

TOUCHED = 1e-3
"""Coverage from which on a pixel counts as taken: those that are only grazed are not."""


@dataclass(frozen=True, eq=False)
class Stencil:
    """Pixels that an item takes, about a pixel's corner.

    Parameters
    ----------
    mask
        ``(rows, columns)`` which pixels of its box it takes; one at least.
    origin
        Row and column of the item's own origin in that box; it may lie off the box.
    runs
        ``(r, 4)`` the same as runs: row, first column, length, log2 of the length; long
        ones first, as they are the first to meet something.
    fringe
        ``(m, 2)`` rows and columns of the pixels round it.
    """

    mask: BoolArray
    origin: tuple[int, int]
    runs: IntArray
    fringe: IntArray


def cut_all(outlines_px: Mapping[Key, Outline], reach: int) -> dict[Key, Stencil]:
    """Stencils of outlines about their origins.

    Parameters
    ----------
    outlines_px
        In pixels, origin where a pixel's corner will be put.
    reach
        Width of the fringe round each, pixels.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [2, -1], [2, 1], [-1, 1]])])
    >>> one = cut_all({"tile": tile}, 1)["tile"]
    >>> one.mask.tolist(), one.origin, len(one.fringe)
    ([[True, True, True], [True, True, True]], (1, 1), 14)
    """
    return {key: cut(outline, reach) for key, outline in outlines_px.items()}


def cut(outline_px: Outline, reach: int) -> Stencil:
    """Stencil of one outline; as for :func:`cut_all`."""
    left, top, right, bottom = outline_px.bounds
    column, row = math.floor(left), math.floor(top)
    width, height = max(math.ceil(right) - column, 1), max(math.ceil(bottom) - row, 1)
    rasteriser = Rasteriser((height, width))
    rasteriser.sweep(outline_px.points - (column, row), outline_px.starts)
    mask = rasteriser.density() > TOUCHED
    if not mask.any():
        mask[height // 2, width // 2] = True
    return stencil_of(mask, (-row, -column), reach)


def stencil_of(mask: BoolArray, origin: tuple[int, int], reach: int) -> Stencil:
    """Stencil of pixels; ``reach`` is the width of its fringe."""
    runs = _kernels.runs_of(mask)
    runs = runs[np.argsort(-runs[:, 2], kind="stable")]
    return Stencil(mask, origin, runs, _kernels.fringe_of(mask, reach))
