"""Photos lean to both sides, in every stage that turns them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.compaction.objective import turn_ranges
from packwork.finish.options import FinishOptions
from packwork.scene.pose import LEAST, MOST, Poses, leanings, turn_sides
from packwork.solve.motion import Motion
from packwork.solve.options import SolveOptions


@pytest.mark.parametrize("count", [1, 2, 7, 200])
def test_as_many_lean_to_either_side_and_none_beyond_the_limit(count: int) -> None:
    leans = leanings(count, 0.3)
    assert abs(int((leans > 0).sum()) - int((leans < 0).sum())) <= 1
    assert (np.abs(leans) >= LEAST * 0.3).all()
    assert (np.abs(leans) <= MOST * 0.3).all()


def test_the_levels_keep_items_on_their_side() -> None:
    poses = Poses(np.zeros(3), np.zeros(3), np.array([0.1, -0.1, 0.0]), np.ones(3))
    options = SolveOptions(turn_limit=0.5, leans=(0.1, -0.1, 0.0))
    motion = Motion(poses, np.ones(3), 100.0, options)
    push = np.zeros((3, 5))
    push[:, 2] = [1.0, -1.0, 1.0]
    for _ in range(20):
        motion.follow(push, 1.0)
    assert motion.angle.tolist() == [0.1, -0.1, -0.5]


def test_the_finish_keeps_items_on_their_side_or_as_they_were() -> None:
    options = FinishOptions(turn_limit=0.5, leans=(0.1, -0.1, 0.1))
    angles = np.array([0.2, -0.2, -0.3])
    back, on = turn_ranges(angles, options)
    assert (angles + back).tolist() == pytest.approx([0.1, -0.5, -0.3])
    assert (angles + on).tolist() == pytest.approx([0.5, -0.1, 0.5])
    low, high = turn_sides(0.5, np.array(options.leans))
    assert low.tolist() == [0.1, -0.5, 0.1]
    assert high.tolist() == [0.5, -0.1, 0.5]


def test_photos_of_a_run_lean_to_both_sides_about_upright(tmp_path: Path) -> None:
    for k in range(8):
        Image.new("RGB", (30, 20) if k % 2 else (20, 30), "teal").save(tmp_path / f"{k}.png")
    layout = pw.photos("square", tmp_path, effort="draft", levels="50", canvas=100)
    degrees = np.degrees(layout.poses.angle)
    assert (degrees > 1).sum() == (degrees < -1).sum() == 4
    assert np.abs(degrees).max() <= 15.0001
    assert abs(degrees.mean()) < 8
