"""Flattening of curves to polylines, each with a stated tolerance.

A cubic's chord error over a parameter step ``h`` is at most ``h**2 / 8`` times the largest second
derivative, so the number of equal steps is known beforehand: Wang's formula (R. Goldman, "Pyramid
Algorithms", Morgan Kaufmann 2003, section 5.6.3).
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray

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
    return flatten_cubics(np.array([[p0, p1, p2, p3]]), tolerance)[0]


def flatten_cubics(controls: FloatArray, tolerance: float) -> tuple[FloatArray, IntArray]:
    """Points ``(k, 2)`` of cubics ``(n, 4, 2)``, one after another, and ``(n,)`` how many each has.

    Of each as ``flatten_cubic`` says; one whose four points are the same is that point.

    >>> straight = np.array([[[0.0, 0], [1, 0], [2, 0], [3, 0]], [[3.0, 0]] * 4])
    >>> [found.tolist() for found in flatten_cubics(straight, tolerance=0.1)]
    [[[3.0, 0.0], [3.0, 0.0]], [1, 1]]
    """
    p0, p1, p2, p3 = controls.transpose(1, 0, 2)
    bend = np.maximum(np.hypot(*(p0 - 2 * p1 + p2).T), np.hypot(*(p1 - 2 * p2 + p3).T))
    steps = np.clip(np.ceil(np.sqrt(6 * bend / (8 * tolerance))), 1, MAX_STEPS).astype(np.int64)
    curve = np.repeat(np.arange(len(steps)), steps)
    number = np.arange(1, len(curve) + 1) - np.repeat(np.cumsum(steps) - steps, steps)
    t = (number / steps[curve])[:, None]
    s = 1 - t
    first, second, third, last = s**3, 3 * s * s * t, 3 * s * t * t, t**3
    found = first * p0[curve] + second * p1[curve] + third * p2[curve] + last * p3[curve]
    return found, steps
