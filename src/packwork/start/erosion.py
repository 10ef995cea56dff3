"""Erosion start: items evenly along what a morphological erosion leaves of a thin container.

J. Serra, "Image Analysis and Mathematical Morphology", Academic Press 1982: what an erosion by a
disc leaves are the centres of all such discs inside. It is done on the outline, not in an image:
of hairs and spirals no image of any size shows more than the few pixels that happen to lie inside.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.fields.distance_transform import distance_inside
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region, buffered, polygon_parts
from packwork.raster.coverage import coverage
from packwork.start.first_poses import disc_radii

THREAD = 0.3
"""Half the mean width of a container, in radii of the items' mean disc, below which it is a thread
to them. Larger spreads items that could lie in its wider places, smaller leaves threads to an
image that does not show them. Tried."""

DEPTHS = (1.6, 0.8, 0.4, 0.2)
"""Radii of discs tried in turn, in halves of the mean width. Larger ones leave the thickest
places alone, smaller ones make small items. Chosen."""

LEAST_LEFT = 0.5
"""Share of a container's edge that is left of an erosion whose places are used, at least. Larger
makes items of uneven threads smaller, smaller leaves more of them bare. Chosen."""

RESOLUTION, LEAST_WIDE = 500, 2.0
"""Pixels on the longer side of the picture that tells whether some places are wide, and from which
distance to the edge one is, px: closer lines than pixels look like shapes here and there. Larger
takes longer. Chosen."""

WHOLE = 0.9
"""Share of a pixel from which it counts as inside. Larger finds no wide places between rough edges,
smaller takes close lines for one shape. Chosen."""

CANDIDATES = 8
"""Places looked at for each item, of which those farthest from each other are taken. More are
more even and take longer. Chosen."""

ROUND = 4
"""Pieces of a quarter of a circle round a corner of the edge. More take longer, fewer leave less of
the radius. Chosen."""


@dataclass(frozen=True, eq=False)
class Spread:
    """Discs apart from each other inside a container: centres ``(n,)`` each, and their radius."""

    x: FloatArray
    y: FloatArray
    radius: float


def is_thread(container: Outline, radii_cu: FloatArray) -> bool:
    """Whether a container is far thinner than the discs ``(n,)`` of its items, all along.

    Examples
    --------
    >>> hair = Outline.from_rings([np.array([[0.0, 0], [90, 0], [90, 0.1], [0, 0.1]])])
    >>> is_thread(hair, np.full(4, 1.0)), is_thread(hair, np.full(4, 0.1))
    (True, False)
    """
    half = container.area / container.region.length
    if half >= THREAD * float(np.mean(radii_cu)):
        return False
    # A disc with hairs is none; a picture tells, for outlines may be of any number of edges.
    left, top, right, bottom = container.bounds
    px = container.extent / RESOLUTION
    shape = int((bottom - top) / px) + 2, int((right - left) / px) + 2
    points = (container.points - (left, top)) / px
    image = coverage(points, container.starts, shape, np.float32)
    is_wide = distance_inside(image > WHOLE) >= max(2 * DEPTHS[0] * half / px, LEAST_WIDE)
    return bool(np.count_nonzero(is_wide) * px**2 < (1 - LEAST_LEFT) * container.area)


def spread_along(container: Outline, count: int, rng: np.random.Generator) -> Spread | None:
    """Discs spread evenly along a thread, as large as most of it has room for.

    ``rng``: says where the first lies.

    Examples
    --------
    >>> hair = Outline.from_rings([np.array([[0.0, 0], [90, 0], [90, 1], [0, 1]])])
    >>> found = spread_along(hair, 3, np.random.default_rng(0))
    >>> bool(np.diff(np.sort(found.x)).min() > 10), found.radius < 0.5
    (True, True)
    """
    region = container.region
    half = container.area / region.length
    for depth in DEPTHS:
        left = _eroded(container, depth * half)
        if left.length >= LEAST_LEFT * region.length:
            places = _places(left, depth * half, count, rng)
            if places is not None:
                radius = depth * half * math.cos(math.pi / (4 * ROUND))
                return Spread(places[:, 0], places[:, 1], radius)
    return None


def scales_within(
    outlines: Sequence[Outline], nominal: FloatArray, radius: float, *, is_common: bool
) -> tuple[FloatArray, FloatArray]:
    """``(n,)`` scales at which each item lies in a disc of one radius, and ``(n,)`` typical ones.

    ``nominal``: ``(n,)`` scales that are in the proportions asked for, which the typical ones are
    in too.
    ``is_common``: whether scales must keep them; else what is longer than others of its size is
    smaller.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-3.0, -4], [3, -4], [3, 4], [-3, 4]])])
    >>> scales_within([tile, tile], np.array([1.0, 2.0]), 2.0, is_common=True)[0].tolist()
    [0.2, 0.4]
    """
    arms = np.array([np.hypot(*outline.points.T).max() for outline in outlines])
    if is_common:
        scales = nominal * float((radius / (arms * nominal)).min())
        return scales, scales
    discs = disc_radii(outlines, nominal)
    longer = float(np.median(arms * nominal / discs))
    typical = nominal * radius / (longer * float(discs.max()))
    return np.minimum(typical, radius / arms), typical


def _eroded(container: Outline, radius: float) -> Region:
    """Centres of the discs of a radius inside; part by part, for those of thousands stay apart."""
    parts = np.array(polygon_parts(container.region))
    return shapely.MultiPolygon(polygon_parts(buffered(parts, -radius, quad_segs=ROUND)))


def _places(left: Region, radius: float, count: int, rng: np.random.Generator) -> FloatArray | None:
    """``(n, 2)`` places evenly along the edge of an erosion, none nearer than two radii."""
    points, line = shapely.get_coordinates(shapely.get_parts(left.boundary), return_index=True)
    steps = np.hypot(*np.diff(points, axis=0).T) * (np.diff(line) == 0)
    ends = np.concatenate([[0.0], np.cumsum(steps)])
    tried = CANDIDATES * count
    # At random within its stretch, or of a thousand hairs alike all would lie at one height.
    along = (np.arange(tried) + rng.random(tried)) * (ends[-1] / tried)
    found = np.column_stack([np.interp(along, ends, column) for column in points.T])
    chosen, nearest = _farthest_first(found, count)
    return found[chosen] if nearest >= 2 * radius else None


def _farthest_first(points: FloatArray, count: int) -> tuple[IntArray, float]:
    """Some of points ``(n, 2)``, each the farthest from those before; the nearest of them.

    T. Gonzalez, "Clustering to minimize the maximum intercluster distance", Theoretical Computer
    Science 38 (1985), 293-306, doi:10.1016/0304-3975(85)90224-5.
    """
    chosen = np.zeros(count, dtype=np.int64)
    away = np.full(len(points), np.inf)
    nearest = np.inf
    for k in range(1, count):
        away = np.minimum(away, np.hypot(*(points - points[chosen[k - 1]]).T))
        chosen[k] = int(np.argmax(away))
        nearest = min(nearest, float(away[chosen[k]]))
    return chosen, nearest
