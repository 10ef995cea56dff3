"""Evenness where the windows slide over a coarser image."""

from __future__ import annotations

import numpy as np

from packwork.losses.evenness import COARSE_PX, evenness


def test_adjoint_is_the_derivative_at_reduced_resolution(rng: np.random.Generator) -> None:
    shape = (2 * COARSE_PX + 41, 2 * COARSE_PX + 1)
    density = np.where(rng.random(shape) < 0.2, 0.9, 0.0)
    container, direction = np.ones(shape), rng.normal(size=shape)
    step = 1e-5
    difference = (
        evenness(density + step * direction, container).value
        - evenness(density - step * direction, container).value
    ) / (2 * step)
    slope = float(np.vdot(evenness(density, container).adjoint, direction))
    np.testing.assert_allclose(slope, difference, rtol=1e-6)


def test_one_large_gap_costs_more_than_many_small_ones() -> None:
    container = np.ones((120, 120))
    large, small = np.ones((120, 120)), np.ones((120, 120))
    large[40:64, 40:64] = 0
    for row in range(8):
        for column in range(8):
            small[15 * row : 15 * row + 3, 15 * column : 15 * column + 3] = 0
    assert large.sum() == small.sum()
    assert evenness(large, container).value > 5 * evenness(small, container).value
