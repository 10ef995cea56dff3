"""First poses, whatever the container: places in it, angles and scales as asked."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
import pytest
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.angles_and_sizes import nearest_allowed, start_angles
from packwork.start.first_poses import first_poses, poses_apart, start_resolution
from packwork.start.options import StartOptions
from scenes import box, disc, placed, round_container, share_inside, square, star

Method = Literal["auto", "distance-field", "medial-axis", "scatter"]
METHODS = pytest.mark.parametrize("method", get_args(Method))


def start(
    container: Container, outlines: list[Outline], scales: FloatArray, method: Method, seed: int = 0
) -> Poses:
    angles = np.linspace(-1, 1, len(outlines))
    options = StartOptions(method=method)
    rng = np.random.default_rng(seed)
    return first_poses(container, outlines, scales, angles, options, rng).poses


@METHODS
def test_angles_and_scales_are_those_given(method: Method) -> None:
    scales = np.array([3.0, 9.0, 5.0])
    where = start(round_container(), [square(), star(), disc()], scales, method)
    np.testing.assert_array_equal(where.scale, scales)
    np.testing.assert_array_equal(where.angle, [-1, 0, 1])


@METHODS
def test_centres_lie_in_the_container(method: Method) -> None:
    container = round_container()
    where = start(container, [disc()] * 30, np.full(30, 5.0), method)
    assert shapely.contains_xy(container.outline.region.buffer(0.5), where.x, where.y).all()


@pytest.mark.parametrize("method", ["distance-field", "medial-axis"])
def test_a_greedy_start_is_mostly_inside_and_apart(method: Method) -> None:
    container = round_container()
    outlines = [disc(), square(), star()] * 4
    ends = placed(outlines, start(container, outlines, np.full(12, 6.0), method))
    assert min(share_inside(outline, container) for outline in ends) > 0.9
    union = shapely.union_all([outline.region for outline in ends])
    assert union.area > 0.95 * sum(outline.area for outline in ends)


@METHODS
def test_a_container_thinner_than_a_pixel_is_no_trouble(method: Method) -> None:
    thread = Container("thread", "thread", box(10, 50, 90, 50.01), 100.0, 100.0)
    where = start(thread, [disc()] * 5, np.full(5, 1.0), method)
    assert np.abs(where.y - 50).max() < 1
    assert (where.x > 9).all()
    assert (where.x < 91).all()


@METHODS
def test_many_more_items_than_there_is_room_for(method: Method) -> None:
    container = round_container()
    where = start(container, [disc()] * 1_000, np.full(1_000, 20.0), method)
    assert np.isfinite([where.x, where.y]).all()
    assert ((where.x > 0) & (where.x < 100) & (where.y > 0) & (where.y < 100)).all()


@METHODS
def test_one_seed_is_one_start(method: Method) -> None:
    first, again, other = (
        start(round_container(), [disc()] * 6, np.full(6, 5.0), method, seed) for seed in (5, 5, 6)
    )
    np.testing.assert_array_equal(first.x, again.x)
    assert np.abs(first.x - other.x).max() > 1e-3


def test_resolution_grows_with_the_number_of_items_up_to_a_bound() -> None:
    counts = [1, 100, 2_000, 10_000, 100_000, 10_000_000]
    sides = [start_resolution(count) for count in counts]
    assert sides == sorted(sides)
    assert sides[0] == sides[1] < sides[3] < sides[-1] == start_resolution(10**9)


def test_free_angles_go_all_round() -> None:
    angles = start_angles(500, None, None, np.random.default_rng(0))
    assert angles.min() < -3 < 3 < angles.max()
    assert np.abs(angles).max() <= np.pi


def test_a_limit_bounds_angles() -> None:
    angles = start_angles(500, 0.2, None, np.random.default_rng(0))
    assert 0.19 < np.abs(angles).max() <= 0.2


def test_only_the_choices_are_taken_and_all_of_them() -> None:
    angles = start_angles(200, None, (0.0, 1.5, -2.0), np.random.default_rng(0))
    assert set(angles) == {0.0, 1.5, -2.0}


def test_angles_of_an_earlier_layout_turn_to_the_nearest_allowed() -> None:
    angles = np.array([0.1, 3.0, -3.0, 6.2, 9.5])
    np.testing.assert_array_equal(nearest_allowed(angles, None, None), angles)
    np.testing.assert_allclose(nearest_allowed(angles, 0.0, None), 0.0)
    np.testing.assert_allclose(
        nearest_allowed(angles, 0.5, None), [0.1, 0.5, -0.5, 6.2 - 2 * np.pi, -0.5]
    )
    assert nearest_allowed(angles, None, (0.0, np.pi)).tolist() == [0, np.pi, np.pi, 0, np.pi]


def test_poses_apart_meet_nothing_though_one_item_is_far_larger() -> None:
    container = round_container()
    outlines = [disc(), square(), star()] * 10
    scales = np.array([60.0] + [2.0] * 29)
    poses = poses_apart(container, outlines, scales, np.linspace(-1, 1, 30))
    assert poses is not None
    np.testing.assert_allclose(poses.scale / poses.scale[1], scales / scales[1])
    ends = placed(outlines, poses)
    assert min(share_inside(outline, container) for outline in ends) == pytest.approx(1)
    union = shapely.union_all([outline.region for outline in ends])
    assert union.area == pytest.approx(sum(outline.area for outline in ends))
