"""Exchanges against a slow twin, and what they must keep."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.arrays import FloatArray, IntArray
from packwork.assignment import _kernels
from packwork.assignment._kernels import Blend, DistancePrices
from packwork.assignment.quadratic import Assignment, cheapest, improved, neighbour_flow
from strategies import generators

COUNT = 14


def price(problem: Assignment, at: IntArray) -> float:
    """Slow twin: all prices summed one by one."""
    total = 0.0
    for row, column in enumerate(at):
        total += float(((problem.rows[row] - problem.columns[column]) ** 2).sum())
        total += problem.staying if row != column else 0.0
        own = problem.flow.starts[row : row + 2]
        for k in range(*own) if len(own) else ():
            there = at[problem.flow.partners[k]]
            kinds, points = problem.distance.kinds, problem.distance.points
            away = problem.distance.between[kinds[column], kinds[there]]
            away += np.linalg.norm(points[column] - points[there])
            total += float(problem.flow.weights[k] * away) / 2
    blend = problem.blend
    for mixture, wanted in zip(problem.mixtures(at), blend.wanted, strict=True):
        seen = blend.before @ mixture
        seen = seen if blend.exponent == 1.0 else np.maximum(seen, 0.0) ** blend.exponent
        missed = float(np.linalg.norm(blend.after @ seen - wanted))
        total += missed**2 if blend.exponent == 1.0 else missed
    return total


def made_problem(rng: np.random.Generator, exponent: float = 1.0) -> Assignment:
    """Prices of every kind by chance."""
    pairs = np.array([(i, j) for i in range(COUNT) for j in range(i) if rng.random() < 0.3])
    pairs = pairs.reshape(-1, 2)
    between: FloatArray = rng.standard_normal((3, 3))
    starts = np.arange(COUNT + 1) * 2
    blend = Blend(
        starts, rng.integers(0, 5, 2 * COUNT), rng.random((2 * COUNT, 2)),
        rng.random((COUNT, 2, 3)), rng.random((5, 3)), rng.random((3, 3)), rng.random((3, 3)),
        exponent,
    )  # fmt: skip
    return Assignment(
        np.zeros(COUNT, np.int64),
        rows=rng.random((COUNT, 2)),
        columns=rng.random((COUNT, 2)),
        staying=0.3,
        flow=neighbour_flow(COUNT, pairs, rng.random(len(pairs))),
        distance=DistancePrices(
            rng.integers(0, 3, COUNT), between + between.T, rng.random((COUNT, 2))
        ),
        blend=blend,
    )  # fmt: skip


@pytest.mark.parametrize("heat", [0.0, 0.7])
@pytest.mark.parametrize("exponent", [1.0, 1 / 3])
def test_an_exchange_gains_what_the_twin_says(heat: float, exponent: float) -> None:
    rng = np.random.default_rng(3)
    problem = made_problem(rng, exponent)
    at = rng.permutation(COUNT)
    before, mixed = price(problem, at), problem.mixtures(at)
    made, gained = _kernels.exchange(
        at, problem.random_pairs(60, rng), rng.random(60), heat, *problem[1:], mixed
    )
    assert made > 0
    assert sorted(at.tolist()) == list(range(COUNT))
    assert before - price(problem, at) == pytest.approx(gained, abs=1e-9)
    np.testing.assert_allclose(mixed, problem.mixtures(at), atol=1e-9)
    assert heat > 0.0 or gained > 0


@given(rng=generators(), count=st.integers(1, 40))
def test_rows_keep_to_their_group_and_their_size(rng: np.random.Generator, count: int) -> None:
    groups, sizes = rng.integers(-1, 3, count), rng.uniform(0, 3, count)
    wishes = rng.random((2, count, 1))
    problem = Assignment(groups, sizes, rows=wishes[0], columns=wishes[1])
    at = improved(problem, rng, [1.0, 0.0], 20)
    assert sorted(at) == list(range(count))
    np.testing.assert_array_equal(groups[at], groups)
    assert (at[groups < 0] == np.flatnonzero(groups < 0)).all()
    assert np.abs(sizes[at] - sizes).max() <= 1


def test_descent_ends_where_no_exchange_gains() -> None:
    rng = np.random.default_rng(1)
    problem = made_problem(rng)
    at = improved(problem, rng, [0.0] * 50, 50)
    least = price(problem, at)
    for first in range(COUNT):
        for second in range(first):
            other = at.copy()
            other[[first, second]] = at[[second, first]]
            assert price(problem, other) > least - 1e-9


def test_prices_of_single_rows_are_best_by_linear_assignment() -> None:
    rng = np.random.default_rng(2)
    wishes = rng.random((2, COUNT, 3))
    problem = Assignment(np.zeros(COUNT, np.int64), rows=wishes[0], columns=wishes[1])
    best = cheapest(((wishes[0][:, None] - wishes[1]) ** 2).sum(axis=2))
    assert price(problem, best) <= price(problem, improved(problem, rng, [0.0] * 9, 50)) + 1e-12
    assert improved(problem, rng, [0.0] * 9, 50, best).tolist() == best.tolist()
