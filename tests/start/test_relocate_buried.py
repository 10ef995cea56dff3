"""Heaps taken apart before a run."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.scene.pose import Poses
from packwork.start.first_poses import relocated
from scenes import disc, overlap_area, placed, poses, round_container, share_inside


def heap(count: int, scale: float = 5.0) -> Poses:
    return poses(np.full(count, 50.0), np.full(count, 50.0), 0.3, scale)


def test_a_heap_comes_apart_inside_the_container() -> None:
    outlines = [disc()] * 12
    found = relocated(
        round_container(), outlines, heap(12), np.arange(1, 12), np.random.default_rng(0)
    )
    ends = placed(outlines, found)
    assert overlap_area(ends) == 0
    assert min(share_inside(outline, round_container()) for outline in ends) > 0.9


def test_only_buried_items_move_and_only_their_places_change() -> None:
    angles, scales, stretches = [0.1, 0.2, 0.3], [9.0, 9.0, 4.0], [1.0, 2.0, 0.5]
    before = poses([30.0, 70.0, 70.0], 50.0, angles, scales, stretches)
    after = relocated(
        round_container(), [disc()] * 3, before, np.array([2]), np.random.default_rng(0)
    )
    np.testing.assert_array_equal(after.x[:2], before.x[:2])
    np.testing.assert_array_equal(after.y[:2], before.y[:2])
    np.testing.assert_array_equal(after.angle, before.angle)
    np.testing.assert_array_equal(after.scale, before.scale)
    np.testing.assert_array_equal(after.stretch, before.stretch)
    assert np.hypot(after.x[2] - before.x[:2], after.y[2] - before.y[:2]).min() > 13
    assert before.x[2] == 70


@pytest.mark.parametrize("count", [1, 300])
def test_all_may_be_buried_and_none(count: int) -> None:
    start, rng = heap(count, 2.0), np.random.default_rng(0)
    nobody = relocated(
        round_container(), [disc()] * count, start, np.array([], dtype=np.int64), rng
    )
    np.testing.assert_array_equal(nobody.x, start.x)
    everybody = relocated(round_container(), [disc()] * count, start, np.arange(count), rng)
    assert (np.hypot(everybody.x - 50, everybody.y - 50) < 46).all()


def test_items_off_the_canvas_are_fetched() -> None:
    lost = poses([-400.0, 50.0], [900.0, 50.0], 0.0, 5.0)
    found = relocated(
        round_container(), [disc()] * 2, lost, np.array([0]), np.random.default_rng(0)
    )
    assert np.hypot(found.x[0] - 50, found.y[0] - 50) < 45
