"""Neighbours: triangulated where there is an area, in a row where there is none."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.geometry.outline import Outline
from packwork.scene.neighbours import NEAR, neighbour_pairs, side_by_side
from scenes import disc, placed, poses
from strategies import generators


@given(rng=generators(), count=st.integers(3, 40))
def test_everyone_has_two_neighbours_and_each_pair_stands_once(
    rng: np.random.Generator, count: int
) -> None:
    pairs = neighbour_pairs(*rng.uniform(size=(2, count)))
    assert (pairs[:, 0] < pairs[:, 1]).all()
    assert len(np.unique(pairs, axis=0)) == len(pairs)
    assert np.bincount(pairs.ravel(), minlength=count).min() >= 2
    assert len(pairs) <= 3 * count - 6 or count == 3


@given(rng=generators(), count=st.integers(2, 30))
def test_the_nearest_point_is_a_neighbour(rng: np.random.Generator, count: int) -> None:
    x, y = rng.uniform(size=(2, count))
    away = np.hypot(x[:, None] - x, y[:, None] - y) + np.diag(np.full(count, np.inf))
    pairs = {tuple(pair) for pair in neighbour_pairs(x, y).tolist()}
    for k, nearest in enumerate(np.argmin(away, axis=1).tolist()):
        assert (min(k, nearest), max(k, nearest)) in pairs


@pytest.mark.parametrize("count", [0, 1, 2, 5])
def test_points_in_a_row_are_neighbours_one_after_another(count: int) -> None:
    order = np.random.default_rng(0).permutation(count)
    pairs = neighbour_pairs(np.arange(count, dtype=float)[order], np.ones(count))
    assert len(pairs) == max(count - 1, 0)
    assert (np.abs(order[pairs[:, 0]] - order[pairs[:, 1]]) == 1).all()


def test_a_point_on_another_is_its_neighbour() -> None:
    x, y = np.array([0.0, 9, 0, 9, 9]), np.array([0.0, 0, 9, 9, 9])
    assert [3, 4] in neighbour_pairs(x, y).tolist()


@pytest.mark.parametrize(("gap", "are_beside"), [(0.9 * NEAR, True), (1.1 * NEAR, False)])
def test_side_by_side_is_below_half_a_radius(gap: float, are_beside: bool) -> None:
    outlines = [disc(corners=400)] * 3
    where = poses([0.0, 2 + gap, 50.0], [0.0, 0.0, 1.0])
    pairs = side_by_side(placed(outlines, where)).tolist()
    assert ([0, 1] in pairs) is are_beside
    assert [1, 2] not in pairs


def test_long_items_are_beside_each_other_whatever_their_middles_say() -> None:
    # Above and below the gap between two others, nearer by their middles than these.
    boxes = [(0, 0, 10, 2), (10.3, 0, 20, 2), (6, -2.3, 14, -0.3), (6, 2.3, 14, 4.3)]
    outlines = [
        Outline.from_rings([np.array([[a, b], [c, b], [c, d], [a, d]], dtype=float)])
        for a, b, c, d in boxes
    ]
    assert side_by_side(outlines).tolist() == [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3]]


def test_small_items_lie_beside_those_that_are_near_by_their_own_size() -> None:
    # Two large ones that touch, and a row of small ones at the second.
    outlines = [disc(corners=100)] * 9
    sizes = np.array([1.0, 1, 1, 1, 1, *[0.05] * 4])
    row = [0.0, 2.01, 4.02, 6.03, 8.04, *(9.1 + 0.11 * np.arange(4))]
    pairs = side_by_side(placed(outlines, poses(row, [0.0] * 9, scale=sizes))).tolist()
    assert pairs == [[k, k + 1] for k in range(8)]
