"""First scales: areas in the shares asked for, or compact items first."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.start.angles_and_sizes import nominal_scales, shared_scales, yielding_scales
from strategies import generators


@given(rng=generators(), n=st.integers(1, 20), total=st.floats(1, 1e6))
def test_nominal_areas_are_in_the_shares_of_the_weights(
    rng: np.random.Generator, n: int, total: float
) -> None:
    areas, weights = rng.uniform(0.1, 10, n), rng.uniform(0.1, 10, n)
    taken = areas * nominal_scales(areas, weights, total) ** 2
    np.testing.assert_allclose(taken, total * weights / weights.sum(), rtol=1e-12)


@given(rng=generators(), n=st.integers(1, 20), total=st.floats(1, 1e6))
def test_true_areas_are_shared_out_whatever_stands_for_the_items(
    rng: np.random.Generator, n: int, total: float
) -> None:
    areas, seen, weights = rng.uniform(0.1, 10, (3, n))
    scales = shared_scales(areas, seen, weights, total)
    shares = areas * scales**2 / np.sum(areas * scales**2)
    np.testing.assert_allclose(shares, weights / weights.sum(), rtol=1e-12)
    assert np.sum(seen * scales**2) == pytest.approx(total)
    plain = nominal_scales(areas, weights, total)
    np.testing.assert_array_equal(shared_scales(areas, areas, weights, total), plain)


@given(rng=generators(), n=st.integers(1, 20), ratio=st.floats(1, 5), total=st.floats(1, 100))
def test_yielding_scales_stay_in_their_range(
    rng: np.random.Generator, n: int, ratio: float, total: float
) -> None:
    areas = rng.uniform(0.1, 1, n)
    hulls = areas * rng.uniform(1, 5, n)
    nominal = rng.uniform(0.5, 2, n)
    scales = yielding_scales(areas, hulls, nominal, ratio, total) / nominal
    assert scales.min() >= 1 / ratio - 1e-12
    assert scales.max() <= ratio + 1e-12


def test_straggly_items_begin_smaller_and_the_total_is_met() -> None:
    areas, hulls, nominal = np.array([4.0, 1.0]), np.array([4.0, 3.0]), np.ones(2)
    scales = yielding_scales(areas, hulls, nominal, 100.0, 2.0)
    assert scales[1] < scales[0]
    assert np.sum(areas * scales**2) == pytest.approx(2.0)
