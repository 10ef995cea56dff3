"""Contours of coverage images at one half, to a fraction of a pixel.

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
from packwork.geometry.polygon import Region, oriented_rings, region, signed_area
from packwork.readers.reading import UnfitError

STAIR_PX = 1.0
"""Distance within which the stairs of a straight edge lie from a chord between two of them:
half a pixel on either side. Larger swallows shallow corners, smaller leaves stairs. Derived."""

_FARTHEST_PX = 1.5
"""How far a corner may move from where the contour turned. Chosen."""

_PARALLEL = 0.1
"""Sine of the angle below which two lines have no corner worth meeting in. Chosen."""


def without_stairs(ring: FloatArray) -> FloatArray:
    """Ring ``(k, 2)`` of fitted edges for the contour ``(n, 2)`` of a hard mask, in pixels.

    Rings too small to have edges come back as they are.

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
    """Point near ``at`` in which two lines meet; if they do not, the middle between them."""
    (p, u), (q, v) = before, after
    sine = u[0] * v[1] - u[1] * v[0]
    if abs(sine) > _PARALLEL:
        share = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / sine
        met = p + share * u
        if np.hypot(*(met - at)) <= _FARTHEST_PX:
            return np.asarray(met)
    nearest = [base + ((at - base) @ way) * way for base, way in (before, after)]
    return np.asarray((nearest[0] + nearest[1]) / 2)


MAX_CONTOURS = 5_000
"""Closed curves in one picture, specks left out. Noise has more, shapes fewer. Chosen."""

MAX_CROSSINGS = 1_000_000
"""Neighbouring pixels between which a picture passes one half, 300 bytes each while contours
are joined. Larger takes memory for noise, smaller refuses fine patterns. Chosen."""

SMALLEST_PX = 4.0
"""Area of a contour, in square pixels, below which it is a speck. Chosen."""

_LEVEL = 0.5
_STEP = 0.8


def contour_region(coverage: FloatArray, simplify_px: float) -> Region:
    """Region in pixels where ``coverage`` ``[row, col]`` is above one half; valid, possibly empty.

    Where nearly all edges are hard, their stairs are taken for the lines they stand for; else the
    contour runs where the grey passes one half, simplified by ``simplify_px`` at most. Outside the
    picture coverage is 0, so a picture that is full to its border gives that border.

    >>> mask = np.zeros((20, 20)); mask[5:15, 5:15] = 1.0
    >>> contour_region(mask, simplify_px=0.1).area.__round__(6)
    100.0
    """
    rings = _rings(coverage)
    if has_hard_edges(coverage):
        return region([without_stairs(ring) for ring in rings], "evenodd")
    traced = region(rings, "evenodd")
    simple = simplify(traced, simplify_px, keeps_topology=True)
    return simple if simple.is_valid and oriented_rings(simple) else traced


def _rings(coverage: FloatArray) -> list[FloatArray]:
    """Contours at one half, specks left out."""
    from contourpy import contour_generator

    inside = coverage > _LEVEL
    crossings = sum(np.count_nonzero(np.diff(inside, axis=axis)) for axis in (0, 1))
    if crossings > MAX_CROSSINGS:
        raise _noisy(f"{crossings:,} edges between its pixels")
    # Contours run between pixel centres; the padding moves them by one.
    found = contour_generator(z=np.pad(coverage, 1), name="serial").lines(_LEVEL)
    rings = [np.asarray(ring)[:-1] - 0.5 for ring in found]
    kept = [ring for ring in rings if abs(signed_area(ring)) >= SMALLEST_PX]
    if len(kept) > MAX_CONTOURS:
        raise _noisy(f"{len(kept):,} separate contours")
    return kept


def _noisy(met: str) -> UnfitError:
    return UnfitError(f"has {met}, as noise has; give a picture of plain shapes")


def has_hard_edges(coverage: FloatArray) -> bool:
    """Whether a mask goes from nothing to full within a pixel nearly everywhere.

    >>> mask = np.zeros((9, 9)); mask[3:6, 3:6] = 1.0
    >>> has_hard_edges(mask)
    True
    """
    steps = sum(np.count_nonzero(np.abs(np.diff(coverage, axis=k)) > _STEP) for k in (0, 1))
    soft = np.count_nonzero(np.abs(coverage - _LEVEL) < _STEP / 2)
    return bool(steps > soft)
