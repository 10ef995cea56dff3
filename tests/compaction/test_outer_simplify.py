"""Rings that lose vertices, against a slow twin."""

from __future__ import annotations

import math

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.compaction.kernels.outer_simplify import simplify_outward


def _shed_slowly(ring: FloatArray, tolerance: float) -> FloatArray:
    """The slow twin of ``simplify_outward``: looks through all vertices for each change."""
    points, left = ring.copy(), list(range(len(ring)))
    last = 0

    def change(place: int) -> tuple[float, FloatArray | None]:
        u, v, w, x = (points[left[(place + k) % len(left)]] for k in (-1, 0, 1, 2))
        if _turn(u, v, w) <= 0:
            return -_turn(u, v, w) / float(np.hypot(*(w - u))), None
        if _turn(v, w, x) <= 0:
            return math.inf, None
        a, b, d = v - u, w - x, x - u
        across = a[0] * b[1] - a[1] * b[0]
        along = (d[0] * b[1] - d[1] * b[0]) / across if across < 0 else 0.0
        if along < 1:
            return math.inf, None
        corner = u + along * a
        e, c = w - v, corner - v
        if 0.0 < e @ c < e @ e:
            return float(abs(e[0] * c[1] - e[1] * c[0]) / np.hypot(*e)), corner
        return float(min(np.hypot(*c), np.hypot(*(c - e)))), corner

    while len(left) > 3:
        costs = [change(place) for place in range(len(left))]
        vertices = np.array([left[place] for place in range(len(left))])
        best = min(range(len(left)), key=lambda place: (costs[place][0], vertices[place]))
        cost, corner = costs[best]
        if cost > tolerance:
            break
        gone = best if corner is None else (best + 1) % len(left)
        if corner is not None:
            points[left[best]] = corner
        last = left[gone - 1]
        left.pop(gone)
    begin = left.index(last)
    return points[left[begin:] + left[:begin]]


def _turn(u: FloatArray, v: FloatArray, w: FloatArray) -> float:
    return float((v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0]))


def test_shedding_vertices_takes_the_cheapest_first() -> None:
    """As its slow twin does, equal ones by their numbers; regular rings have many equal."""
    rng = np.random.default_rng(0)
    for trial in range(40):
        count = int(rng.integers(3, 60))
        angle = np.arange(count) * 2 * np.pi / count
        radius = 1 + 0.3 * rng.random(count) * (trial % 3)
        ring = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
        tolerance = 10 ** rng.uniform(-4, 0)
        np.testing.assert_allclose(
            simplify_outward(ring, tolerance),
            _shed_slowly(ring, tolerance),
            atol=1e-9,
        )


def test_no_corner_of_stars_lies_farther_off_than_the_tolerance_and_a_third() -> None:
    """Of other rings some do, for changes add up; a star's sides are long beside the tolerance."""
    rng, tolerance = np.random.default_rng(0), 0.05
    for _ in range(3_000):
        turns = np.sort(rng.uniform(0.0, 2.0 * math.pi, rng.integers(4, 12)))
        star = rng.uniform(3.0, 10.0, (len(turns), 1)) * np.column_stack(
            [np.cos(turns), np.sin(turns)]
        )
        # On straight sides, that bend by rounding alone, too.
        shares = [np.sort(rng.uniform(0.0, 1.0, (rng.integers(0, 4), 1)), axis=0) for _ in star]
        sides = zip(star, np.roll(star, -1, axis=0), shares, strict=True)
        ring = np.vstack([np.vstack([a, a + share * (b - a)]) for a, b, share in sides])
        region = shapely.Polygon(ring)
        if not region.is_valid or not region.exterior.is_ccw:
            continue
        fewer = shapely.points(simplify_outward(ring, tolerance))
        assert shapely.distance(region, fewer).max() <= 4.0 / 3.0 * tolerance


def test_a_long_ring_is_shed_at_all() -> None:
    """Forty thousand vertices: two hundred at the end, in n log n steps rather than n times n."""
    angle = np.arange(40_000) * 2 * np.pi / 40_000
    ring = np.column_stack([np.cos(angle) * (1 + 0.1 * np.sin(20 * angle)), np.sin(angle)])
    assert 50 < len(simplify_outward(ring, 1e-3)) < 400
