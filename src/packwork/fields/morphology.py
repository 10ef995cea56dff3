"""Mathematical morphology of masks: closing, opening, erosion, thinning and granulometry.

J. Serra, "Image Analysis and Mathematical Morphology", Academic Press 1982; thickness by openings
of growing radius (G. Matheron, "Random Sets and Integral Geometry", Wiley 1975). Discs are drawn by
distance transforms. The skeleton is thinned by Z. Guo and R. Hall, "Parallel thinning with
two-subiteration algorithms", Communications of the ACM 32 (1989), 359-373, doi:10.1145/62065.62074,
algorithm A1. Zhang and Suen's older conditions delete squares of two by two pixels whole; these
keep every part in one piece.
"""

from __future__ import annotations

import bisect
import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.fields import _kernels
from packwork.fields.distance_transform import distance_to


def closed(mask: BoolArray, radius_px: float) -> BoolArray:
    """Closing of a mask ``(rows, columns)``: what a disc of a radius, px, cannot enter is filled.

    What lies off the image counts as outside.

    >>> ring = np.ones((3, 3), dtype=bool)
    >>> ring[1, 1] = False
    >>> bool(closed(ring, 1.0)[1, 1])
    True
    """
    margin = int(radius_px) + 2
    near = distance_to(np.pad(mask, margin)) <= radius_px
    within = (slice(margin, -margin),) * 2
    return np.asarray((distance_to(~near) > radius_px)[within])


def eroded(mask: BoolArray, steps: int) -> BoolArray:
    """Mask ``(rows, columns)`` without what some steps from side to side lead out of.

    What lies off the image counts as outside.

    >>> eroded(np.ones((3, 4), dtype=bool), 1).astype(int).tolist()
    [[0, 0, 0, 0], [0, 1, 1, 0], [0, 0, 0, 0]]
    """
    for _ in range(steps):
        padded = np.pad(mask, 1)
        across = padded[1:-1, :-2] & padded[1:-1, 2:]
        mask = mask & across & padded[:-2, 1:-1] & padded[2:, 1:-1]
    return mask


STEPS = 20
"""Radii looked at, each the same factor larger than the last. More tell the thickness finer and
take longer. Chosen."""


@dataclass(frozen=True, eq=False)
class Thickness:
    """Morphological openings of a region by discs of several radii.

    ``radii_px``: ``(m,)``, growing. ``missing_at``: share of the region that is farther than some
    reach from every place that a disc of the radius of that index inside the region can cover; it
    grows with the radius, and is asked only where it must be known.
    """

    radii_px: FloatArray
    missing_at: Callable[[int], float]

    def radius_for(self, missing: float) -> float:
        """Largest radius whose discs leave no more than that share of the region unreached.

        >>> Thickness(np.array([1.0, 2.0, 4.0]), (0.0, 0.0, 0.4).__getitem__).radius_for(0.2)
        2.8284271247461903
        """
        count = len(self.radii_px)
        after = bisect.bisect_right(range(count), missing, key=self.missing_at)
        if after in {0, count}:
            return float(self.radii_px[min(after, count - 1)])
        low, high = self.missing_at(after - 1), self.missing_at(after)
        share = (missing - low) / (high - low)
        near, far = self.radii_px[after - 1 : after + 1]
        return float(near * (far / near) ** share)

    def missing_for(self, radius_px: float) -> float:
        """Share of the region that discs of a radius leave unreached.

        >>> Thickness(np.array([1.0, 2.0, 4.0]), (0.0, 0.0, 0.4).__getitem__).missing_for(4.0)
        0.4
        """
        after = int(np.searchsorted(self.radii_px, radius_px))
        about = sorted({max(after - 1, 0), min(after, len(self.radii_px) - 1)})
        shares = [self.missing_at(k) for k in about]
        return float(np.interp(np.log(radius_px), np.log(self.radii_px[about]), shares))


def thickness(mask: BoolArray, reach_px: float) -> Thickness:
    """Thickness of a mask ``(rows, columns)`` of at least one pixel; lengths in pixels.

    >>> bar = np.zeros((30, 60), dtype=bool)
    >>> bar[10:20, 5:55] = True
    >>> 4.4 < thickness(bar, 1.0).radius_for(0.1) < 5.5
    True
    """
    room = distance_to(np.pad(~mask, 1, constant_values=True))[1:-1, 1:-1] - 0.5
    radii = np.geomspace(0.5, max(float(room.max()), 1.0), STEPS)
    whole = int(np.count_nonzero(mask))

    @functools.cache
    def missing_at(k: int) -> float:
        away = distance_to(room >= radii[k]) > radii[k] + reach_px
        return int(np.count_nonzero(mask & away)) / whole

    return Thickness(radii, missing_at)


def _removable() -> BoolArray:
    """``(2, 256)``: whether a pixel with these neighbours goes in the first, second sub-iteration.

    Neighbours are bits, clockwise from the one above; ``p2`` to ``p9`` as the paper names them.
    """
    p2, p3, p4, p5, p6, p7, p8, p9 = (np.arange(256) >> np.arange(8)[:, None]) & 1 == 1
    corners = ((p2, p3, p4), (p4, p5, p6), (p6, p7, p8), (p8, p9, p2))
    connected = sum((~a & (b | c)).astype(int) for a, b, c in corners)
    sides = sum((a | b).astype(int) for a, b in ((p9, p2), (p3, p4), (p5, p6), (p7, p8)))
    other_sides = sum((a | b).astype(int) for a, b in ((p2, p3), (p4, p5), (p6, p7), (p8, p9)))
    neighbours = np.minimum(sides, other_sides)
    is_simple = (connected == 1) & (neighbours >= 2) & (neighbours <= 3)
    return np.stack([is_simple & ~((p2 | p3 | ~p5) & p4), is_simple & ~((p6 | p7 | ~p9) & p8)])


def medial_axis(mask: BoolArray) -> BoolArray:
    """True on the line, one pixel wide, that runs midway between the region's edges.

    Thinned, not read from the distance field: staircases of slanting edges grow no branches. Every
    part of the region keeps at least one pixel. What lies off the image counts as outside.

    >>> medial_axis(np.ones((3, 6), dtype=bool)).any(axis=1).tolist()
    [False, True, False]
    """
    image = np.pad(mask, 1).astype(np.uint8)
    rows, cols = np.nonzero(image)
    _kernels.thin(image, _removable(), rows, cols)
    return image[1:-1, 1:-1].astype(np.bool_)
