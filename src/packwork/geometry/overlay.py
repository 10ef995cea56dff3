"""Set operations on regions that answer whatever outlines they are given.

GEOS gives up on outlines that cross themselves or all but touch ("side location conflict").
Then the regions are repaired and the operation is tried again, at last on a grid. Everything
that unites, cuts or grows regions goes through here; a test holds the package to that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TypeAlias

import numpy as np
import shapely
from shapely.errors import GEOSException
from shapely.geometry import MultiPolygon, Polygon

from packwork.errors import UnresolvedError

Region: TypeAlias = Any
"""A Shapely Polygon or MultiPolygon (Shapely ships no types)."""

GRIDS = (0.0, 1e-12, 1e-10, 1e-8)
"""Steps of the grids tried in turn on regions that were repaired, as shares of their extent; 0 is
none. Coarser ones answer more and are less exact; the last is far finer than what readers follow
curves to. Chosen."""

_ROOM = 0.01

LONGEST_RING = 20_000
"""Points of a ring that GEOS simplifies in one: it calls itself for each corner of a zigzag, and at
60,000 the stack ends the process. Derived."""

PIECE = 2_000
"""Points of the pieces of a longer one. Of a zigzag each takes time with its square. Chosen."""


def quiet() -> np.errstate:
    """Context in which GEOS says nothing of what it only tries.

    Of corners that touch, and of differences near the smallest numbers, it divides by zero on its
    way to an answer that is right; NumPy would warn of that.
    """
    return np.errstate(divide="ignore", over="ignore", invalid="ignore")


def polygon_parts(shape: Region) -> list[Polygon]:
    """Polygons of a region, whatever mixture of geometries an operation left.

    >>> len(polygon_parts(Polygon()))
    0
    """
    if isinstance(shape, Polygon):
        # As nearly all are: the arrays below take fifteen times as long.
        return [shape] if shape.area > 0 else []
    parts = shapely.get_parts(shapely.get_parts(shape))
    kept = (shapely.get_type_id(parts) == shapely.GeometryType.POLYGON) & (shapely.area(parts) > 0)
    return list(parts[kept])


def valid(shape: Region) -> Region:
    """The region itself if it is valid, else one of the polygons that a repair leaves.

    >>> bow_tie = Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> valid(bow_tie).area
    2.0
    """
    if shape.is_valid:
        return shape
    # Repairs may leave whiskers, lines without area: only polygons count.
    return union(polygon_parts(_answered(shapely.make_valid, shape)))


def prepared(shapes: Any) -> Any:
    """Copies of a region or of an array ``(n,)`` of them, prepared for many questions.

    What outlines keep is shared by threads, and GEOS lets only one at a time ask a prepared region.

    >>> box = shapely.box(0, 0, 1, 1)
    >>> bool(shapely.is_prepared(prepared(box))), bool(shapely.is_prepared(box))
    (True, False)
    """
    copies = shapely.force_2d(shapes)
    shapely.prepare(copies)
    return copies


def union(shapes: Iterable[Region]) -> Region:
    """Union of the regions.

    >>> union([shapely.box(0, 0, 2, 2), shapely.box(1, 0, 3, 2)]).area
    6.0
    """
    return _answered(lambda *parts: shapely.union_all(list(parts)), *shapes)


def union_of_layout(shapes: Iterable[Region]) -> Region:
    """:func:`union` of regions of which few meet another, sooner.

    >>> union_of_layout([shapely.box(0, 0, 2, 2), shapely.box(3, 0, 4, 1)]).area
    5.0
    """
    return _answered(lambda *parts: shapely.disjoint_subset_union_all(list(parts)), *shapes)


def intersection(first: Region, second: Region) -> Region:
    """Intersection of both regions; of arrays, one by one.

    >>> bow_tie = Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
    >>> intersection(bow_tie, shapely.box(0, 0, 2, 1)).area
    1.0
    """
    return _answered(shapely.intersection, first, second)


def difference(first: Region, second: Region) -> Region:
    """Difference: the first region without the second; of arrays, one by one.

    >>> difference(shapely.box(0, 0, 2, 2), shapely.box(1, 0, 3, 2)).area
    2.0
    """
    return _answered(shapely.difference, first, second)


def part_about(whole: Region, shape: Region, reach: float = 0.0) -> Region:
    """Part of a region in the box about a shape, grown by ``reach``; of arrays, one by one.

    A set operation with a shape takes as long as the region has vertices: five seconds with a
    spiral of 270,000, a millisecond with the part of it.

    >>> part_about(shapely.box(0, 0, 9, 9), shapely.box(8, 8, 10, 10), 1.0).bounds
    (7.0, 7.0, 9.0, 9.0)
    """
    if isinstance(shape, np.ndarray):
        found = np.empty(len(shape), dtype=object)
        found[:] = [part_about(whole, one, reach) for one in shape]
        return found
    left, top, right, bottom = shape.bounds
    # Away from the shape's own edges, or its box and the region's would share one.
    reach = max(reach, _ROOM * max(right - left, bottom - top))
    box = (left - reach, top - reach, right + reach, bottom + reach)
    return valid(_answered(lambda one: shapely.clip_by_rect(one, *box), whole))


def symmetric_difference(first: Region, second: Region) -> Region:
    """Symmetric difference: covered by one of the regions and not by the other.

    >>> symmetric_difference(shapely.box(0, 0, 2, 2), shapely.box(1, 0, 3, 2)).area
    4.0
    """
    return _answered(shapely.symmetric_difference, first, second)


def buffered(shape: Region, distance: float, **style: Any) -> Region:
    """The region grown by a distance all round, or shrunk by a negative one.

    >>> buffered(shapely.box(0, 0, 2, 2), 1.0, join_style="mitre").area
    16.0
    """
    return _answered(lambda one: shapely.buffer(one, distance, **style), shape)


def simplify(shape: Region, tolerance: float, *, keeps_topology: bool) -> Region:
    """The region by fewer vertices (Douglas and Peucker), each within ``tolerance``.

    >>> shape = Polygon([(0, 0), (1, 0.001), (2, 0), (2, 2), (0, 2)])
    >>> len(simplify(shape, 0.1, keeps_topology=True).exterior.coords)
    5
    """
    rings = [shape.exterior, *shape.interiors] if isinstance(shape, Polygon) else []
    if isinstance(shape, MultiPolygon):
        rings = [ring for part in shape.geoms for ring in (part.exterior, *part.interiors)]
    if any(shapely.get_num_coordinates(ring) > LONGEST_RING for ring in rings):
        return valid(_by_pieces(shape, tolerance))
    return _answered(
        lambda one: shapely.simplify(one, tolerance, preserve_topology=keeps_topology), shape
    )


def _by_pieces(shape: Region, tolerance: float) -> Region:
    """The region, each ring simplified in pieces whose ends are kept."""
    parts = [shape] if isinstance(shape, Polygon) else list(shape.geoms)
    return shapely.MultiPolygon(
        [
            Polygon(
                _plainer(part.exterior, tolerance), [_plainer(r, tolerance) for r in part.interiors]
            )
            for part in parts
        ]
    )


def _plainer(ring: Any, tolerance: float) -> Any:
    points = shapely.get_coordinates(ring)
    if len(points) <= PIECE:
        return points
    cuts = range(0, len(points) - 1, PIECE)
    pieces = [shapely.LineString(points[first : first + PIECE + 1]) for first in cuts]
    plainer = [
        shapely.get_coordinates(shapely.simplify(piece, tolerance, preserve_topology=False))
        for piece in pieces
    ]
    return np.concatenate([piece[:-1] for piece in plainer])


def _answered(operation: Callable[..., Any], *operands: Any) -> Any:
    """Outcome of an operation on regions or arrays of them, repaired where that is needed.

    Raises ``UnresolvedError`` if GEOS gives up on the coarsest grid too.
    """
    with quiet():
        try:
            return operation(*operands)
        except GEOSException:
            pass
        if any(isinstance(operand, np.ndarray) for operand in operands):
            rows = np.broadcast(*(np.asarray(operand, dtype=object) for operand in operands))
            found = np.empty(rows.size, dtype=object)
            found[:] = [_answered(operation, *row) for row in rows]
            return found.reshape(rows.shape)
        return _on_grids(operation, operands)


def _on_grids(operation: Callable[..., Any], operands: tuple[Any, ...]) -> Any:
    extent = max((_extent(operand) for operand in operands), default=0.0)
    for share in GRIDS:
        try:
            mended = [_repaired(operand) for operand in operands]
            if share:
                mended = [shapely.set_precision(operand, share * extent) for operand in mended]
            return operation(*mended)
        except GEOSException:
            continue
    raise UnresolvedError("has outlines too close to tell apart; simplify it")


def _repaired(shape: Region) -> Region:
    """Regions valid; lines as they are."""
    is_area = shapely.get_dimensions(shape) == 2
    return shapely.make_valid(shape, method="structure") if is_area else shape


def _extent(shape: Region) -> float:
    left, top, right, bottom = shape.bounds
    return float(max(right - left, bottom - top))
