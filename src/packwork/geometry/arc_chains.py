"""Polygons of curves as chains of arcs: the longest one first, as far as all corners lie on it.

The corners lie on the curve, so that an arc through them is nearer to it than the chords are.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.arcs import ArcLine, with_longest_arcs

STEEPEST = 0.3
"""Turn, rad, between chords of one curve at most. Larger rounds corners that are meant, smaller
leaves tight bends straight. Chosen."""


def arcs_through(points: FloatArray, tolerance: float, chord: float) -> ArcLine:
    """Closed line of straight sides and arcs that pass a polygon's corners ``(n, 2)``.

    Parameters
    ----------
    tolerance
        Largest distance of a corner from its arc.
    chord
        Largest distance of an arc from the chords that it stands for; sides that would be farther
        from it stay straight.

    Examples
    --------
    >>> from packwork.geometry.arcs import circle
    >>> rough = circle((0.0, 0.0), 2.0).flattened(1e-4)
    >>> arcs_through(rough, 1e-6, 2e-4).bulges.round(6).tolist()
    [1.0, 1.0]
    >>> arcs_through(np.array([[0.0, 0], [4, 0], [4, 3], [0, 3]]), 1e-6, 1e-3).bulges.tolist()
    [0.0, 0.0, 0.0, 0.0]
    """
    sides = np.roll(points, -1, axis=0) - points
    turns = np.abs(_turns(np.roll(sides, 1, axis=0), sides))
    # A run that begins at a corner, or after a long side, is not cut in two.
    longest = int(np.hypot(*sides.T).argmax()) + 1
    begin = int(turns.argmax()) if turns.max() > STEEPEST else longest
    ring = np.roll(points, -begin, axis=0)
    ring = np.vstack([ring, ring[:1]])
    kept, first = list[tuple[int, float]](), 0
    while first < len(points):
        last, bulge = first + 1, 0.0
        # Twice as far as long as it fits, then half as far until the next corner does not.
        step, grows = 1, True
        while step and last < len(points):
            reach = min(last + step, len(points))
            found = _bulge_through(ring[first : reach + 1], tolerance, chord)
            if found is None:
                grows, step = False, step // 2
            else:
                last, bulge, step = reach, found, 2 * step if grows else step // 2
        kept.append((first, bulge))
        first = last
    starts, bulges = zip(*kept, strict=True)
    line = ArcLine(ring[[*starts]], np.array(bulges), is_closed=True)
    return with_longest_arcs(line, tolerance) if any(bulges) else line


def _bulge_through(points: FloatArray, tolerance: float, chord: float) -> float | None:
    """Bulge of the arc from the first to the last of some points; None if it misses one."""
    start, middle, end = points[0], points[len(points) // 2], points[-1]
    edges = np.diff(points, axis=0)
    turns = _turns(edges[:-1], edges[1:])
    if np.abs(turns).max() > STEEPEST or turns.min() * turns.max() < 0.0:
        return None
    turn = float(_turns((middle - start)[None], (end - middle)[None])[0])
    if not 1e-7 < abs(turn) <= math.pi / 2.0:
        return None
    span = end - start
    # The centre lies across the chord's middle, as far as the angle says.
    centre = (start + end) / 2.0 + np.array([-span[1], span[0]]) / (2.0 * math.tan(turn))
    radius = math.dist(start, centre)
    off = np.abs(np.hypot(*(points - centre).T) - radius).max()
    sagitta = radius - np.hypot(*((points[1:] + points[:-1]) / 2.0 - centre).T).min()
    return math.tan(turn / 2.0) if off <= tolerance and sagitta <= chord else None


def _turns(before: FloatArray, after: FloatArray) -> FloatArray:
    """Angles from one direction to another, ``(n,)``, positive from x towards y."""
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.asarray(np.arctan2(cross, (before * after).sum(axis=1)))
