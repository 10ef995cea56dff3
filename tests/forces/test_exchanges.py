"""Items change places where that lowers the forces' cost, and only where they may."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.arrays import FloatArray
from packwork.forces import exchanges
from packwork.forces.bonds import Alignment, Balance
from packwork.forces.exchanges import exchanged
from packwork.forces.field import Direction
from packwork.forces.forces import BondForce, FieldForce, Forces

SIDE, COUNT = 100.0, 40
DOWN = Direction(np.pi / 2)
SAME, EVEN = np.zeros(COUNT, dtype=np.int64), np.zeros(COUNT)


@pytest.fixture
def places(rng: np.random.Generator) -> FloatArray:
    return rng.uniform(0, SIDE, (COUNT, 2))


def _on_half(strength: float = 1.0) -> FloatArray:
    return np.where(np.arange(COUNT) % 2, strength, 0.0)


def _cost(forces: Forces, places: FloatArray, order: np.ndarray) -> float:
    points = np.empty_like(places)
    points[order] = places
    return forces.cost(points, np.ones(COUNT)).value


@pytest.mark.parametrize("bond", [Alignment(1), Balance(np.array([np.nan, 80.0]))])
def test_exchanges_lower_the_cost(bond: Alignment | Balance, places: FloatArray) -> None:
    forces = Forces([], [BondForce(bond, _on_half())], SAME, SIDE)
    order = exchanged(forces, places, np.ones(COUNT), EVEN, SAME)
    assert sorted(order) == list(range(COUNT))
    assert _cost(forces, places, order) < 0.5 * _cost(forces, places, np.arange(COUNT))


def test_those_that_fall_come_to_lie_lowest(places: FloatArray) -> None:
    forces = Forces([FieldForce(DOWN, _on_half())], [], SAME, SIDE)
    order = exchanged(forces, places, np.ones(COUNT), EVEN, SAME)
    falls = _on_half()[order] > 0
    # Exchanges that gain next to nothing are not made.
    slack = 2 * exchanges.PRICE * SIDE / 30.0 * 2
    assert places[falls, 1].min() > places[~falls, 1].max() - slack


def test_items_keep_to_their_group_and_their_size(places: FloatArray) -> None:
    forces = Forces([FieldForce(DOWN, _on_half(50.0))], [], SAME, SIDE)
    groups = np.repeat([0, 1, -1, 2], COUNT // 4)
    sizes = np.arange(COUNT) % 4 * 2.0
    order = exchanged(forces, places, np.ones(COUNT), sizes, groups)
    moved = order != np.arange(COUNT)
    assert not moved[groups < 0].any()
    np.testing.assert_array_equal(groups[order], groups)
    np.testing.assert_array_equal(sizes[order], sizes)


def test_copies_whose_size_is_the_places_have_nothing_to_exchange(places: FloatArray) -> None:
    forces = Forces([FieldForce(DOWN, np.linspace(0, 1, COUNT))], [], SAME, SIDE)
    order = exchanged(forces, places, np.ones(COUNT), EVEN, SAME, kinds=SAME)
    assert order.tolist() == list(range(COUNT))


def test_more_items_than_are_looked_at_together(
    places: FloatArray, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(exchanges, "AT_ONCE", 15)
    forces = Forces([FieldForce(DOWN, _on_half())], [], SAME, SIDE)
    order = exchanged(forces, places, np.ones(COUNT), EVEN, SAME)
    assert _cost(forces, places, order) < _cost(forces, places, np.arange(COUNT))
