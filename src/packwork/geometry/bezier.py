"""Flattening of curves to polylines, each with a stated tolerance.

A cubic's chord error over a parameter step ``h`` is at most ``h**2 / 8`` times the largest second
derivative, so the number of equal steps is known beforehand: Wang's formula (R. Goldman, "Pyramid
Algorithms", Morgan Kaufmann 2003, section 5.6.3).
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from packwork.arrays import FloatArray

FLATTENING = 2e-5
"""Largest distance of a curve from its chords, as a share of the drawing's extent: half a pixel of
a print 25,000 px wide. Smaller costs vertices, larger shows on posters. Chosen."""

MAX_STEPS = 2_000
"""Steps in one curve at most: larger costs memory on hostile files, smaller loosens the tolerance
on huge curves. Chosen."""


def flatten_cubic(
    p0: FloatArray, p1: FloatArray, p2: FloatArray, p3: FloatArray, tolerance: float
) -> FloatArray:
    """Points ``(k, 2)`` along a cubic Bezier, its first point left out, its last kept.

    The polyline is within ``tolerance`` of the curve (up to ``MAX_STEPS`` steps).

    >>> straight = [np.array([float(i), 0.0]) for i in range(4)]
    >>> flatten_cubic(*straight, tolerance=0.1).tolist()
    [[3.0, 0.0]]
    """
    bend = max(
        float(np.hypot(*(p0 - 2 * p1 + p2))),
        float(np.hypot(*(p1 - 2 * p2 + p3))),
    )
    steps = math.ceil(math.sqrt(6 * bend / (8 * tolerance))) if bend > 0 else 1
    steps = min(max(steps, 1), MAX_STEPS)
    first, second, third, last = _shares(steps)
    return np.asarray(first * p0 + second * p1 + third * p2 + last * p3)


@lru_cache(64)
def _shares(steps: int) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """``(steps, 1)`` of each point of a cubic in those along it; a font's curves take few steps."""
    t = np.arange(1, steps + 1)[:, None] / steps
    s = 1 - t
    return s**3, 3 * s * s * t, 3 * s * t * t, t**3
