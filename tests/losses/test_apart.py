"""Items of one kind push each other away: an object-space loss against differences."""

from __future__ import annotations

import numpy as np
import pytest

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.losses.pose import REACH, apart
from packwork.losses.term import PosedItems
from scenes import poses

KINDS = np.array([0, 1, 0, 2, 1, 0, 1])


def placed(centres: FloatArray, kinds: object = KINDS, radius: float = 2.0) -> PosedItems:
    count = len(centres)
    where = poses(centres[:, 0], centres[:, 1])
    return PosedItems(where, np.full(count, np.pi * radius**2), np.ones(count), np.asarray(kinds))


def test_derivative_by_the_places(rng: np.random.Generator) -> None:
    at = rng.uniform(0, 8, (7, 2))
    term = apart(placed(at))
    assert term.value > 0.05
    assert term.log_scale is None
    assert_gradient(lambda c: apart(placed(c)).value, np.column_stack([term.x, term.y]), at)


def test_only_near_items_of_one_kind_feel_each_other() -> None:
    reach = REACH * 4.0
    for away, kinds in [(0.99 * reach, [0, 1]), (1.01 * reach, [0, 0])]:
        term = apart(placed(np.array([[0.0, 0.0], [away, 0.0]]), kinds))
        assert (term.value, term.x.tolist()) == (0.0, [0.0, 0.0])
    near = apart(placed(np.array([[0.0, 0.0], [0.5 * reach, 0.0]]), [3, 3]))
    assert near.value == pytest.approx(0.25 / 2)
    assert near.x[0] > 0 > near.x[1]


def test_no_net_force(rng: np.random.Generator) -> None:
    term = apart(placed(rng.uniform(0, 8, (7, 2))))
    assert np.abs(term.x).max() > 0.01
    assert term.x.sum() == pytest.approx(0, abs=1e-12)
    assert term.y.sum() == pytest.approx(0, abs=1e-12)


def test_permuting_items_permutes_the_forces(rng: np.random.Generator) -> None:
    at, order = rng.uniform(0, 8, (7, 2)), rng.permutation(7)
    straight, turned = apart(placed(at)), apart(placed(at[order], KINDS[order]))
    assert turned.value == pytest.approx(straight.value)
    np.testing.assert_allclose(turned.x, straight.x[order], atol=1e-12)


def test_without_kinds_or_items_there_is_no_loss() -> None:
    where = poses([0.0, 0.1], [0.0, 0.0])
    assert apart(PosedItems(where, np.ones(2), np.ones(2))).value == 0
    assert apart(placed(np.zeros((0, 2)), np.zeros(0, dtype=np.int64))).value == 0


def test_items_in_one_point_are_no_trouble() -> None:
    term = apart(placed(np.zeros((2, 2)), [0, 0]))
    assert term.value == 0.5
    assert term.x.tolist() == [0.0, 0.0]
