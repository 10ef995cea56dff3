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
from shapely.geometry import LinearRing, MultiPolygon, Polygon
from shapely.ops import polygonize

from packwork.arrays import FloatArray

FillRule: TypeAlias = Literal["nonzero", "evenodd"]
Region: TypeAlias = Any
"""A Shapely Polygon or MultiPolygon (Shapely ships no types)."""


def region(rings: Iterable[FloatArray], rule: FillRule = "nonzero") -> Region:
    """Area that closed ``rings`` fill under ``rule``; valid, possibly empty.

    Parameters
    ----------
    rings
        Arrays ``(n, 2)``; closed implicitly; may cross themselves and each other.
        Rings of fewer than three points have no area and are passed over.

    Examples
    --------
    >>> bow_tie = np.array([[0, 0], [2, 2], [2, 0], [0, 2.0]])
    >>> region([bow_tie]).area
    2.0
    """
    kept = [LinearRing(r) for r in map(_without_repeats, rings) if len(r) >= 3]
    if len(kept) == 1 and kept[0].is_simple:
        return Polygon(kept[0])
    if not kept:
        return Polygon()
    faces = [f for f in polygonize(shapely.unary_union(kept)) if f.area > 0]
    if not faces:
        return Polygon()
    winding = _winding_numbers(
        shapely.get_coordinates(shapely.point_on_surface(faces)),
        [shapely.get_coordinates(r) for r in kept],
    )
    inside = winding != 0 if rule == "nonzero" else winding % 2 != 0
    return shapely.unary_union([f for f, keep in zip(faces, inside, strict=True) if keep])


def polygon_parts(shape: Region) -> list[Polygon]:
    """Polygons of a region, whatever mixture of geometries an operation left.

    Examples
    --------
    >>> len(polygon_parts(Polygon()))
    0
    """
    parts = shapely.get_parts(shape)
    flat = [q for p in parts for q in (p.geoms if isinstance(p, MultiPolygon) else [p])]
    return [p for p in flat if isinstance(p, Polygon) and not p.is_empty and p.area > 0]


def silhouette(shape: Region) -> Region:
    """Region with every hole filled, parts that lay in holes absorbed.

    Examples
    --------
    >>> silhouette(shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2)).area
    9.0
    """
    return shapely.union_all([Polygon(part.exterior) for part in polygon_parts(shape)])


def oriented_rings(shape: Region) -> list[FloatArray]:
    """Rings of a region, unclosed: outer ones clockwise on screen, holes the other way.

    Examples
    --------
    >>> [len(r) for r in oriented_rings(shapely.box(0, 0, 1, 1))]
    [4]
    """
    rings: list[FloatArray] = []
    for polygon in polygon_parts(shape):
        for ring, sign in [(polygon.exterior, 1.0)] + [(h, -1.0) for h in polygon.interiors]:
            points = shapely.get_coordinates(ring)[:-1]
            rings.append(points if signed_area(points) * sign > 0 else points[::-1])
    return rings


def signed_area(points: FloatArray) -> float:
    """Shoelace area of one ring: positive if clockwise on screen (y down).

    Examples
    --------
    >>> signed_area(np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]))
    1.0
    """
    shifted = points - points[0]
    x, y = shifted[:, 0], shifted[:, 1]
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _without_repeats(ring: FloatArray) -> FloatArray:
    points = np.asarray(ring, dtype=np.float64)
    if len(points) == 0:
        return points
    moved = (points != np.roll(points, 1, axis=0)).any(axis=1)
    return np.asarray(points[moved])


def _winding_numbers(queries: FloatArray, rings: Sequence[FloatArray]) -> np.ndarray[Any, Any]:
    """How often the closed ``rings`` go round each query point; signed.

    Counts the edges that a ray to the right of the point crosses; an index over the
    edges keeps that near linear for compound paths of thousands of rings.
    """
    a = np.concatenate([ring[:-1] for ring in rings])
    b = np.concatenate([ring[1:] for ring in rings])
    right = max(float(ring[:, 0].max()) for ring in rings)
    ends = np.column_stack([np.full(len(queries), right), queries[:, 1]])
    rays = shapely.linestrings(np.stack([queries, ends], axis=1))
    ray, edge = shapely.STRtree(shapely.linestrings(np.stack([a, b], axis=1))).query(rays)
    (x, y), a, b = queries[ray].T, a[edge], b[edge]
    side = (b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (x - a[:, 0]) * (b[:, 1] - a[:, 1])
    down = (a[:, 1] <= y) & (b[:, 1] > y) & (side > 0)
    up = (a[:, 1] > y) & (b[:, 1] <= y) & (side < 0)
    turns = down.astype(np.int64) - up.astype(np.int64)
    return np.bincount(ray, weights=turns, minlength=len(queries)).astype(np.int64)
