"""Distances of regions of many vertices, from each other and from themselves, and snap rounding.

Plain distances look at every pair of edges: a coast of a hundred thousand vertices and an item of
a thousand take a second. An index (GEOS: indexed facet distance, STR trees) leaves the near ones.

Rings that all but touch would cross once they are turned or written. Regions whose minimum
clearance, the smallest distance by which a vertex may move before rings meet, asks for it are snap
rounded (J. Hobby, "Practical segment intersection with finite precision output", Computational
Geometry 13 (1999), 199-214), repeated until that changes nothing (D. Halperin and E. Packer,
"Iterated snap rounding", Computational Geometry 23 (2002), 209-225).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from packwork.arrays import IntArray
from packwork.geometry import _kernels
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import Region, buffered, polygon_parts, prepared, quiet, union, valid
from packwork.geometry.polygon import FEW_PAIRS

FEW_VERTICES = 20_000
"""Vertices of a region up to which edges are compared with all vertices beside them, without an
index. Larger takes seconds of combs, whose teeth run beside all others. Chosen."""


def distance(first: Region, second: Region) -> float:
    """Smallest distance of two shapes; 0 if they meet, infinite if one is empty.

    >>> distance(shapely.box(0, 0, 1, 1), shapely.box(4, 5, 6, 6))
    5.0
    """
    counts = shapely.get_num_coordinates([first, second])
    if counts[0] * counts[1] <= FEW_PAIRS:
        found = float(shapely.distance(first, second))
        return np.inf if np.isnan(found) else found
    larger, smaller = (first, second) if counts[0] >= counts[1] else (second, first)
    # A copy, as others may ask the region itself: only one may ask what is prepared.
    larger = larger if shapely.is_prepared(larger) else prepared(larger)
    if shapely.intersects(larger, smaller):
        return 0.0
    return float(shapely.shortest_line(larger, smaller).length)


def near_pairs(
    tree: shapely.STRtree, portion: NDArray[Any], first: int, last: int, reach: float
) -> tuple[IntArray, IntArray]:
    """Pairs within ``reach`` of which one is among the ``portion`` of a tree's regions.

    ``portion``: those from ``first`` on, or copies, which is faster where they are prepared. Of two
    regions before ``last``, which are asked about by portions in their order, the later one finds
    the other. Numbers in the portion and in the tree.

    >>> row = np.array([shapely.box(x, 0, x + 1, 1) for x in (0.0, 1.5, 3.5)])
    >>> [pairs.tolist() for pairs in near_pairs(shapely.STRtree(row), row, 0, 3, 0.75)]
    [[1], [0]]
    """
    boxes = shapely.bounds(portion) + reach * np.array([-1.0, -1.0, 1.0, 1.0])
    full = np.flatnonzero(~np.isnan(boxes[:, 0]))
    own, other = tree.query(shapely.box(*boxes[full].T))
    own = full[own]
    is_once = (other < own + first) | (other >= last)
    own, other = own[is_once], other[is_once]
    near = shapely.dwithin(portion[own], tree.geometries[other], reach)
    return own[near], other[near]


def clearance(region: Region, most: float) -> float:
    """By how much each vertex may move before rings meet, as in GEOS; ``most`` at most.

    >>> notched = shapely.Polygon([(0, 0), (4, 0), (4, 4), (2, 0.1), (0, 4)])
    >>> clearance(notched, 9.0), clearance(notched, 0.01)
    (0.1, 0.01)
    """
    rings = shapely.get_rings(shapely.get_parts(region))
    points, ring = shapely.get_coordinates(rings, return_index=True)
    # The last vertex of a ring is its first.
    is_kept = np.append(ring[1:] == ring[:-1], False) if len(ring) else np.zeros(0, dtype=bool)
    starts = np.searchsorted(ring[is_kept], np.arange(len(rings) + 1))
    kept = points[is_kept]
    across, down = kept[np.argsort(kept[:, 0])].T.copy()
    return float(_kernels.clearance(kept, starts, across, down, float(most)))


def is_clear(region: Region, least: float) -> bool:
    """Whether each vertex may move by less than ``least`` and no ring meet itself or another.

    Where rings meet in a common vertex that counts as no distance, as in GEOS.

    >>> notched = shapely.Polygon([(0, 0), (4, 0), (4, 4), (2, 0.1), (0, 4)])
    >>> is_clear(notched, 0.09), is_clear(notched, 0.11)
    (True, False)
    """
    rings = shapely.get_rings(shapely.get_parts(region))
    points, ring = shapely.get_coordinates(rings, return_index=True)
    if len(points) <= FEW_VERTICES:
        return clearance(region, least) >= least
    is_edge = ring[1:] == ring[:-1]
    ends = np.stack([points[:-1][is_edge], points[1:][is_edge]], axis=1)
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    if (lengths[lengths > 0] < least).any():
        return False
    tree = shapely.STRtree(shapely.linestrings(ends))
    corners = ends[:, 0]
    near, edge = tree.query(shapely.points(corners), predicate="dwithin", distance=least)
    is_own = (corners[near, None] == ends[edge]).all(axis=2).any(axis=1)
    others = ~is_own
    if not others.any():
        return True
    gaps = shapely.distance(shapely.points(corners[near[others]]), tree.geometries[edge[others]])
    return bool((gaps >= least).all())


STEP = 1e-7
"""Clearance that regions keep at least, and the grid's step, as shares of their extent: a two
hundredth of what readers follow curves to. Larger moves vertices farther; smaller drowns in the
digits of files. Chosen."""

CLEFT = FLATTENING
"""Width of a bay's mouth, as a share of the extent, below which it counts as closed: what readers
follow curves to. Larger fills bays that can be seen, smaller leaves mouths that a file's last
digits close. Derived."""

MOST_ROUNDS = 8
"""Times that a region is snapped at most; two have been enough for all that was tried. Chosen."""


def snap_rounded(shape: Region, step: float = STEP) -> Region:
    """The region itself if its rings keep clear of each other, else one whose rings do.

    Each vertex is within a few steps, shares of the extent, of where it was; empty if nothing is as
    wide as a step. A region that is not valid is repaired.

    >>> nearly = shapely.Polygon([(0, 0), (4, 0), (4, 4), (2, 1e-12), (0, 4)])
    >>> snap_rounded(nearly).geom_type, snap_rounded(nearly).area
    ('MultiPolygon', 8.0)
    >>> box = shapely.box(0, 0, 1, 1)
    >>> snap_rounded(box) is box
    True
    """
    shape = valid(shape)
    left, top, right, bottom = shape.bounds if shape.area > 0 else (0.0, 0.0, 0.0, 0.0)
    least = step * max(right - left, bottom - top)
    for _ in range(MOST_ROUNDS):
        if not least > 0 or is_clear(shape, least / 2):
            break
        # A region that says it lies on the grid is not looked at again.
        with quiet():
            loose = shapely.set_precision(shape, 0.0, mode="pointwise")
            snapped = shapely.set_precision(loose, least)
        shape = union(polygon_parts(snapped))
    return shape


def without_clefts(shape: Region, width: float = CLEFT) -> Region:
    """A region without holes, bays filled whose mouths are narrower than ``width`` of its extent.

    Of a valid region without such bays it is the region itself.

    >>> ring = shapely.box(0, 0, 4, 4) - shapely.box(1, 1, 3, 3)
    >>> slit = ring - shapely.box(1.9, 0, 1.900001, 2)
    >>> round(without_clefts(slit).area, 3)
    16.0
    """
    left, top, right, bottom = shape.bounds
    least = width * max(right - left, bottom - top)
    if is_clear(shape, least):
        return shape
    grown = buffered(shape, least / 2, join_style="mitre")
    bays = [shapely.Polygon(hole) for part in polygon_parts(grown) for hole in part.interiors]
    if not bays:
        return shape
    return snap_rounded(union([shape, *(buffered(bay, least, join_style="mitre") for bay in bays)]))
