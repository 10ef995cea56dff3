"""Flattening: the polyline is within its tolerance of the curve."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from packwork.arrays import FloatArray
from packwork.geometry.bezier import MAX_STEPS, flatten_cubic

points = st.tuples(st.floats(-100, 100), st.floats(-100, 100)).map(lambda p: np.round(p, 6))
cubics = st.tuples(points, points, points, points)
Cubic: TypeAlias = tuple[FloatArray, FloatArray, FloatArray, FloatArray]
tolerances = st.floats(1e-4, 10)


def _on_curve(control: Cubic, count: int) -> FloatArray:
    t = np.linspace(0, 1, count)[:, None]
    p0, p1, p2, p3 = control
    return np.asarray(
        (1 - t) ** 3 * p0 + 3 * (1 - t) ** 2 * t * p1 + 3 * (1 - t) * t**2 * p2 + t**3 * p3
    )


@given(control=cubics, tolerance=tolerances)
def test_a_flattened_cubic_is_within_its_tolerance(control: Cubic, tolerance: float) -> None:
    flat = flatten_cubic(*control, tolerance)
    polyline = shapely.LineString([control[0], *flat])
    away = shapely.distance(shapely.points(_on_curve(control, 997)), polyline)
    assert float(away.max()) <= tolerance * (1 + 1e-9) + 1e-12
    np.testing.assert_allclose(flat[-1], control[3], atol=1e-12)


@given(control=cubics, tolerance=tolerances)
def test_flattening_wastes_no_steps(control: Cubic, tolerance: float) -> None:
    """Four times the tolerance takes about half the steps."""
    fine = len(flatten_cubic(*control, tolerance))
    coarse = len(flatten_cubic(*control, 4 * tolerance))
    assert coarse <= fine / 2 + 1


def test_degenerate_cubics() -> None:
    place = np.array([3.0, 4.0])
    assert flatten_cubic(place, place, place, place, 0.1).tolist() == [[3.0, 4.0]]
    end = np.array([9.0, 0.0])
    straight = flatten_cubic(np.zeros(2), np.zeros(2), end, end, 0.1)
    assert not straight[:, 1].any()
    assert (np.diff(straight[:, 0]) > 0).all()


def test_steps_are_bounded_on_hostile_curves() -> None:
    far = np.array([1e12, 0.0])
    assert len(flatten_cubic(np.zeros(2), far, -far, np.ones(2), 1e-9)) == MAX_STEPS
