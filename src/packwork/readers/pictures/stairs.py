"""Straight edges fitted to the pixel stairs of hard-edged masks.

A contour is cut where it turns (Douglas-Peucker), a line is fitted to the pixels of each
stretch, and neighbouring lines are met. Straight edges come back unbiased and corners
sharp, where a blur would round them and plain simplifying would cut them off.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.overlay import simplify

STAIR_PX = 1.0
"""Distance within which the stairs of a straight edge lie from a chord between two of
them: half a pixel on either side of the edge. Larger swallows shallow corners, smaller
leaves stairs. Derived."""

_FARTHEST_PX = 1.5
"""How far a corner may move from where the contour turned. Chosen."""

_PARALLEL = 0.1
"""Sine of the angle below which two lines have no corner worth meeting in. Chosen."""


def without_stairs(ring: FloatArray) -> FloatArray:
    """Ring ``(k, 2)`` of fitted edges for the contour ``(n, 2)`` of a hard mask, in pixels.

    Rings too small to have edges come back as they are.

    Examples
    --------
    >>> side = np.arange(1.0, 10.0)
    >>> zero, ten = np.zeros(9), np.full(9, 10.0)
    >>> x = np.concatenate([side, ten, side[::-1], zero])
    >>> y = np.concatenate([zero, side, ten, side[::-1]])
    >>> sorted(map(tuple, without_stairs(np.column_stack([x, y])).round(9).tolist()))
    [(0.0, 0.0), (0.0, 10.0), (10.0, 0.0), (10.0, 10.0)]
    """
    turned, cuts = _cut(ring)
    if len(cuts) < 4:
        return ring
    lines = [_fitted(turned[first : last + 1]) for first, last in pairwise(cuts)]
    corners = turned[cuts[:-1]]
    return np.array([_corner(corners[k], lines[k - 1], lines[k]) for k in range(len(corners))])


def _cut(ring: FloatArray) -> tuple[FloatArray, IntArray]:
    """Closed ring that begins at a far corner, and the indices where it turns."""
    start = int(np.hypot(*(ring - ring.mean(axis=0)).T).argmax())
    turned = np.concatenate([np.roll(ring, -start, axis=0), ring[start : start + 1]])
    kept = shapely.get_coordinates(
        simplify(shapely.LineString(turned), STAIR_PX, keeps_topology=True)
    )
    cuts, place = [0], 0
    for point in kept[1:]:
        place += 1 + int((turned[place + 1 :] == point).all(axis=1).argmax())
        cuts.append(place)
    return turned, np.array(cuts)


def _fitted(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Point on, and direction of, the line nearest to points; corner pixels left out."""
    inner = points[1:-1] if len(points) > 4 else points
    middle = inner.mean(axis=0)
    way = np.linalg.svd(inner - middle, full_matrices=False)[2][0]
    return middle, way


def _corner(
    at: FloatArray, before: tuple[FloatArray, FloatArray], after: tuple[FloatArray, FloatArray]
) -> FloatArray:
    """Where two lines meet near ``at``; if they do not, the middle between them."""
    (p, u), (q, v) = before, after
    sine = u[0] * v[1] - u[1] * v[0]
    if abs(sine) > _PARALLEL:
        share = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / sine
        met = p + share * u
        if np.hypot(*(met - at)) <= _FARTHEST_PX:
            return np.asarray(met)
    nearest = [base + ((at - base) @ way) * way for base, way in (before, after)]
    return np.asarray((nearest[0] + nearest[1]) / 2)
