"""Strips whose parts are moved together: shorter, and never with an overlap."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from packwork.separation.compact import StripCompaction
from packwork.separation.container import SquareGround
from packwork.separation.ground import Ground, ground_of
from packwork.separation.shapes import Floats, Part, placed
from packwork.separation.state import Problem

pytestmark = pytest.mark.compiled

SQUARE = Part(region=shapely.box(-1, -1, 1, 1), count=2)


def compacted(
    problem: Problem, poses: Floats, length: float
) -> tuple[Floats, list[shapely.Polygon]]:
    found = StripCompaction(problem, poses, np.ones(len(problem), bool), length).run(1e-5)
    kinds = [problem.parts[kind] for kind in problem.shape_of]
    return found, [placed(kind.region, pose) for kind, pose in zip(kinds, found, strict=True)]


def test_parts_with_room_between_them_come_to_touch() -> None:
    poses = np.array([[1.3, 1.0, 0, 1], [3.9, 1.2, 0, 1]])
    _, found = compacted(Problem([SQUARE], Ground(2.3)), poses, 4.9)
    assert 4.0 < found[1].bounds[2] < 4.0 + 1e-4
    assert found[0].distance(found[1]) > 0.0


def test_a_part_goes_round_another_into_the_room_beside_it() -> None:
    poses = np.array([[1.0, 1.2, 0, 1], [2.2, 3.3, 0, 1]])
    _, found = compacted(Problem([SQUARE], Ground(4.5)), poses, 3.2)
    assert shapely.total_bounds(np.array(found))[2] == pytest.approx(2.0, abs=1e-4)


@pytest.mark.parametrize("reach", [0.35, math.inf])
def test_a_part_turns_no_farther_than_it_may(reach: float) -> None:
    bar = Part(region=shapely.box(-2, -0.2, 2, 0.2), turns=None, reach=reach)
    poses = np.array([[2.1, 2.5, 0.3, 1.0]])
    found, _ = compacted(Problem([bar], Ground(5.0)), poses, 4.2)
    assert abs(found[0, 2]) <= reach * (1 + 1e-9)
    assert (abs(found[0, 2]) > 1.0) == math.isinf(reach)


def test_obstacles_and_other_sheets_are_kept_clear_of() -> None:
    hole = shapely.box(0.5, 0, 1.5, 2.2)
    ground = ground_of([shapely.box(0, 0, 6, 2.2)] * 2, ([], [hole]))
    start = ground.bays[1].start
    poses = np.array([[start + 4.0, 1.1, 0, 1]])
    part = Part(region=shapely.box(-1, -1, 1, 1))
    _, (found,) = compacted(Problem([part], ground), poses, start + 5.0)
    assert found.bounds[0] - start == pytest.approx(1.5, abs=1e-4)
    assert all(found.intersection(one).area == 0.0 for one in ground.obstacles)


def test_a_square_becomes_smaller_across_and_down() -> None:
    poses = np.array([[1.5, 1.5, 0, 1], [3.7, 3.6, 0, 1]])
    _, found = compacted(Problem([SQUARE], SquareGround()), poses, 4.7)
    assert shapely.total_bounds(np.array(found)).max() == pytest.approx(4.0, abs=1e-3)


@pytest.mark.parametrize("seed", range(3))
def test_nothing_overlaps_whatever_the_parts(seed: int) -> None:
    rng = np.random.default_rng(seed)
    parts = list[Part]()
    for k in range(9):
        angles = np.sort(rng.uniform(0, 2 * math.pi, 9))
        points = np.column_stack([np.cos(angles), np.sin(angles)]) * rng.uniform(0.3, 1, (9, 1))
        parts.append(
            Part(region=shapely.Polygon(points).buffer(0.02), turns=None if k % 2 else (0.5,))
        )
    x, y = np.meshgrid(1.1 + 2.2 * np.arange(3), 1.1 + 2.2 * np.arange(3))
    angles = np.where(np.arange(9) % 2, rng.uniform(-3, 3, 9), 0.5)
    poses = np.column_stack([x.ravel(), y.ravel(), angles, np.ones(9)])
    _, found = compacted(Problem(parts, Ground(6.6)), poses, 6.6)
    x0, y0, x1, y1 = shapely.total_bounds(np.array(found))
    assert min(x0, y0) >= 0.0
    assert y1 <= 6.6
    assert x1 < 6.2
    for k, one in enumerate(found):
        assert not any(one.intersects(other) for other in found[:k])


def test_parts_of_a_later_sheet_end_at_its_edge() -> None:
    ground = ground_of([shapely.box(0, 0, 6, 2.2)] * 2, ([], []))
    start = ground.bays[1].start
    poses = np.array([[start + 4.0, 1.1, 0, 1]])
    part = Part(region=shapely.box(-1, -1, 1, 1))
    _, (found,) = compacted(Problem([part], ground), poses, start + 5.0)
    assert found.bounds[0] - start == pytest.approx(0.0, abs=1e-4)
