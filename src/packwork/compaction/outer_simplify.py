"""Outer and inner simplification: regions of few vertices that hold another, or lie in it.

Vertices go one by one, the cheapest first, as in M. Visvalingam and J. Whyatt, "Line generalisation
by repeated elimination of points", The Cartographic Journal 30 (1993), 46-51. Ours drops only
vertices of bays, and edges by prolonging their neighbours, so that the polygon grows and never
shrinks; the cost is a distance, not an area. A plain simplification (D. Douglas and T. Peucker,
"Algorithms for the reduction of the number of points required to represent a digitized line or its
caricature", Cartographica 10 (1973), 112-122) with a margin comes first. Of many outlines, what
recurs in them, as letters do in words, is simplified once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.compaction.kernels.outer_simplify import simplify_outward
from packwork.geometry.affine import similarity
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
"""Share of the tolerance that goes into a plain simplification first, and into the margin that
makes up for it. Larger gives fewer vertices to the second step and more excess. Tried."""

MITRE_LIMIT = 4.0
"""How far a sharp corner of that margin may stand out, in margins. Larger keeps needles longer;
smaller cuts them with an edge more. Chosen."""

MANY_VERTICES = 50_000
"""Vertices of a container above which it is simplified plainly and shrunk by as much: a fifth of
the time, and a quarter of a percent less room. Tried."""

FINER = 0.01
"""Tolerance, as a share of the mean edge, below which such a container stays as it is, since hardly
a vertex would go. Chosen."""

MANY_PARTS = 500
"""Parts of a container above which those of few vertices stay as they are, and the others are
simplified one by one. Smaller wastes room, larger takes seconds. Chosen."""

PLAIN = 8
"""Coordinates of a ring, the first once more, up to which it has no vertex to spare. Chosen."""

MARGINS = (1.0, 1.5, 2.25)
"""Margins tried in turn, simplification's tolerances: GEOS may drop the vertex at which a
ring starts, and then is off by twice that."""


def outer_simplified(region: Region, tolerance: float) -> Region:
    """Region with fewer vertices that holds all of ``region``.

    Its boundary is seldom farther than one and a half times ``tolerance`` off the old one, and the
    area grows by less than that of a band twice as wide as ``tolerance``.

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


ALIKE = 1e-6
"""Difference of coordinates, in tolerances, up to which two rings are one shape. Smaller sees
rounding, larger would be seen in the gaps. Chosen."""

STEPS = 2
"""Tolerances of parts for each factor of 2, rounded down to them. More keep nearer to what was
asked and find less that recurs. Chosen."""


_Shape: TypeAlias = tuple[bytes, bytes]
"""Starts and points of an outline of extent 1, in parts of the tolerance."""


_Key: TypeAlias = tuple[int | bytes, ...]
"""Number of a tolerance, and the rings of a part about its first vertex."""


class Covers:
    """Outer simplifications that remember parts.

    >>> tile = np.array([[0.0, 0], [4, 0], [4, 4], [2, 4.01], [0, 4]])
    >>> covers = Covers()
    >>> two = covers.cover(Outline.from_rings([tile, tile + (9, 0)]), 0.1)
    >>> len(covers.known), len(two.rings), bool(two.region.covers(shapely.Polygon(tile)))
    (1, 2, True)
    """

    def __init__(self) -> None:
        self.known: dict[_Key, list[FloatArray]] = {}
        """Rings of the covers of parts, about the part's first vertex."""
        self._scaled: dict[_Shape, tuple[float, Outline]] = {}

    def cover_of_shape(self, outline: Outline, tolerance: float) -> Outline:
        """Cover of an outline, ``tolerance`` in extents, always the same; other sizes are scaled.

        >>> tile = np.array([[0.0, 0], [4, 0], [4, 4], [2, 4.01], [0, 4]])
        >>> one, two = (Outline.from_rings([size * tile]) for size in (1, 3))
        >>> covers = Covers()
        >>> small, large = covers.cover_of_shape(one, 0.02), covers.cover_of_shape(two, 0.02)
        >>> bool(np.allclose(3 * small.points, large.points)), large.region.covers(two.region)
        (True, True)
        """
        extent = outline.extent
        if tolerance <= 0:
            return self.cover(outline, tolerance)
        shape = np.rint(outline.points / (ALIKE * tolerance * extent)).astype(np.int64)
        key = outline.starts.tobytes(), shape.tobytes()
        if key not in self._scaled:
            self._scaled[key] = extent, self.cover(outline, tolerance * extent)
        first, cover = self._scaled[key]
        # There and back would move vertices by a rounding.
        return cover if extent == first else cover.mapped(similarity(0.0, 0.0, 0.0, extent / first))

    def cover(self, outline: Outline, tolerance: float) -> Outline:
        """Outline with fewer vertices that holds all of ``outline``; as ``outer_simplified``."""
        if len(outline.rings) > 1 and tolerance > 0:
            parts = [self._part(rings, tolerance) for rings in outline.parts]
            if _are_apart(parts):
                return Outline.from_rings([ring for part in parts for ring in part])
        return Outline.from_region(outer_simplified(outline.region, tolerance))

    def _part(self, rings: Sequence[FloatArray], tolerance: float) -> list[FloatArray]:
        level = math.floor(STEPS * math.log2(tolerance))
        tolerance = 2.0 ** (level / STEPS)
        first = rings[0][0]
        about = [ring - first for ring in rings]
        alike = (np.rint(ring / (ALIKE * tolerance)).astype(np.int64).tobytes() for ring in about)
        key = level, *alike
        if key not in self.known:
            cover = outer_simplified(shapely.Polygon(about[0], about[1:]), tolerance)
            self.known[key] = Outline.from_region(cover).rings
        return [one + first for one in self.known[key]]


def _are_apart(parts: list[list[FloatArray]]) -> bool:
    low = np.array([part[0].min(axis=0) for part in parts])
    high = np.array([part[0].max(axis=0) for part in parts])
    meets = ((low[:, None] <= high) & (low <= high[:, None])).all(axis=2)
    if np.count_nonzero(meets) == len(parts):
        return True
    polygons = [shapely.Polygon(part[0], part[1:]) for part in parts]
    return bool(shapely.MultiPolygon(polygons).is_valid)
