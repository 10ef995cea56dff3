"""Items handed round among parts: means alike, within groups and sizes."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.assignment.orders import balanced_order, parts_of
from packwork.geometry.outline import Outline

PARTS = np.repeat([0, 1, 2], [20, 10, 30])
FREE = np.zeros(60, dtype=int)
RNG = np.random.default_rng(0)


def spread(values: np.ndarray, order: np.ndarray) -> float:
    return float(np.ptp(np.bincount(PARTS, weights=values[order]) / np.bincount(PARTS)))


@pytest.fixture
def values(rng: np.random.Generator) -> np.ndarray:
    return rng.uniform(0.3, 1.0, 60) + 0.2 * PARTS


def test_means_come_together_and_every_item_stays(values: np.ndarray) -> None:
    order = balanced_order(values, PARTS, FREE, np.zeros(60), RNG)
    assert spread(values, np.arange(60)) > 0.3
    assert spread(values, order) < 0.01
    assert sorted(order) == list(range(60))


def test_items_stay_where_they_are_if_they_may_not_move(values: np.ndarray) -> None:
    groups = np.where(np.arange(60) % 3 == 0, -1, np.arange(60) % 2)
    order = balanced_order(values, PARTS, groups, np.zeros(60), RNG)
    held = groups < 0
    np.testing.assert_array_equal(order[held], np.flatnonzero(held))
    np.testing.assert_array_equal(groups[order], groups)
    assert spread(values, order) < spread(values, np.arange(60))


def test_only_items_of_about_one_size_change_places(
    values: np.ndarray, rng: np.random.Generator
) -> None:
    sizes = rng.uniform(0, 5, 60)
    first = balanced_order(values, PARTS, FREE, sizes, RNG)
    assert np.any(first != np.arange(60))
    alone = balanced_order(values, PARTS, FREE, 2.0 * np.arange(60), RNG)
    np.testing.assert_array_equal(alone, np.arange(60))


def test_parts_that_no_item_is_in_do_not_matter() -> None:
    order = balanced_order(
        np.array([1.0, 1, 0, 0]), np.array([0, 0, 4, 4]), FREE[:4], np.zeros(4), RNG
    )
    assert sorted(order[:2] < 2) == [False, True]


def test_parts_are_the_nearest_ones() -> None:
    region = shapely.union_all([shapely.box(0, 0, 1, 1), shapely.box(4, 0, 5, 1)])
    found = parts_of(Outline.from_region(region), np.array([0.5, 1.9, 4.5, 9]), np.zeros(4))
    assert found[0] == found[1] != found[2] == found[3]
