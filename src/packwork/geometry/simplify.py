"""Simplification of outlines: fewer points for the same region, within a stated distance.

D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points required to
represent a digitized line or its caricature", Cartographica 10 (1973), 112-122, by GEOS.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, polygon_parts, simplify


def simplified(outline: Outline, tolerance: float) -> Outline:
    """Outline with fewer vertices, its boundary within twice ``tolerance`` of the old one.

    Twice, because GEOS may drop the vertex at which a ring starts. Rings stay simple; if no area
    would be left, the outline comes back as it was.

    >>> t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    >>> circle = Outline.from_rings([np.column_stack([np.cos(t), np.sin(t)])])
    >>> len(simplified(circle, 0.05).points) < 20
    True
    """
    if tolerance <= 0:
        return outline
    # The plain algorithm is ten times faster; where it lets rings cross or drops one,
    # the careful one is asked.
    region = simplify(outline.region, tolerance, keeps_topology=False)
    rings = sum(1 + len(part.interiors) for part in polygon_parts(region))
    if not region.is_valid or rings != len(outline.rings):
        region = simplify(outline.region, tolerance, keeps_topology=True)
    if not polygon_parts(region):
        return outline
    return Outline.from_region(region)


def closed(outline: Outline, radius: float) -> Outline:
    """Outline with every cleft, bay's mouth and hole narrower than twice ``radius`` filled.

    Morphological closing: grown by ``radius`` and shrunk again.

    >>> dart = Outline.from_rings([np.array([[0, 0], [4, 2], [0, 4], [1, 2.0]])])
    >>> closed(dart, 9.0).area > dart.area
    True
    """
    if radius <= 0:
        return outline
    region = buffered(outline.region, radius, quad_segs=4)
    region = buffered(region, -radius, quad_segs=4)
    if not polygon_parts(region):
        return outline
    found = Outline.from_region(region)
    # A bay whose mouth was closed is a hole now: nothing could get in, so nothing shall
    # start there. Holes of the outline's own stay open.
    return found if outline.has_holes else found.without_holes()


def grown(outline: Outline, distance: float) -> Outline:
    """Outline moved outwards by ``distance`` all round, inwards if it is negative.

    Corners become round. If nothing would be left, the outline comes back as it was.

    >>> square = Outline.from_rings([np.array([[0, 0], [4, 0], [4, 4], [0, 4.0]])])
    >>> grown(square, -1.0).area
    4.0
    """
    if distance == 0:
        return outline
    region = buffered(outline.region, distance, quad_segs=4)
    return Outline.from_region(region) if polygon_parts(region) else outline


def hull(outline: Outline) -> Outline:
    """Convex hull of the outline.

    >>> dart = Outline.from_rings([np.array([[0, 0], [4, 2], [0, 4], [1, 2.0]])])
    >>> len(hull(dart).points)
    3
    """
    shape = shapely.convex_hull(outline.region)
    return Outline.from_region(shape) if isinstance(shape, Polygon) else outline


def hull_areas(outlines: Sequence[Outline]) -> FloatArray:
    """Area of each outline's convex hull; copies are measured once."""
    known: dict[Outline, float] = {}
    for outline in outlines:
        if outline not in known:
            known[outline] = shapely.convex_hull(shapely.linestrings(outline.points)).area
    return np.array([known[outline] for outline in outlines])
