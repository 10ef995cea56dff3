"""Exact measures of a tile: on the torus, where what leaves one side comes in on the other.

Shares no code with the solver and the finish: images are found by their boxes, as far as any
reaches, and not from a fixed set of neighbours.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
import shapely

from packwork.arrays import IntArray
from packwork.errors import ShapeError
from packwork.geometry.lattice import Lattice, moved
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import valid
from packwork.metrics.exact import ExactMetrics, exact_metrics, smallest_gap

_Regions: TypeAlias = npt.NDArray[Any]


def images_about(
    outlines: Sequence[Outline], lattice: Lattice, reach: float
) -> tuple[_Regions, IntArray]:
    """Regions of items, then of their images within reach of any; and the item of each.

    Examples
    --------
    >>> bar = Outline.from_rings([[[0.0, 0], [9, 0], [9, 4], [0, 4]]])
    >>> regions, owners = images_about([bar], Lattice(10.0, 10.0), 1.0)
    >>> len(regions), owners.tolist()
    (3, [0, 0, 0])
    """
    own = [valid(outline.region) for outline in outlines]
    boxes = shapely.bounds(own).reshape(-1, 4)
    whole = *(boxes[:, :2].min(axis=0) - reach), *(boxes[:, 2:].max(axis=0) + reach)
    found, owners = list(own), list(range(len(own)))
    for k, region in enumerate(own):
        for shift in lattice.meeting(tuple(boxes[k]), whole):
            if shift.any():
                found.append(moved(region, shift))
                owners.append(k)
    regions = np.empty(len(found), dtype=object)
    regions[:] = found
    return regions, np.array(owners)


def in_cell(outlines: Sequence[Outline], lattice: Lattice) -> list[Outline]:
    """Parts of all outlines, and of all that repeats of them, that lie in the cell.

    Examples
    --------
    >>> bar = Outline.from_rings([[[3.0, 0], [5, 0], [5, 4], [3, 4]]])
    >>> [part.bounds for part in in_cell([bar], Lattice(4.0, 8.0))]
    [(0.0, 0.0, 1.0, 4.0), (3.0, 0.0, 4.0, 4.0)]
    """
    found = []
    for outline in outlines:
        region = valid(outline.region)
        for shift in lattice.meeting(outline.bounds, lattice.cell):
            part = shapely.clip_by_rect(moved(region, shift), *lattice.cell)
            try:
                found.append(Outline.from_region(part))
            except ShapeError:
                continue
    return found


def torus_metrics(outlines: Sequence[Outline], lattice: Lattice) -> ExactMetrics:
    """Exact measures of outlines in place, anywhere in the plane, that repeat by a lattice.

    Nothing is outside; the smallest gap is also that of an item to its own image.

    Examples
    --------
    >>> bar = Outline.from_rings([[[0.0, 0], [9, 0], [9, 4], [0, 4]]])
    >>> found = torus_metrics([bar], Lattice(10.0, 10.0))
    >>> found.coverage, found.min_gap, found.is_clean
    (0.36, 1.0, True)
    >>> torus_metrics([bar], Lattice(8.0, 10.0)).overlap_area
    4.0
    """
    if len(outlines) == 0:
        return ExactMetrics(
            coverage=0.0, overlap=0.0, exceeding=0.0, overlap_area=0.0, outside_area=0.0,
            min_gap=math.inf,
        )  # fmt: skip
    left, top, right, bottom = lattice.cell
    cell = Outline.box(left, top, right, bottom)
    shares = exact_metrics(in_cell(outlines, lattice), cell)
    side = max(lattice.width, lattice.height)
    regions, _ = images_about(outlines, lattice, side)
    touches = len(shapely.STRtree(regions).query(regions, predicate="intersects").T) > len(regions)
    left, top, right, bottom = shapely.total_bounds(regions)
    around = shapely.box(left - 2 * side, top - 2 * side, right + 2 * side, bottom + 2 * side)
    return ExactMetrics(
        coverage=shares.coverage, overlap=shares.overlap, exceeding=0.0,
        overlap_area=shares.overlap_area, outside_area=0.0,
        min_gap=0.0 if touches else smallest_gap(regions, around),
    )  # fmt: skip
