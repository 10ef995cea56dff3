"""Adam: steps of stated length, and stillness where there is no force."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.solve.motion import STILLNESS, Adam


def test_first_step_is_as_long_as_the_rate_whatever_the_gradient() -> None:
    for size in (1e-3, 1.0, 1e6):
        step = Adam((1, 2)).step(size * np.array([[0.6, -0.8]]), 0.5)
        np.testing.assert_allclose(step * (1 + STILLNESS), [[-0.3, 0.4]])


def test_the_moments_are_those_of_the_paper() -> None:
    """Kingma and Ba 2015, algorithm 1, for one component and equal decays."""
    gradients, first, second = [1.0, -0.4, 0.7], 0.9, 0.8
    adam = Adam((1, 1), (first, second))
    mean = square = 0.0
    for t, g in enumerate(gradients, start=1):
        mean = first * mean + (1 - first) * g
        square = second * square + (1 - second) * g * g
        expected = -0.1 * (mean / (1 - first**t)) / np.sqrt(square / (1 - second**t))
        met = adam.step(np.array([[g]]), 0.1)[0, 0] * (1 + STILLNESS)
        assert met == pytest.approx(expected)


def test_direction_does_not_depend_on_how_the_canvas_is_turned(rng: np.random.Generator) -> None:
    turn = np.array([[np.cos(0.7), np.sin(0.7)], [-np.sin(0.7), np.cos(0.7)]])
    straight, turned = Adam((3, 2)), Adam((3, 2))
    for _ in range(4):
        gradient = rng.normal(size=(3, 2))
        np.testing.assert_allclose(
            turned.step(gradient @ turn, 1.0), straight.step(gradient, 1.0) @ turn, atol=1e-12
        )


def test_noise_beside_real_forces_does_not_dance(rng: np.random.Generator) -> None:
    adam = Adam((3, 2))
    for _ in range(20):
        gradient = rng.normal(size=(3, 2))
        gradient[1] *= 1e-7
        gradient[2] = 0.0
        step = np.linalg.norm(adam.step(gradient, 1.0), axis=1)
        assert step[1] < 1e-3
        assert step[2] == 0.0


def test_no_force_at_all_is_no_step() -> None:
    assert not Adam((2, 2)).step(np.zeros((2, 2)), 1.0).any()


def test_forgetting_ends_the_drift_of_those_items_only() -> None:
    adam = Adam((2, 1))
    for _ in range(5):
        adam.step(np.ones((2, 1)), 1.0)
    adam.forget([0])
    step = adam.step(np.zeros((2, 1)), 1.0)
    assert step[0, 0] == 0.0
    assert step[1, 0] < 0.0
