"""Poses under optimisation, and Adam."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from packwork.scene.pose import Limits
from packwork.solve.motion import STILLNESS, Adam, Motion
from packwork.solve.options import SolveOptions
from scenes import poses

Options = Callable[..., SolveOptions]


PUSH = np.array([[1.0, 0.0, 1.0, 1.0, 1.0], [-1.0, 0.0, -1.0, -1.0, -1.0]])


def pair(side: float, options: SolveOptions) -> Motion:
    start = poses([0.4 * side, 0.6 * side], 0.5 * side, 0.0, 0.1 * side)
    return Motion(start, start.scale, side, options)


@pytest.mark.parametrize("side", [1.0, 600.0])
def test_steps_are_shares_of_the_canvas(side: float, quick: Options) -> None:
    rates = {"position_rate": 0.01, "turn_rate": 0.1, "size_rate": 0.02, "stretch_rate": 0.04}
    motion = pair(side, quick(**rates, stretch=2))
    motion.follow(PUSH, 0.5)
    # Adam's floor shortens a first step by a percent or two.
    end = motion.poses
    np.testing.assert_allclose((end.x / side - [0.4, 0.6]) / 0.005, [-1, 1], rtol=0.05)
    np.testing.assert_allclose(end.angle / 0.05, [-1, 1], rtol=0.05)
    np.testing.assert_allclose(np.log(end.scale / (0.1 * side)) / 0.01, [-1, 1], rtol=0.05)
    np.testing.assert_allclose(np.log(end.stretch) / 0.02, [-1, 1], rtol=0.05)


def test_stretches_end_at_their_bounds(quick: Options) -> None:
    motion = pair(100.0, quick(stretch=1.2, stretch_rate=0.05))
    for _ in range(9):
        motion.follow(PUSH, 1.0)
    np.testing.assert_allclose(motion.poses.stretch, [1 / 1.2, 1.2], rtol=1e-12)


def test_nothing_is_stretched_unless_asked(quick: Options) -> None:
    motion = pair(100.0, quick())
    motion.follow(PUSH, 1.0)
    assert motion.poses.stretch.tolist() == [1.0, 1.0]


def test_poses_given_out_do_not_change_later(quick: Options) -> None:
    motion = pair(100.0, quick())
    before = motion.poses
    motion.follow(PUSH, 1.0)
    assert before.x.tolist() == [40.0, 60.0]


def test_an_item_moved_by_force_does_not_drift_on(quick: Options) -> None:
    motion = pair(100.0, quick(sizes="free", stretch=9))
    for _ in range(5):
        motion.follow(PUSH, 1.0)
    moved = motion.poses
    moved.x[0] = 10.0
    motion.replace(moved, [0])
    motion.follow(np.zeros((2, 5)), 1.0)
    end = motion.poses
    assert (end.x[0], end.angle[0]) == (10.0, moved.angle[0])
    assert end.scale[0] == pytest.approx(moved.scale[0], rel=1e-12)
    assert end.stretch[0] == pytest.approx(moved.stretch[0], rel=1e-12)
    assert end.x[1] > moved.x[1]


def held_pair(options: SolveOptions, **limits: object) -> Motion:
    start = poses([40.0, 60.0], 50.0, 0.2, 10.0)
    bounds = {"smallest": np.full(2, 5.0), "largest": np.full(2, 20.0)}
    given = replace(Limits.free(2), **(bounds | limits))
    return Motion(start, start.scale, 100.0, options, given)


@pytest.mark.parametrize("sizes", ["free", "shared", "fixed"])
def test_what_is_held_does_not_move_by_a_bit(sizes: str, quick: Options) -> None:
    first = np.array([40.0, np.nan])
    motion = held_pair(
        quick(sizes=sizes, stretch=2), x=first, y=np.array([50.0, np.nan]),
        angle=np.array([0.2, np.nan]), smallest=np.array([10.0, 5.0]),
        largest=np.array([10.0, 20.0]), rigid=np.array([True, False]),
    )  # fmt: skip
    for _ in range(20):
        motion.follow(2 * PUSH, 1.0)
    end = motion.poses
    assert (end.x[0], end.y[0], end.angle[0], end.stretch[0]) == (40.0, 50.0, 0.2, 1.0)
    assert end.scale[0] == pytest.approx(10.0, rel=1e-14)
    assert end.x[1] != 60.0
    assert end.angle[1] != 0.2
    assert (end.scale[1] != pytest.approx(10.0, rel=1e-6)) is (sizes != "fixed")


def test_only_what_is_given_is_held(quick: Options) -> None:
    motion = held_pair(quick(), x=np.array([40.0, np.nan]))
    motion.follow(PUSH + np.array([0.0, 1.0, 0.0, 0.0, 0.0]), 1.0)
    end = motion.poses
    assert end.x[0] == 40.0
    assert end.y[0] != 50.0
    assert end.angle[0] != 0.2
    assert end.scale[0] != 10.0


def test_each_item_has_bounds_of_its_own(quick: Options) -> None:
    motion = held_pair(
        quick(size_rate=0.2, turn_rate=0.3), turn_limit=np.array([0.4, np.inf]),
        smallest=np.array([9.0, 5.0]), largest=np.array([11.0, 12.0]),
    )  # fmt: skip
    for _ in range(30):
        motion.follow(np.abs(PUSH), 1.0)
    np.testing.assert_allclose(motion.poses.scale, [9.0, 5.0], rtol=1e-12)
    assert motion.poses.angle[0] == -0.4
    assert motion.poses.angle[1] < -2
    for _ in range(60):
        motion.follow(-np.abs(PUSH), 1.0)
    np.testing.assert_allclose(motion.poses.scale, [11.0, 12.0], rtol=1e-12)
    assert motion.poses.angle[0] == 0.4


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
