"""Lines of a drawing joined end to end to rings, and rings nested in one another to parts."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.arcs import ArcLine, joined_lines
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import intersection
from packwork.geometry.polygon import signed_area
from packwork.readers.dxf.entities import CadLine
from packwork.readers.reading import UnfitError, spend

JOINED = 5e-5
"""Gap between two ends, as a share of the drawing's size, across which they are one. Larger joins
what is apart, smaller leaves outlines of careless programs open. Chosen: 5 um of 10 cm."""

SAME = 1e-7
"""Length, as a share of the drawing's size, that is none. Chosen: what rounding leaves."""

NEAR_PAIRS = 20
"""Ends, to each, that may lie within that gap, on an average: more are no drawing. Chosen."""

AT_ONCE = 64
"""Rings whose neighbours are asked for at once: their number is known before it takes memory."""

PAIR_NS = 20_000.0
"""Counted work of comparing two rings whose boxes meet, in nanoseconds. Measured."""


@dataclass(frozen=True, eq=False)
class Ring:
    """A closed line, its area positive, and the same with straight sides, in drawing units."""

    line: ArcLine
    layer: str
    kind: str
    polygon: Polygon
    page_height: float | None = None


@dataclass(frozen=True, eq=False)
class RingPart:
    """An outer ring and the rings that are its holes."""

    outer: Ring
    holes: tuple[Ring, ...]


def size_of(pieces: Sequence[CadLine]) -> float:
    """Longer side of the box of all points; 0 of none."""
    points = [piece.line.points for piece in pieces]
    return float(np.ptp(np.concatenate(points), axis=0).max()) if points else 0.0


def place(point: FloatArray | Sequence[float], page_height: float | None = None) -> str:
    """A point as messages name it: of an SVG in mm from the left and the top.

    >>> place((2.0, 1 / 3)), place((2.0, 5.0), 80.0)
    ('(2, 0.333333)', '(2, 75) mm')
    """
    if page_height is None:
        return f"({point[0] + 0.0:.6g}, {point[1] + 0.0:.6g})"
    across, down = (round(float(v), 6) + 0.0 for v in (point[0], page_height - point[1]))
    return f"({across:.6g}, {down:.6g}) mm"


def called(one: CadLine | Ring, what: str = "") -> str:
    """A line, or ``what`` stands for several, as messages call it: by its layer, or its colour."""
    what = what or f"the {one.kind}"
    if one.page_height is None:
        return f"layer {one.layer[:40]!r}: {what}"
    return f"{what} in {one.layer[:40]}"


def rings_of(pieces: Sequence[CadLine]) -> tuple[list[Ring], list[CadLine]]:
    """Rings of closed lines and of open ones joined, and the open lines that are left.

    Raises ``UnfitError`` where more than two open lines meet, or a ring crosses itself.
    """
    size = size_of(pieces)
    sound = [cleaned for piece in pieces if (cleaned := _cleaned(piece, SAME * size)) is not None]
    closed = [piece for piece in sound if piece.line.is_closed]
    joined, left = _joined([piece for piece in sound if not piece.line.is_closed], JOINED * size)
    found = [_ring(piece) for piece in (*closed, *joined)]
    return [ring for ring in found if ring is not None], left


def _cleaned(piece: CadLine, least: float) -> CadLine | None:
    """The piece without sides of no length; None if it has no others."""
    line = piece.line
    lengths = np.hypot(*(line.ends - line.points[: line.sides]).T)
    kept = np.ones(len(line.points), dtype=np.bool_)
    kept[: line.sides] = lengths > least
    if kept.all():
        return piece
    # What ends a short side begins the next one; the last point of an open line stays.
    points, bulges = line.points[kept], line.bulges[kept]
    least_points = 2 if not line.is_closed or bulges.any() else 3
    if len(points) < least_points:
        return None
    return replace(piece, line=replace(line, points=points, bulges=bulges))


def _ring(piece: CadLine) -> Ring | None:
    line = piece.line
    tolerance = FLATTENING * max(float(np.ptp(line.points, axis=0).max()), 1e-300)
    points = line.flattened(tolerance)
    if len(points) < 3:
        return None
    polygon = Polygon(points)
    if not polygon.is_valid:
        why, _, where = shapely.is_valid_reason(polygon).partition("[")
        at = "somewhere"
        if where:
            at = place([float(v) for v in where.rstrip("]").split()[:2]], piece.page_height)
        what = "crosses or meets itself" if "ntersection" in why else "is no outline"
        raise UnfitError(f"{called(piece)} {what} at {at}")
    if polygon.area <= SAME * tolerance:
        return None
    return Ring(line if signed_area(points) > 0 else line.reversed(), piece.layer, piece.kind,
                polygon, piece.page_height)  # fmt: skip


def _joined(pieces: Sequence[CadLine], tolerance: float) -> tuple[list[CadLine], list[CadLine]]:
    """Rings of open lines, and those that belong to none."""
    if not pieces:
        return [], []
    ends = np.concatenate([[one.line.points[0], one.line.points[-1]] for one in pieces])
    nodes = _nodes(ends, tolerance).reshape(-1, 2)
    kept, meeting = _core(_unlike(pieces, nodes, tolerance), nodes)
    for node, members in meeting.items():
        if len(members) > 2:
            first = members[0]
            at = ends.reshape(-1, 2, 2)[first][int(nodes[first, 0] != node)]
            raise UnfitError(
                f"{called(pieces[first], f'{len(members)} lines')} meet at "
                f"{place(at, pieces[first].page_height)}, so that no outline is clear; draw each "
                "one closed by itself"
            )
    rings = list(_cycles(pieces, nodes, kept, meeting))
    used = set(kept)
    return rings, [piece for k, piece in enumerate(pieces) if k not in used]


def _nodes(ends: FloatArray, tolerance: float) -> IntArray:
    """Number of the place at which each end lies."""
    # They take a quarter of a second to load, and most runs read no DXF.
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import KDTree

    tree = KDTree(ends)
    if tree.count_neighbors(tree, tolerance) > NEAR_PAIRS * len(ends) + 10_000:
        raise UnfitError("has far too many lines that end at one place; export the outlines alone")
    a, b = tree.query_pairs(tolerance, output_type="ndarray").reshape(-1, 2).T
    links = coo_matrix((np.ones(len(a)), (a, b)), shape=(len(ends), len(ends)))
    return np.asarray(connected_components(links, directed=False)[1])


def _unlike(pieces: Sequence[CadLine], nodes: IntArray, tolerance: float) -> list[int]:
    """Numbers of the lines, of those that lie on one another the first."""
    seen: set[tuple[object, ...]] = set()
    found = []
    for k, piece in enumerate(pieces):
        points = piece.line.flattened(tolerance)
        middle = np.round((points[0] + points[-1] + points.sum(axis=0)) / (tolerance * len(points)))
        key = (*sorted(nodes[k].tolist()), len(points), *middle.tolist())
        if key not in seen:
            seen.add(key)
            found.append(k)
    return found


def _core(chosen: list[int], nodes: IntArray) -> tuple[list[int], dict[int, list[int]]]:
    """Lines that are parts of some round, and those at each place: none hangs loose."""
    meeting: dict[int, list[int]] = defaultdict(list)
    for k in chosen:
        for node in nodes[k].tolist():
            meeting[node].append(k)
    loose = [node for node, members in meeting.items() if len(members) == 1]
    gone: set[int] = set()
    while loose:
        members = meeting[loose.pop()]
        if len(members) != 1:
            continue
        (k,) = members
        gone.add(k)
        for node in nodes[k].tolist():
            meeting[node].remove(k)
            if len(meeting[node]) == 1:
                loose.append(node)
    return [k for k in chosen if k not in gone], meeting


def _cycles(
    pieces: Sequence[CadLine], nodes: IntArray, kept: Sequence[int], meeting: dict[int, list[int]]
) -> Iterator[CadLine]:
    left = dict.fromkeys(kept)
    while left:
        first = next(iter(left))
        k, node, chain = first, int(nodes[first, 0]), list[ArcLine]()
        while k in left:
            del left[k]
            line = pieces[k].line
            is_forward = nodes[k, 0] == node
            chain.append(line if is_forward else line.reversed())
            node = int(nodes[k, 1] if is_forward else nodes[k, 0])
            k = next((other for other in meeting[node] if other in left), k)
        line = joined_lines(chain, is_closed=True)
        if len(line.points) > 2 or line.bulges.any():
            kind = pieces[first].kind if len(chain) == 1 else f"outline of {len(chain)} pieces"
            yield replace(pieces[first], line=line, kind=kind, colour="")


def nested(rings: Sequence[Ring]) -> tuple[list[RingPart], int]:
    """Parts of rings, in the order of their outer ones, and how many rings lay on another.

    A ring inside another is its hole, one inside a hole is a part again. Raises ``UnfitError``
    where two cross.
    """
    order = sorted(range(len(rings)), key=lambda k: -rings[k].polygon.area)
    ranked = [rings[k] for k in order]
    around, same = _around(ranked)
    kept = [k for k in range(len(ranked)) if k not in same]
    holes: dict[int, list[Ring]] = {k: [] for k in kept if len(around[k]) % 2 == 0}
    for k in kept:
        if len(around[k]) % 2 == 1:
            # The innermost around it is the last, for it is the smallest.
            holes[max(around[k])].append(ranked[k])
    outer = sorted(holes, key=lambda k: order[k])
    return [RingPart(ranked[k], tuple(holes[k])) for k in outer], len(same)


def _around(ranked: Sequence[Ring]) -> tuple[list[list[int]], set[int]]:
    """Rings around each, largest first, and those that are the same as a larger one."""
    polygons = np.array([ring.polygon for ring in ranked], dtype=object)
    tree = shapely.STRtree(polygons)
    pairs = list[tuple[int, int]]()
    for begin in range(0, len(polygons), AT_ONCE):
        small, large = tree.query(polygons[begin : begin + AT_ONCE])
        is_pair = large < small + begin
        spend(PAIR_NS * int(is_pair.sum()), f"has {len(ranked):,} outlines inside one another")
        pairs += zip(large[is_pair].tolist(), (small[is_pair] + begin).tolist(), strict=True)
    shapely.prepare(polygons)
    around: list[list[int]] = [[] for _ in ranked]
    same: set[int] = set()
    for outer, inner in sorted(pairs):
        if outer in same or inner in same:
            continue
        if polygons[outer].contains_properly(polygons[inner]):
            around[inner].append(outer)
        elif polygons[outer].intersects(polygons[inner]):
            relation = _relation(ranked[outer], ranked[inner])
            if relation == "same":
                same.add(inner)
            elif relation == "inside":
                around[inner].append(outer)
    return around, same


def _relation(large: Ring, small: Ring) -> str:
    """One of ``inside``, ``apart`` and ``same``, of rings that touch."""
    common = intersection(large.polygon, small.polygon)
    slack = FLATTENING * large.polygon.length * large.polygon.length / 4
    is_inside = small.polygon.area - common.area <= slack
    if is_inside and large.polygon.area - small.polygon.area <= slack:
        return "same"
    if is_inside:
        return "inside"
    if common.area <= slack:
        return "apart"
    met = intersection(large.polygon.exterior, small.polygon.exterior)
    at = shapely.get_coordinates(met)
    point = at[0] if len(at) else shapely.get_coordinates(small.polygon)[0]
    where = place(point, small.page_height)
    on = f"layer {large.layer[:40]!r}" if large.page_height is None else large.layer[:40]
    raise UnfitError(
        f"{called(small)} crosses another one, {'in' if large.page_height is not None else 'on'} "
        f"{on}, at {where}"
    )
