"""Raw rings to clean regions, and regions to oriented rings.

Shapely's ``buffer(0)`` loses half of a bow-tie; here the rings are noded, cut into
faces, and each face is kept or dropped by its winding number: both fill rules of SVG
come out exactly.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
import shapely
from shapely.errors import GEOSException
from shapely.geometry import LinearRing, MultiLineString, MultiPolygon, Polygon
from shapely.ops import polygonize

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.overlay import Region as Region
from packwork.geometry.overlay import polygon_parts as polygon_parts
from packwork.geometry.overlay import quiet, union

FillRule: TypeAlias = Literal["nonzero", "evenodd"]

FEW_PARTS = 100
"""Parts up to which all their boxes are compared with each other. Chosen."""

FEW_PAIRS = 1_000_000
"""Points times edges up to which each point is compared with each edge, without an index. Larger
takes memory and seconds, smaller the time of an index that is used once. Chosen: 10 ms."""


def region(rings: Iterable[FloatArray], rule: FillRule = "nonzero") -> Region:
    """Area that closed ``rings`` fill under ``rule``; valid, possibly empty.

    ``rings``: arrays ``(n, 2)``; closed implicitly; may cross themselves and each other. Rings of
    fewer than three points have no area and are passed over.

    >>> bow_tie = np.array([[0, 0], [2, 2], [2, 0], [0, 2.0]])
    >>> region([bow_tie]).area
    2.0
    """
    kept = [LinearRing(r) for r in map(_without_repeats, rings) if len(r) >= 3]
    if len(kept) == 1 and kept[0].is_simple:
        return Polygon(kept[0])
    if not kept:
        return Polygon()
    faces = [f for f in polygonize(union(kept)) if f.area > 0]
    if not faces:
        return Polygon()
    with quiet():
        points = shapely.get_coordinates(shapely.point_on_surface(faces))
    winding = _winding_numbers(points, [shapely.get_coordinates(r) for r in kept])
    inside = winding != 0 if rule == "nonzero" else winding % 2 != 0
    return union([f for f, keep in zip(faces, inside, strict=True) if keep])


def enclosed(rings: Sequence[LinearRing]) -> Region:
    """Area that rings enclose by even-odd nesting; fast, as they should not cross.

    >>> sides = (0, 0, 3, 3), (1, 1, 2, 2)
    >>> enclosed([LinearRing(shapely.box(*side).exterior) for side in sides]).area
    8.0
    """
    try:
        with quiet():
            return shapely.build_area(MultiLineString(rings))
    except GEOSException:
        # They do cross.
        return region([shapely.get_coordinates(ring)[:-1] for ring in rings], "evenodd")


def united(regions: Iterable[Region]) -> Region:
    """Union of valid regions; fast where they meet nowhere.

    >>> united([shapely.box(0, 0, 2, 2), shapely.box(1, 0, 3, 2)]).area
    6.0
    """
    every = list(regions)
    parts = [part for region in every for part in polygon_parts(region)]
    if len(parts) == 1:
        return parts[0]
    if len(every) == 1 and isinstance(every[0], MultiPolygon) and len(parts) > 1:
        return every[0]
    whole = MultiPolygon(parts)
    return whole if whole.is_valid else union(parts)


def silhouette(shape: Region) -> Region:
    """Region with every hole filled, parts that lay in holes absorbed.

    >>> silhouette(shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2)).area
    9.0
    """
    parts = polygon_parts(shape)
    if not any(part.interiors for part in parts):
        return shape
    return union([Polygon(part.exterior) for part in parts])


def silhouette_area(shape: Region) -> float:
    """Area of :func:`silhouette`, without a union where no part can lie in a hole.

    >>> silhouette_area(shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2))
    9.0
    """
    parts = polygon_parts(shape)
    if len(parts) > FEW_PARTS or _has_box_in_box(shapely.bounds(parts)):
        return float(silhouette(shape).area)
    return float(shapely.area(shapely.polygons(shapely.get_exterior_ring(parts))).sum())


def _has_box_in_box(boxes: FloatArray) -> bool:
    low, high = boxes[:, None, :2] <= boxes[None, :, :2], boxes[:, None, 2:] >= boxes[None, :, 2:]
    return bool((low & high).all(axis=2).sum() > len(boxes))


def oriented_rings(shape: Region) -> list[FloatArray]:
    """Rings of a region, unclosed: outer ones clockwise on screen, holes the other way.

    >>> [len(r) for r in oriented_rings(shapely.box(0, 0, 1, 1))]
    [4]
    """
    parts = polygon_parts(shape)
    if len(parts) == 1 and shapely.get_num_interior_rings(parts[0]) == 0:
        ring = shapely.get_coordinates(parts[0])
        return [ring[:-1] if signed_area(ring) > 0 else ring[-2::-1]]
    rings, owners = shapely.get_rings(parts, return_index=True)
    if len(rings) == 0:
        return []
    points, rows = shapely.get_coordinates(rings, return_index=True)
    # The first ring of a polygon is its outer one; the last point of a ring is its first.
    is_outer = np.diff(owners, prepend=-1) > 0
    starts = np.flatnonzero(np.diff(rows, prepend=-1))
    turned = (_signed_areas(points, starts) > 0) != is_outer
    split = np.split(points, starts[1:])
    return [
        ring[-2::-1] if is_turned else ring[:-1]
        for ring, is_turned in zip(split, turned, strict=True)
    ]


def _signed_areas(points: FloatArray, starts: IntArray) -> FloatArray:
    """The same as :func:`signed_area` of closed rings ``(n, 2)``, one after another."""
    lengths = np.diff(starts, append=len(points))
    x, y = (points - np.repeat(points[starts], lengths, axis=0)).T
    # About a ring's first point, which is its last as well: what links two rings adds nothing.
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    return np.asarray(0.5 * np.add.reduceat(cross, starts))


def signed_area(points: FloatArray) -> float:
    """Shoelace area of one ring ``(n, 2)``, its unit squared: positive if clockwise on screen.

    >>> signed_area(np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]))
    1.0
    """
    # About the first point, whose own two terms are then 0.
    x, y = (points[1:] - points[0]).T
    return 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def _without_repeats(ring: FloatArray) -> FloatArray:
    points = np.asarray(ring, dtype=np.float64)
    if len(points) == 0:
        return points
    moved = (points != np.roll(points, 1, axis=0)).any(axis=1)
    return np.asarray(points[moved])


def _winding_numbers(queries: FloatArray, rings: Sequence[FloatArray]) -> np.ndarray[Any, Any]:
    """Winding number of the closed ``rings`` about each query point; signed.

    Counts the edges that a ray to the right of the point crosses; an index over the
    edges keeps that near linear for compound paths of thousands of rings.
    """
    a = np.concatenate([ring[:-1] for ring in rings])
    b = np.concatenate([ring[1:] for ring in rings])
    near = _beside_each if len(queries) * len(a) <= FEW_PAIRS else _beside
    ray, edge = near(queries, a, b)
    (x, y), a, b = queries[ray].T, a[edge], b[edge]
    side = (b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (x - a[:, 0]) * (b[:, 1] - a[:, 1])
    down = (a[:, 1] <= y) & (b[:, 1] > y) & (side > 0)
    up = (a[:, 1] > y) & (b[:, 1] <= y) & (side < 0)
    turns = down.astype(np.int64) - up.astype(np.int64)
    return np.bincount(ray, weights=turns, minlength=len(queries)).astype(np.int64)


def _beside_each(queries: FloatArray, a: FloatArray, b: FloatArray) -> tuple[IntArray, IntArray]:
    """Pairs of a point and an edge whose box the ray to the right of the point meets."""
    x, y = queries.T[:, :, None]
    low, high = np.minimum(a, b), np.maximum(a, b)
    ray, edge = np.nonzero((low[:, 1] <= y) & (y <= high[:, 1]) & (high[:, 0] >= x))
    return ray, edge


def _beside(queries: FloatArray, a: FloatArray, b: FloatArray) -> tuple[IntArray, IntArray]:
    """The same by an index."""
    right = max(float(a[:, 0].max()), float(b[:, 0].max()))
    ends = np.column_stack([np.full(len(queries), right), queries[:, 1]])
    rays = shapely.linestrings(np.stack([queries, ends], axis=1))
    ray, edge = shapely.STRtree(shapely.linestrings(np.stack([a, b], axis=1))).query(rays)
    return ray, edge
