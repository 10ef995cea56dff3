"""The pull that items outside the container feel, on the canvas and off it."""

from __future__ import annotations

import numpy as np
import pytest

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.losses.pose import Recall

PX_PER_CU = 0.5
CONTAINER = np.zeros((9, 11))
CONTAINER[3:6, 4:8] = 1
OFF_CANVAS = np.array([[-9.3, 8.7], [31.2, 6.9], [10.6, -5.1], [9.1, 40.3], [-3.7, -6.2]])
"""Canvas units; beside each side and beyond a corner."""
ON_CANVAS = np.array([[1.1, 1.3], [20.7, 9.1], [3.3, 16.9], [18.9, 2.7]])
HOME = np.array([[9.3, 7.7], [14.9, 11.1]])


def _gradient(recall: Recall, centres: FloatArray, areas: FloatArray) -> FloatArray:
    term = recall(centres[:, 0], centres[:, 1], areas)
    return np.column_stack([term.x, term.y])


@pytest.mark.parametrize("centres", [OFF_CANVAS, ON_CANVAS], ids=["off canvas", "on canvas"])
def test_gradient(centres: FloatArray, rng: np.random.Generator) -> None:
    recall, areas = Recall(CONTAINER, PX_PER_CU), rng.uniform(1, 5, len(centres))
    assert_gradient(
        lambda c: recall(c[:, 0], c[:, 1], areas).value, _gradient(recall, centres, areas), centres
    )


def test_items_at_home_feel_nothing() -> None:
    term = Recall(CONTAINER, PX_PER_CU)(HOME[:, 0], HOME[:, 1], np.ones(2))
    assert term.value == 0
    assert not term.x.any()
    assert not term.y.any()


def test_every_pull_leads_home() -> None:
    recall, lost = Recall(CONTAINER, PX_PER_CU), np.concatenate([OFF_CANVAS, ON_CANVAS])
    for _ in range(200):
        lost = lost - 0.5 * _gradient(recall, lost, np.ones(len(lost)))
    assert recall(lost[:, 0], lost[:, 1], np.ones(len(lost))).value < 1.5 * len(lost)


def test_value_is_the_distance_weighted_by_area() -> None:
    recall = Recall(CONTAINER, PX_PER_CU)
    term = recall(np.array([-20.0]), np.array([9.0]), np.array([3.0]))
    assert term.value == pytest.approx(3 * (9.0 + 20.0))
    assert (term.x[0], term.y[0]) == (-3.0, 0.0)


def test_resolution_does_not_change_the_pull(rng: np.random.Generator) -> None:
    areas = rng.uniform(1, 5, len(OFF_CANVAS))
    coarse = _gradient(Recall(CONTAINER, PX_PER_CU), OFF_CANVAS, areas)
    finer = Recall(np.kron(CONTAINER, np.ones((4, 4))), 4 * PX_PER_CU)
    np.testing.assert_allclose(_gradient(finer, OFF_CANVAS, areas), coarse, atol=0.6)
    assert finer(OFF_CANVAS[:, 0], OFF_CANVAS[:, 1], areas).value == pytest.approx(
        Recall(CONTAINER, PX_PER_CU)(OFF_CANVAS[:, 0], OFF_CANVAS[:, 1], areas).value, rel=0.15
    )


def test_a_container_thinner_than_a_pixel_still_calls() -> None:
    thin = np.zeros((9, 9))
    thin[:, 6] = 0.2
    term = Recall(thin, 1.0)(np.array([1.5, 6.5]), np.array([4.5, 4.5]), np.ones(2))
    assert term.x.tolist() == [-1.0, 0.0]
    assert term.value == 5.0
