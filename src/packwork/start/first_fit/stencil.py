"""What an item takes of an image of whole pixels, wherever it is put."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from packwork.arrays import BoolArray, IntArray
from packwork.geometry.outline import Outline, joined
from packwork.raster.coverage import Rasteriser
from packwork.start.first_fit import _kernels

Key = TypeVar("Key", bound=Hashable)

TOUCHED = 1e-3
"""Coverage from which on a pixel counts as taken: those that are only grazed are not."""

PAGE_PX = 4_000
"""Rows of an image of stencils, but for the last of them. Chosen: images have a largest side."""


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
    outlines = list(outlines_px.values())
    boxes = np.array([outline.bounds for outline in outlines]).reshape(-1, 4)
    low = np.floor(boxes[:, :2]).astype(np.int64)
    size = np.maximum(np.ceil(boxes[:, 2:]).astype(np.int64) - low, 1)
    page = np.cumsum(size[:, 1]) // PAGE_PX
    found: list[Stencil] = []
    for number in np.unique(page):
        some = np.flatnonzero(page == number)
        masks = _masks([outlines[k] for k in some], low[some], size[some])
        for k, mask in zip(some, masks, strict=True):
            runs = _kernels.runs_of(mask)
            runs = runs[np.argsort(-runs[:, 2], kind="stable")]
            origin = (-int(low[k, 1]), -int(low[k, 0]))
            found.append(Stencil(mask, origin, runs, _kernels.fringe_of(mask, reach)))
    return dict(zip(outlines_px, found, strict=True))


def _masks(outlines_px: Sequence[Outline], low: IntArray, size: IntArray) -> Iterator[BoolArray]:
    """Pixels that outlines touch, rendered in one image, each below the one before."""
    below = np.concatenate([[0], np.cumsum(size[:, 1])])
    points, starts = joined(outlines_px)
    shift = np.column_stack([-low[:, 0], below[:-1] - low[:, 1]])
    counts = [len(outline.points) for outline in outlines_px]
    rasteriser = Rasteriser((int(below[-1]), int(size[:, 0].max())))
    rasteriser.sweep(points + np.repeat(shift, counts, axis=0), starts)
    taken = rasteriser.density() > TOUCHED
    for top, (columns, rows) in zip(below[:-1], size, strict=True):
        mask = taken[top : top + rows, :columns].copy()
        if not mask.any():
            mask[rows // 2, columns // 2] = True
        yield mask
