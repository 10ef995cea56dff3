"""Outer and inner simplification: regions of few vertices that hold another, or lie in it.

Vertices go one by one, the cheapest first, as in M. Visvalingam and J. Whyatt, "Line
generalisation by repeated elimination of points", The Cartographic Journal 30 (1993), 46-51. Ours
drops only vertices of bays, and edges by prolonging their neighbours, so that the solid grows and
never shrinks; the cost is a distance, not an area. A plain simplification (D. Douglas and
T. Peucker, "Algorithms for the reduction of the number of points required to represent a
digitized line or its caricature", Cartographica 10 (1973), 112-122) with a margin comes first.
"""

from __future__ import annotations

from collections.abc import Sequence

import shapely

from packwork.compaction.kernels.outer_simplify import simplify_outward
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import (
    Region,
    buffered,
    difference,
    polygon_parts,
    simplify,
    union,
    valid,
)

MARGIN = 0.1
"""Share of the tolerance that goes into a plain simplification first, and into the margin
that makes up for it. Larger gives fewer vertices to the second step and more excess.
Tried."""

MITRE_LIMIT = 4.0
"""How far a sharp corner of that margin may stand out, in margins. Larger keeps needles
sharp but longer; smaller cuts them with an edge more. Chosen."""

MANY_VERTICES = 50_000
"""Vertices of a container above which it is simplified plainly and shrunk by as much: 1 s in place
of 5 s, and a quarter of a percent less room, for a spiral of 270,000. Tried."""

FINER = 0.01
"""Tolerance, as a share of the mean edge, below which such a container stays as it is: hardly a
vertex would go. Larger leaves vertices, smaller looks for them for nothing. Chosen."""

MANY_PARTS = 500
"""Parts of a container above which those of few vertices stay as they are, and the others are
simplified one by one: 5,000 hairs take a hundredth of a second in place of ten. Chosen."""

PLAIN = 8
"""Coordinates of a ring, the first once more, up to which it has no vertex to spare. Larger leaves
more vertices, smaller looks at more rings for nothing. Chosen."""

MARGINS = (1.0, 1.5, 2.25)
"""Margins tried in turn, simplification's tolerances: GEOS may drop the vertex at which a
ring starts, and then is off by twice that."""


def outer_simplified(region: Region, tolerance: float) -> Region:
    """Region with fewer vertices that holds all of ``region``.

    Its boundary is within about one and a half times ``tolerance`` of the old one. Bays
    lose vertices, and convex edges go by prolonging their neighbours: the excess is a
    third of what simplifying and growing by the tolerance would give.

    Examples
    --------
    >>> disc = shapely.Point(0, 0).buffer(1.0, quad_segs=100)
    >>> cover = outer_simplified(disc, 0.01)
    >>> bool(cover.covers(disc)), len(cover.exterior.coords) < 40
    (True, True)
    """
    if tolerance <= 0:
        return region
    region = valid(region)
    loose = _grown(region, MARGIN * tolerance)
    rings = [simplify_outward(ring, tolerance) for ring in Outline.from_region(loose).rings]
    if min(map(len, rings)) >= 3:
        cover = Outline.from_rings(rings).region
        # Bays that close upon each other may leave rings that cross, or fill a hole.
        excess = cover.area - region.area
        if cover.is_valid and cover.covers(region) and excess < 2 * tolerance * region.length:
            return cover
    return loose


def _grown(region: Region, tolerance: float) -> Region:
    """Region simplified, then grown by as much."""
    # The plain algorithm is ten times faster; where it lets rings cross, the careful one is
    # asked. Rings that it drops are holes, or the cover would not hold all.
    fewer = simplify(region, tolerance, keeps_topology=False)
    if not fewer.is_valid:
        fewer = simplify(region, tolerance, keeps_topology=True)
    for margin in MARGINS:
        cover = buffered(fewer, margin * tolerance, join_style="mitre", mitre_limit=MITRE_LIMIT)
        if cover.is_valid and cover.covers(region):
            return cover
    return region


def inner_simplified(region: Region, tolerance: float) -> Region:
    """Region with fewer vertices that lies inside ``region``: a container's safe side.

    Examples
    --------
    >>> disc = shapely.Point(0, 0).buffer(1.0, quad_segs=100)
    >>> bool(disc.covers(inner_simplified(disc, 0.01)))
    True
    """
    if tolerance <= 0:
        return region
    vertices = int(shapely.get_num_coordinates(region))
    if vertices > MANY_VERTICES:
        if tolerance < FINER * region.length / vertices:
            return region
        # As far as vertices move, all edges move inwards.
        fewer = simplify(region, tolerance / 2, keeps_topology=False)
        parts = polygon_parts(buffered(fewer, -tolerance / 2, join_style="mitre"))
        return union(parts) if parts else region
    parts = polygon_parts(region)
    if len(parts) > MANY_PARTS:
        return _each_inner_simplified(parts, tolerance)
    frame = buffered(shapely.box(*region.bounds), 8 * tolerance, join_style="mitre")
    inside = difference(frame, outer_simplified(difference(frame, region), tolerance))
    parts = polygon_parts(inside)
    return union(parts) if parts else region


def _each_inner_simplified(parts: Sequence[Region], tolerance: float) -> Region:
    """Parts that lie apart, each with fewer vertices if it has some to spare."""
    kept: list[Region] = []
    for part in parts:
        is_plain = shapely.get_num_coordinates(part) <= PLAIN
        kept += polygon_parts(part if is_plain else inner_simplified(part, tolerance))
    return shapely.MultiPolygon(kept)
