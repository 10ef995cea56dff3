"""Tiles of a mosaic: bounds on repeats, distances, prices beside the optimum."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from packwork.assignment.tiles import choose_tiles


def cells_of(side: int) -> np.ndarray:
    return np.column_stack([one.ravel() for one in np.indices((side, side))])


def chosen(prices: np.ndarray, side: int, repeats: int, apart: int) -> np.ndarray:
    cells = cells_of(side)
    rng = np.random.default_rng(1)
    return choose_tiles(prices, cells, np.zeros(len(cells)), repeats, apart, rng)


def too_near(found: np.ndarray, side: int, apart: int) -> int:
    cells = cells_of(side)
    away = np.abs(cells[:, None] - cells[None]).max(axis=2)
    same = found[:, None] == found[None]
    return int((same & (away <= apart)).sum() - len(cells)) // 2


@pytest.mark.parametrize("repeats", [1, 2, 5])
def test_no_picture_is_taken_more_often_than_it_may(repeats: int) -> None:
    prices = np.random.default_rng(repeats).random((100, 100))
    # One that suits everywhere.
    prices[:, 7] = 0
    counts = Counter(chosen(prices, 10, repeats, 0).tolist())
    assert counts[7] == repeats
    assert max(counts.values()) <= repeats


def test_repeats_are_kept_apart() -> None:
    prices = np.random.default_rng(0).random((144, 60))
    prices[:, :5] /= 100
    assert too_near(chosen(prices, 12, 9, 2), 12, 2) == 0
    assert too_near(chosen(prices, 12, 9, 0), 12, 2) > 0


def test_where_there_are_too_few_all_cells_are_filled() -> None:
    found = chosen(np.random.default_rng(0).random((25, 3)), 5, 9, 3)
    assert set(found.tolist()) == {0, 1, 2}


def test_prices_are_near_the_least_that_there_are() -> None:
    prices = np.random.default_rng(3).random((100, 130)) ** 2
    rows, columns = linear_sum_assignment(prices)
    least = prices[rows, columns].sum()
    found = prices[np.arange(100), chosen(prices, 10, 1, 0)].sum()
    by_chance = prices.mean() * 100
    assert found - least < 0.02 * (by_chance - least)
