"""Evenness where the windows slide over a coarser image."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.losses.image import MOST_BLOCKS, Windows, evenness


def test_adjoint_is_the_derivative_at_reduced_resolution(rng: np.random.Generator) -> None:
    shape = (2 * MOST_BLOCKS + 41, 2 * MOST_BLOCKS + 1)
    density = np.where(rng.random(shape) < 0.2, 0.9, 0.0)
    container, direction = np.ones(shape), rng.normal(size=shape)
    step = 1e-5
    difference = (
        evenness(density + step * direction, container).value
        - evenness(density - step * direction, container).value
    ) / (2 * step)
    slope = float(np.vdot(evenness(density, container).adjoint, direction))
    np.testing.assert_allclose(slope, difference, rtol=1e-6)


@pytest.mark.parametrize("items", [1, 12, 100, 5_000])
def test_windows_are_sized_for_the_items(items: int) -> None:
    """What a gap costs depends on its size for the items, not for the canvas."""
    side, pitch = 300, 300 / np.sqrt(items)
    container = np.ones((side, side))
    windows = Windows(container, items)
    prices = []
    for share in (0.25, 1.0):
        gap = np.zeros((side, side))
        reach = max(1, round(share * pitch / 2))
        gap[150 - reach : 150 + reach, 150 - reach : 150 + reach] = 1
        prices.append(windows.value(windows.blocks(gap)) / gap.sum())
    assert prices[1] > 4 * prices[0]


def test_a_gap_at_the_wall_costs_like_one_between_items() -> None:
    container = np.zeros((120, 120))
    container[:, 60:] = 1
    at_wall, inside = container.copy(), container.copy()
    at_wall[50:58, 60:68] = 0
    inside[50:58, 86:94] = 0
    ratio = evenness(at_wall, container).value / evenness(inside, container).value
    assert 0.7 < ratio < 3


def test_one_large_gap_costs_more_than_many_small_ones() -> None:
    container = np.ones((120, 120))
    large, small = np.ones((120, 120)), np.ones((120, 120))
    large[40:64, 40:64] = 0
    for row in range(8):
        for column in range(8):
            small[15 * row : 15 * row + 3, 15 * column : 15 * column + 3] = 0
    assert large.sum() == small.sum()
    assert evenness(large, container).value > 5 * evenness(small, container).value
