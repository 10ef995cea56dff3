"""Stroke regions along pieces of a path, or along their dashes.

Flat and square caps stand across the curve's end. The last chord of a flattened curve is off
its direction by the root of the tolerance, and a wide pen carries that to the corners; so
pieces that end are followed finer, and their ends drawn by themselves.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import FloatArray
from packwork.geometry.overlay import simplify, union
from packwork.geometry.polygon import Region
from packwork.readers.svg.region.dashing import dashed
from packwork.readers.svg.region.strokes import stroke_region
from packwork.readers.svg_syntax.painting import StrokeStyle
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.readers.svg_syntax.shapes import flattened_all, step_counts

FINER = 4_096.0
"""Factor in tolerance by which pieces that end are followed: a 64th of a chord's length, so
of its error in direction. Larger costs time on dashed lines, smaller leaves corners of caps
off. Tried: with 256, those of wide pens were off by 2e-4 of a drawing's extent."""


MAX_FINE_POINTS = 1_000_000
"""Points of one drawing along which pieces that end are followed finer; what comes after
them is followed as any curve. Larger lets rich drawings take seconds. Chosen."""


class FinePoints:
    """How many of ``MAX_FINE_POINTS`` are left for a drawing.

    Examples
    --------
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
    """Regions of all pieces of a path, or of their dashes.

    Parameters
    ----------
    pieces, pen
        In one unit.
    tolerance
        Largest distance of a curve from its chords, and of a round cap or join.
    points
        What the drawing has left.

    Examples
    --------
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

    Examples
    --------
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
    """Where in a line the first chord of its thinned form ends; 1 if that is all of it."""
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
