"""Area shares: an object-space loss against differences."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.losses.pose import area_shares
from packwork.losses.term import PosedItems
from scenes import poses


def test_derivative_by_the_log_of_each_scale(rng: np.random.Generator) -> None:
    nominal, areas = rng.uniform(0.5, 2.0, 6), rng.uniform(1, 3, 6)
    where = poses(np.zeros(6), np.zeros(6), 0.0, rng.uniform(0.5, 2.0, 6))

    def placed(log_scale: FloatArray) -> PosedItems:
        return PosedItems(dataclasses.replace(where, scale=np.exp(log_scale)), areas, nominal)

    at = np.log(where.scale)
    by_scale = area_shares(placed(at)).log_scale
    assert by_scale is not None
    assert_gradient(lambda log_scale: area_shares(placed(log_scale)).value, by_scale, at)


def test_one_common_factor_costs_nothing(rng: np.random.Generator) -> None:
    nominal = rng.uniform(0.5, 2.0, 6)
    where = poses(np.zeros(6), np.zeros(6), 0.0, 3 * nominal)
    assert area_shares(PosedItems(where, np.ones(6), nominal)).value == pytest.approx(0, abs=1e-12)
