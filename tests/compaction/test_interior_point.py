from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linprog

from packwork.arrays import FloatArray
from packwork.compaction.kernels import interior_point
from packwork.compaction.kernels.interior_point import Rows


def maximise(
    gain: FloatArray, rows: Rows, low: FloatArray, high: FloatArray, accuracy: float
) -> FloatArray:
    z = interior_point.maximise(rows, gain.ravel(), low.ravel(), high.ravel(), accuracy)
    return np.asarray(z).reshape(gain.shape)


def random_rows(rng: np.random.Generator, items: int, count: int) -> Rows:
    """Rows over one item or two, some of them touching."""
    first = rng.integers(items, size=count)
    second = np.where(rng.random(count) < 0.3, -1, rng.integers(items, size=count))
    second = np.where(second == first, -1, second)
    coefficients = rng.normal(size=(count, 8))
    coefficients[second < 0, 4:] = 0.0
    limits = np.maximum(rng.uniform(-0.3, 1.0, count), 0.0)
    return Rows(first, second, coefficients, limits)


def dense(rows: Rows, items: int) -> FloatArray:
    """The same rows as one matrix over all unknowns."""
    matrix = np.zeros((len(rows.first), 4 * items))
    for k, (i, j) in enumerate(zip(rows.first, rows.second, strict=True)):
        matrix[k, 4 * i : 4 * i + 4] += rows.coefficients[k, :4]
        if j >= 0:
            matrix[k, 4 * j : 4 * j + 4] += rows.coefficients[k, 4:]
    return matrix


@pytest.mark.parametrize("seed", range(12))
def test_the_value_is_that_of_a_general_solver(seed: int) -> None:
    rng = np.random.default_rng(seed)
    items = int(rng.integers(1, 12))
    rows = random_rows(rng, items, int(rng.integers(0, 60)))
    gain = rng.normal(size=(items, 4)) * 10.0 ** rng.uniform(-6, 6)
    low, high = -rng.uniform(0, 1, (items, 4)), rng.uniform(0, 1, (items, 4))
    z = maximise(gain, rows, low, high, 1e-8)
    matrix = dense(rows, items)
    bounds = np.column_stack([low.ravel(), high.ravel()])
    twin = linprog(-gain.ravel(), A_ub=matrix, b_ub=rows.limits, bounds=bounds)
    assert (gain * z).sum() == pytest.approx(-twin.fun, rel=1e-4)
    assert (matrix @ z.ravel() <= rows.limits + 1e-3).all()
    assert (z >= low - 1e-5).all()
    assert (z <= high + 1e-5).all()


def test_the_order_of_the_items_does_not_matter() -> None:
    rng = np.random.default_rng(5)
    rows, gain = random_rows(rng, 8, 40), rng.normal(size=(8, 4))
    order = rng.permutation(8)
    place = np.argsort(order)
    moved = Rows(place[rows.first], np.where(rows.second < 0, -1, place[rows.second]), *rows[2:])
    bound = np.ones((8, 4))
    one = maximise(gain, rows, -bound, bound, 1e-9)
    other = maximise(gain[order], moved, -bound, bound, 1e-9)
    assert (gain * one).sum() == pytest.approx((gain[order] * other).sum(), rel=1e-6)


def test_what_is_held_does_not_move() -> None:
    rows = Rows(np.zeros(0, int), np.zeros(0, int), np.zeros((0, 8)), np.zeros(0))
    bound = np.array([[1.0, 1.0, 0.0, 1.0]])
    z = maximise(np.ones((1, 4)), rows, -bound, bound, 1e-6)
    assert abs(z[0, 2]) < 1e-5
    assert z[0, [0, 1, 3]] == pytest.approx(1.0, abs=1e-4)
