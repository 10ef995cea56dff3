"""Steps in units of the canvas, and a fresh start for items moved by force."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from packwork.solve.motion import Motion
from packwork.solve.options import SolveOptions
from scenes import poses

Options = Callable[..., SolveOptions]
PUSH = np.array([[1.0, 0.0, 1.0, 1.0], [-1.0, 0.0, -1.0, -1.0]])


def pair(side: float, options: SolveOptions) -> Motion:
    start = poses([0.4 * side, 0.6 * side], 0.5 * side, 0.0, 0.1 * side)
    return Motion(start, start.scale, side, options)


@pytest.mark.parametrize("side", [1.0, 600.0])
def test_steps_are_shares_of_the_canvas(side: float, quick: Options) -> None:
    motion = pair(side, quick(position_rate=0.01, turn_rate=0.1, size_rate=0.02))
    motion.follow(PUSH, 0.5)
    # Adam's floor shortens a first step by a percent or two.
    end = motion.poses
    np.testing.assert_allclose((end.x / side - [0.4, 0.6]) / 0.005, [-1, 1], rtol=0.05)
    np.testing.assert_allclose(end.angle / 0.05, [-1, 1], rtol=0.05)
    np.testing.assert_allclose(np.log(end.scale / (0.1 * side)) / 0.01, [-1, 1], rtol=0.05)


def test_poses_given_out_do_not_change_later(quick: Options) -> None:
    motion = pair(100.0, quick())
    before = motion.poses
    motion.follow(PUSH, 1.0)
    assert before.x.tolist() == [40.0, 60.0]


def test_an_item_moved_by_force_does_not_drift_on(quick: Options) -> None:
    motion = pair(100.0, quick(sizes="free"))
    for _ in range(5):
        motion.follow(PUSH, 1.0)
    moved = motion.poses
    moved.x[0] = 10.0
    motion.replace(moved, [0])
    motion.follow(np.zeros((2, 4)), 1.0)
    end = motion.poses
    assert (end.x[0], end.angle[0]) == (10.0, moved.angle[0])
    assert end.scale[0] == pytest.approx(moved.scale[0], rel=1e-12)
    assert end.x[1] > moved.x[1]
