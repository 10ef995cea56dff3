"""The minimiser: known minima, few calls, and an end where nothing is to be gained."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from packwork.arrays import FloatArray
from packwork.fit.descent import minimise
from strategies import generators


def rosenbrock(x: FloatArray) -> tuple[float, FloatArray]:
    a, b = x[1:] - x[:-1] ** 2, 1 - x[:-1]
    gradient = np.zeros_like(x)
    gradient[:-1] = -400 * a * x[:-1] - 2 * b
    gradient[1:] += 200 * a
    return float(100 * a @ a + b @ b), gradient


@given(rng=generators())
def test_the_bottom_of_a_bowl_is_found(rng: np.random.Generator) -> None:
    slopes, bottom = rng.uniform(0.1, 30, 12), rng.normal(0, 5, 12)

    def bowl(x: FloatArray) -> tuple[float, FloatArray]:
        return float(slopes @ (x - bottom) ** 2), 2 * slopes * (x - bottom)

    assert minimise(bowl, np.zeros(12), 300, 1e-14) == pytest.approx(bottom, abs=1e-3)


def test_a_crooked_valley_is_followed_to_its_end() -> None:
    calls = 0

    def counted(x: FloatArray) -> tuple[float, FloatArray]:
        nonlocal calls
        calls += 1
        return rosenbrock(x)

    assert minimise(counted, np.zeros(6), 300, 1e-14) == pytest.approx(np.ones(6), abs=1e-4)
    assert calls < 150


def test_it_stays_where_the_slope_is_zero() -> None:
    assert minimise(rosenbrock, np.ones(4), 50, 1e-9).tolist() == [1, 1, 1, 1]


def test_it_never_ends_higher_than_it_began(rng: np.random.Generator) -> None:
    start = rng.normal(0, 3, 8)
    values = [rosenbrock(minimise(rosenbrock, start, n, 0.0))[0] for n in range(12)]
    assert values[0] == rosenbrock(start)[0]
    assert values == sorted(values, reverse=True)


def test_a_gradient_that_lies_ends_the_search() -> None:
    def uphill(x: FloatArray) -> tuple[float, FloatArray]:
        return float(np.abs(x).sum()), -np.sign(x)

    assert minimise(uphill, np.array([1.0, 2.0]), 50, 1e-9).tolist() == [1, 2]
