"""Distances of regions of many vertices, from each other and from themselves, by indices of edges.

Plain distances look at every pair of edges: a coast of a hundred thousand vertices and an item of
a thousand take a second. An index (GEOS: indexed facet distance, STR trees) leaves the near ones.
"""

from __future__ import annotations

import numpy as np
import shapely

from packwork.geometry import _kernels
from packwork.geometry.overlay import Region
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
    # Prepared, as both that ask may go on asking: its index is built once.
    shapely.prepare(larger)
    if shapely.intersects(larger, smaller):
        return 0.0
    return float(shapely.shortest_line(larger, smaller).length)


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
