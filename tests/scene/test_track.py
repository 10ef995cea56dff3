"""Tracks: what lies between keyframes, the short way round, the pace."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.errors import ShapeError
from packwork.scene.track import Track, numbers_of, poses_of, track_of
from scenes import as_array, poses


def test_keyframes_are_met_and_between_them_it_goes_straight_on() -> None:
    track = track_of([poses([0.0, 5.0], 1.0), poses([4.0, 5.0], 3.0), poses([4.0, 6.0], 3.0)])
    np.testing.assert_allclose(track.at(0.5).x, [4.0, 5.0])
    np.testing.assert_allclose(track.at(0.25).x, [2.0, 5.0])
    np.testing.assert_allclose(track.at(0.25).y, [2.0, 2.0])
    np.testing.assert_allclose(track.at(1.0).x, [4.0, 6.0])


def test_times_beyond_the_ends_are_the_ends() -> None:
    track = track_of([poses([0.0], 0.0), poses([8.0], 0.0)])
    assert track.at(-3.0).x.tolist() == [0.0]
    assert track.at(7.0).x.tolist() == [8.0]


@pytest.mark.parametrize(("before", "after", "middle"), [(0.1, 6.2, 0.0), (3.0, -3.0, np.pi)])
def test_items_turn_the_short_way(before: float, after: float, middle: float) -> None:
    track = track_of([poses([0.0], 0.0, before), poses([0.0], 0.0, after)])
    halfway = float(track.at(0.5).angle[0])
    assert abs(np.remainder(halfway - middle + np.pi, 2 * np.pi) - np.pi) < 0.05


def test_one_keyframe_stands_still() -> None:
    track = track_of([poses([3.0], 4.0)], np.ones(1))
    assert track.at(0.0).x.tolist() == track.at(1.0).x.tolist() == [3.0]


def test_no_items_are_no_trouble() -> None:
    track = track_of([poses([], []), poses([], [])], np.zeros(0))
    assert len(track.at(0.5)) == 0


def test_what_moves_more_takes_longer() -> None:
    still, moved = poses([0.0, 1.0], 0.0), poses([50.0, 1.0], 0.0)
    times = track_of([still, moved, moved, moved], np.ones(2)).times
    assert np.diff(times)[0] > 3 * np.diff(times)[1]
    assert np.diff(times)[1] == pytest.approx(np.diff(times)[2])
    assert times[[0, -1]].tolist() == [0.0, 1.0]


def test_numbers_and_poses_are_each_others_inverse() -> None:
    rng = np.random.default_rng(3)
    given = poses(*rng.uniform(1, 2, (5, 7)))
    np.testing.assert_array_equal(as_array(poses_of(numbers_of(given))), as_array(given))


def test_times_and_keyframes_belong_together() -> None:
    with pytest.raises(ShapeError, match="a time for each keyframe, not 2 for 1"):
        Track(np.array([0.0, 1.0]), np.zeros((1, 3, 5)))


def test_fillers_take_their_time() -> None:
    before, after = poses([0.0, 90.0], 0.0, scale=[1.0, 0.0]), poses([0.0, 90.0], 0.0)
    times = track_of([before, after, after, after], np.ones(2)).times
    assert np.diff(times)[0] > 3 * np.diff(times)[1]
