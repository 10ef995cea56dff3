"""The start of a fit: cubics of all arcs against plain least squares, cuts against search."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.arrays import FloatArray
from packwork.fit.fitted import FEWEST, shared_curves
from packwork.fit.knots import arc_fits, best_chain, closed_path, resampled
from strategies import generators


def plain_fit(samples: FloatArray) -> tuple[float, FloatArray]:
    """Cost per length and handles of the cubic nearest to a polyline of equal edges."""
    fine = np.arange(64 * (len(samples) - 1) + 1) / 64
    z = np.interp(fine, np.arange(len(samples)), samples.real) + 1j * np.interp(
        fine, np.arange(len(samples)), samples.imag
    )
    t = fine / fine[-1]
    weight = np.sqrt(np.where((t == 0) | (t == 1), 0.5, 1.0) / (len(t) - 1))
    held = z - (1 - t) ** 3 * z[0] - t**3 * z[-1]
    basis = np.column_stack([3 * (1 - t) ** 2 * t, 3 * (1 - t) * t * t])
    handles, *_ = np.linalg.lstsq(weight[:, None] * basis, weight * held, rcond=None)
    return float(np.sum(np.abs(weight * (held - basis @ handles)) ** 2)), handles


@pytest.mark.parametrize(("i", "j"), [(0, 1), (2, 5), (6, 1), (3, 2), (4, 4)])
def test_every_arc_has_its_least_squares_cubic(i: int, j: int, rng: np.random.Generator) -> None:
    stride, sites = 6, 8
    n = stride * sites
    ring = rng.normal(size=(9, 2)) + 20
    samples = resampled(ring, n)
    fits = arc_fits(samples, stride)
    count = ((j - i - 1) % sites + 1) * stride
    along = samples[(i * stride + np.arange(count + 1)) % n]
    cost, handles = plain_fit(along)
    assert fits.cost[i, j] == pytest.approx(cost * count / n, rel=1e-2, abs=1e-9)
    assert fits.first[i, j] == pytest.approx(handles[0], abs=2e-3)
    assert fits.second[i, j] == pytest.approx(handles[1], abs=2e-3)


@given(rng=generators(), arcs=st.integers(2, 4))
def test_the_path_is_the_cheapest_there_is(rng: np.random.Generator, arcs: int) -> None:
    m = 7
    cost = rng.uniform(size=(m, m))

    def total(cuts: tuple[int, ...]) -> float:
        return float(sum(cost[a, b] for a, b in zip(cuts, (*cuts[1:], cuts[0]), strict=True)))

    first = int(rng.integers(m))
    others = [(first + k) % m for k in range(1, m)]
    best = min(total((first, *more)) for more in combinations(others, arcs - 1))
    found = closed_path(cost, arcs, first)
    assert found[0] == first
    assert total(tuple(found.tolist())) == pytest.approx(best)


def test_a_start_far_away_is_the_same_start(rng: np.random.Generator) -> None:
    turns = 2 * np.pi * np.arange(40) / 40
    ring = rng.uniform(3, 5, (40, 1)) * np.column_stack([np.cos(turns), np.sin(turns)])
    away = np.array([1e6, -3e6])
    assert best_chain(ring + away, 6) - away == pytest.approx(best_chain(ring, 6), abs=1e-3)


@given(
    lengths=st.lists(st.floats(1e-3, 1e3), min_size=1, max_size=9), curves=st.integers(FEWEST, 40)
)
def test_curves_are_shared_out_to_the_last(lengths: list[float], curves: int) -> None:
    triangle = np.array([[0, 0], [1, 0], [0, 1.0]])
    shares = shared_curves([length * triangle for length in lengths], curves)
    assert shares.sum() == curves
    served = shares > 0
    assert shares[served].min() >= FEWEST
    assert served.sum() == min(len(lengths), curves // FEWEST)
    if not served.all():
        assert min(np.array(lengths)[served]) >= max(np.array(lengths)[~served])
