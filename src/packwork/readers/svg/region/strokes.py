"""Stroke region of a polyline: width, caps, joins and mitre limit.

GEOS offsets the flattened centre line. It may cut shallow dents of the line by up to 1 %
of half the width, always outwards, so the region covers the true stroke. Its mitre limit
differs from SVG's (it clips where SVG bevels), so mitres are added here, corner by corner.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from shapely.geometry import LinearRing, LineString, Point, Polygon

from packwork.arrays import FloatArray
from packwork.geometry.overlay import buffered, union
from packwork.geometry.polygon import Region
from packwork.readers.svg_syntax.painting import StrokeStyle

MAX_QUARTER_STEPS = 64
"""Chords of a quarter turn at most, as for a width as large as the drawing. Chosen."""

_CAPS = {"butt": "flat", "round": "round", "square": "square"}
_JOINS = {"round": "round", "bevel": "bevel"}


def stroke_region(
    points: FloatArray, is_closed: bool, pen: StrokeStyle, tolerance: float
) -> Region:
    """Region that ``pen`` paints along a polyline; valid, empty for an invisible dot.

    Parameters
    ----------
    points
        ``(n, 2)``, not closed by repetition.
    tolerance
        Largest distance of a round cap or join from its chords.

    Examples
    --------
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
