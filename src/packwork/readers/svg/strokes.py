"""Stroke regions along polylines and their dashes: width, caps, joins and mitre limit.

Flat and square caps stand across the curve's end. The last chord of a flattened curve is off
its direction by the root of the tolerance, and a wide pen carries that to the corners; so
pieces that end are followed finer, and their ends drawn by themselves.

GEOS offsets the flattened centre line. It may cut shallow dents of the line by up to 1 %
of half the width, always outwards, so the region covers the true stroke. Its mitre limit
differs from SVG's (it clips where SVG bevels), so mitres are added here, corner by corner.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from shapely.geometry import LinearRing, LineString, Point, Polygon

from packwork.arrays import FloatArray
from packwork.geometry.overlay import buffered, simplify, union
from packwork.geometry.polygon import Region
from packwork.readers.budget.expansion import MAX_DASHES
from packwork.readers.svg_syntax.painted import StrokeStyle
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.readers.svg_syntax.shapes import flattened_all, step_counts

MAX_QUARTER_STEPS = 64
"""Chords of a quarter turn at most, as for a width as large as the drawing. Chosen."""

_CAPS = {"butt": "flat", "round": "round", "square": "square"}
_JOINS = {"round": "round", "bevel": "bevel"}


def stroke_region(
    points: FloatArray, is_closed: bool, pen: StrokeStyle, tolerance: float
) -> Region:
    """Region that ``pen`` paints along a polyline; valid, empty for an invisible dot.

    ``points`` are ``(n, 2)``, not closed by repetition; ``tolerance`` is the largest distance of a
    round cap or join from its chords.

    >>> stroke_region(np.array([[0.0, 0], [10, 0]]), False, StrokeStyle(2.0, "square"), 0.01).area
    24.0
    """
    line = _distinct(points, is_closed)
    if len(line) < 2:
        return _dot(points[0], pen, tolerance)
    # A ring of two points is a line there and back.
    is_ring = is_closed and len(line) > 2
    path = LinearRing(line) if is_ring else LineString(line)
    painted = buffered(
        path,
        pen.width / 2,
        quad_segs=_quarter_steps(pen.width / 2, tolerance),
        cap_style=_CAPS.get(pen.cap, "flat"),
        join_style=_JOINS.get(pen.join, "bevel"),
    )
    spikes = [] if pen.join in _JOINS else _mitres(line, is_ring, pen, tolerance)
    return union([painted, *spikes]) if spikes else painted


def _distinct(points: FloatArray, is_closed: bool) -> FloatArray:
    """Points without immediate repeats, the first one not repeated at the end of a ring."""
    moved = np.ones(len(points), dtype=bool)
    moved[1:] = (np.diff(points, axis=0) != 0).any(axis=1)
    line = points[moved]
    if is_closed and len(line) > 1 and (line[0] == line[-1]).all():
        line = line[:-1]
    return line


def _dot(at: FloatArray, pen: StrokeStyle, tolerance: float) -> Region:
    """Mark of a piece without length."""
    half = pen.width / 2
    if pen.cap == "round":
        return buffered(Point(at), half, quad_segs=_quarter_steps(half, tolerance))
    if pen.cap == "square":
        return shapely.box(*(at - half), *(at + half))
    return Polygon()


def _quarter_steps(radius: float, tolerance: float) -> int:
    step = 2 * math.acos(max(0.0, 1 - tolerance / radius))
    return min(max(math.ceil(math.pi / 2 / max(step, 1e-6)), 2), MAX_QUARTER_STEPS)


def _mitres(line: FloatArray, is_ring: bool, pen: StrokeStyle, tolerance: float) -> list[Polygon]:
    """Spikes over the bevelled corners that the mitre limit allows."""
    half = pen.width / 2
    corners = np.concatenate([line[-1:], line, line[:1]]) if is_ring else line
    ways = np.diff(corners, axis=0)
    ways /= np.hypot(ways[:, 0], ways[:, 1])[:, None]
    before, after, at = ways[:-1], ways[1:], corners[1:-1]
    turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    half_cosine = np.sqrt(np.maximum(0.0, (1 + (before * after).sum(axis=1)) / 2))
    # The corners of a flattened curve need none: their spikes are below the tolerance.
    is_sharp = half * (1 - half_cosine**2) > tolerance * half_cosine
    allowed = is_sharp & (turn != 0) & (half_cosine * pen.miter_limit >= 1)
    if not allowed.any():
        return []
    side = -np.sign(turn)[:, None] * half
    left = at + side * _normals(before)
    right = at + side * _normals(after)
    with np.errstate(divide="ignore", invalid="ignore"):
        middle = _normals(before) + _normals(after)
        tip = at + side * middle / (2 * half_cosine**2)[:, None]
    return [Polygon([at[k], left[k], tip[k], right[k]]) for k in np.flatnonzero(allowed)]


def _normals(ways: FloatArray) -> FloatArray:
    return np.column_stack([-ways[:, 1], ways[:, 0]])


_DOT = 1e-9
"""Length of a dash without any, as a share of the line's: it has a direction then, which
square caps need."""


def dashed(
    line: FloatArray, is_closed: bool, dashes: Sequence[float], offset: float
) -> list[FloatArray]:
    """Open polylines ``(k, 2)`` of the dashes along a polyline that is not closed by repetition.

    On a closed one a dash that ends where another begins goes on in it. ``dashes`` are dashes and
    gaps in turn, an even number of them, not all zero; the line begins at ``offset`` of them.

    >>> line = np.array([[0.0, 0.0], [10.0, 0.0]])
    >>> [part[:, 0].tolist() for part in dashed(line, False, (3.0, 2.0), 1.0)]
    [[0.0, 2.0], [4.0, 7.0], [9.0, 10.0]]
    """
    path = np.concatenate([line, line[:1]]) if is_closed else line
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    length = float(along[-1])
    period = sum(dashes)
    if length == 0 or length / period * len(dashes) > MAX_DASHES:
        return [path]
    spans = _spans(length, dashes, offset % period)
    parts = [_between(path, along, begin, end) for begin, end in spans]
    if is_closed and len(parts) > 1 and spans[0][0] == 0 and spans[-1][1] == length:
        parts[0] = np.concatenate([parts.pop(), parts[0][1:]])
    return parts


def _spans(length: float, dashes: Sequence[float], offset: float) -> list[tuple[float, float]]:
    """Places along the line at which each dash begins and ends."""
    period = sum(dashes)
    turns = int(np.ceil((length + offset) / period))
    ends = np.cumsum(np.tile(np.asarray(dashes, dtype=np.float64), turns)) - offset
    begins = np.concatenate([[-offset], ends[:-1]])[::2]
    ends = ends[::2]
    shows = (ends >= 0) & (begins < length) & ((ends > 0) | (begins == ends))
    begins, ends = np.maximum(begins[shows], 0.0), np.minimum(ends[shows], length)
    return list(zip(begins.tolist(), ends.tolist(), strict=True))


def _between(path: FloatArray, along: FloatArray, begin: float, end: float) -> FloatArray:
    if begin == end:
        dot = _DOT * float(along[-1])
        begin, end = max(0.0, begin - dot), min(float(along[-1]), end + dot)
    first, last = np.searchsorted(along, begin, "right"), np.searchsorted(along, end, "left")
    near = slice(max(0, int(first) - 1), int(last) + 1)
    ends = np.column_stack(
        [np.interp([begin, end], along[near], path[near, axis]) for axis in (0, 1)]
    )
    return np.concatenate([ends[:1], path[first:last], ends[1:]])


FINER = 4_096.0
"""Factor in tolerance by which pieces that end are followed: a 64th of a chord's length, so
of its error in direction. Larger costs time on dashed lines, smaller leaves corners of caps
off. Tried."""


MAX_FINE_POINTS = 1_000_000
"""Points of one drawing along which pieces that end are followed finer; what comes after
them is followed as any curve. Larger lets rich drawings take seconds. Chosen."""


class FinePoints:
    """Number of ``MAX_FINE_POINTS`` that are left for a drawing.

    >>> left = FinePoints()
    >>> left.factor(100), left.factor(1e9), left.factor(100)
    (4096.0, 1.0, 1.0)
    """

    def __init__(self) -> None:
        self._left = float(MAX_FINE_POINTS)

    def factor(self, count: float) -> float:
        """Factor in tolerance for curves that take ``count`` points without one."""
        factor = min(max(1.0, (self._left / max(count, 1.0)) ** 2), FINER)
        self._left = max(0.0, self._left - count * factor**0.5)
        return factor


def piece_strokes(
    pieces: Sequence[SubPath], pen: StrokeStyle, tolerance: float, points: FinePoints
) -> list[Region]:
    """Regions of all pieces of a path, or of their dashes, in the unit of the pen.

    >>> from packwork.readers.svg_syntax.path_data import parse_path
    >>> pieces = parse_path("M0 0h4 M0 9h2")
    >>> [r.area for r in piece_strokes(pieces, StrokeStyle(2), 0.1, FinePoints())]
    [8.0, 4.0]
    """
    if not pen.dashes and (pen.cap == "round" or all(piece.is_closed for piece in pieces)):
        lines = flattened_all(pieces, tolerance)
        return [
            stroke_region(line, piece.is_closed, pen, tolerance)
            for line, piece in zip(lines, pieces, strict=True)
        ]
    painted: list[Region] = []
    finer = points.factor(sum(float(step_counts(p.segments, tolerance).sum()) for p in pieces))
    for piece, line in zip(pieces, flattened_all(pieces, tolerance / finer), strict=True):
        if pen.dashes:
            parts = dashed(line, piece.is_closed, pen.dashes, pen.dash_offset)
            painted += [open_stroke(part, pen, tolerance) for part in parts]
        elif piece.is_closed:
            painted.append(stroke_region(_thinned(line, tolerance), True, pen, tolerance))
        else:
            painted.append(open_stroke(line, pen, tolerance))
    return painted


def open_stroke(fine: FloatArray, pen: StrokeStyle, tolerance: float) -> Region:
    """Stroke of a line of many more points than it takes, its caps across its very ends.

    >>> turns = np.linspace(0, np.pi / 2, 5_000)
    >>> arc = 10 * np.column_stack([np.cos(turns), np.sin(turns)])
    >>> corners = shapely.get_coordinates(open_stroke(arc, StrokeStyle(4.0), 1e-3))
    >>> bool(np.hypot(*(corners - (0.0, 12.0)).T).min() < 1e-3)
    True
    """
    fine = fine[np.append(True, (np.diff(fine, axis=0) != 0).any(axis=1))]
    thin = _thinned(fine, tolerance)
    plain = stroke_region(thin, False, pen, tolerance)
    if pen.cap == "round" or len(thin) == len(fine):
        return plain
    if len(thin) == 2:
        thin = fine[[0, len(fine) // 2, -1]]
    first, last = _end(fine, thin[1]), _end(fine[::-1], thin[-2])
    caps = [_cap(fine, first, pen), _cap(fine[::-1], last, pen)]
    if first == last == 1 or not all(cap.is_valid for cap in caps):
        return plain
    line = np.concatenate([fine[[first // 2]], thin[1:-1], fine[[len(fine) - 1 - last // 2]]])
    body = stroke_region(line, False, replace(pen, cap="butt"), tolerance)
    return union([body, *caps])


def _end(line: FloatArray, corner: FloatArray) -> int:
    """Place in a line at which the first chord of its thinned form ends; 1 if that is all of it."""
    return int(np.flatnonzero((line == corner).all(axis=1))[0])


def _cap(line: FloatArray, count: int, pen: StrokeStyle) -> Polygon:
    """First half of the first ``count`` steps of a line, a little more, and its cap."""
    half = pen.width / 2
    begin, middle, far = line[0], line[count // 2], line[count]
    out, on = _way(line[1], begin), _way(middle, far)
    side, other = half * np.array([-out[1], out[0]]), half * np.array([on[1], -on[0]])
    tip = begin + (half if pen.cap == "square" else 0.0) * out
    beyond = (middle + far) / 2
    return Polygon(
        [tip + side, middle + other, beyond + other, beyond - other, middle - other, tip - side]
    )


def _way(start: FloatArray, end: FloatArray) -> FloatArray:
    return np.asarray((end - start) / np.hypot(*(end - start)))


def _thinned(line: FloatArray, tolerance: float) -> FloatArray:
    if len(line) < 3:
        return line
    thin = simplify(shapely.LineString(line), tolerance * (1 - 1 / FINER), keeps_topology=True)
    return np.asarray(shapely.get_coordinates(thin))
