"""Bottom-left placement of true outlines: exact, low, and only what fits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.forces.field import Direction, Distance, Field
from packwork.forces.forces import FieldForce
from packwork.geometry.outline import Outline
from packwork.progress import never
from packwork.scene.pose import Poses
from packwork.start.first_fit.lowest_fit import Falling, lowest_fit
from scenes import box, disc, square_container, star

DOWN = Direction(np.pi / 2)
TURNS = np.arange(4) * np.pi / 2


def _laid(
    outlines: list[Outline],
    field: Field = DOWN,
    strengths: FloatArray | None = None,
    angles: FloatArray = TURNS,
    margin: float = 0.0,
    seed: int = 0,
) -> tuple[Poses, IntArray, list[shapely.Polygon]]:
    count = len(outlines)
    falling = Falling(
        outlines, np.ones(count), [angles] * count, np.arange(count),
        [FieldForce(field, np.ones(count) if strengths is None else strengths)], margin,
        np.full(count, len(angles) > 1),
    )  # fmt: skip
    poses, found = lowest_fit(square_container(), falling, np.random.default_rng(seed), never)
    return poses, found, [outlines[k].mapped(poses.matrix(int(k))).region for k in found]


MIXED = [star(9.0), disc(6.0), box(-9.0, -2.0, 9.0, 2.0)] * 6


@pytest.mark.parametrize("field", [DOWN, Direction(0.0), Direction(-np.pi / 2)])
@pytest.mark.parametrize("seed", range(3))
def test_nothing_meets_and_all_is_inside(field: Field, seed: int) -> None:
    _, found, regions = _laid(MIXED, field, margin=0.5, seed=seed)
    assert len(found) == len(MIXED)
    for k, region in enumerate(regions):
        assert shapely.contains_properly(square_container().outline.region, region)
        assert all(shapely.distance(region, other) >= 1.0 for other in regions[:k])


def test_items_come_to_lie_low_and_close() -> None:
    _, _, regions = _laid(MIXED)
    left, _, right, bottom = square_container().outline.bounds
    heap = shapely.box(left, min(region.bounds[1] for region in regions), right, bottom)
    assert sum(region.area for region in regions) > 0.4 * heap.area


def test_items_lie_on_each_other_and_not_on_pixels() -> None:
    tiles = [box(-8.0, -8.0, 8.0, 8.0)] * 5
    container = square_container()
    tall = replace(container, outline=box(40.0, 5.0, 60.0, 95.0))
    force = FieldForce(DOWN, np.ones(5))
    falling = Falling(
        tiles, np.ones(5), [np.zeros(1)] * 5, np.arange(5), [force], 1e-6, np.zeros(5, bool)
    )
    poses, _ = lowest_fit(tall, falling, np.random.default_rng(0), never)
    assert np.abs(np.sort(poses.y)[::-1] - (87.0 - 16.0 * np.arange(5))).max() < 0.5


def test_an_item_comes_into_the_bay_of_another() -> None:
    yoke = shapely.box(-30, -30, 30, 30) - shapely.box(-20, -30, 20, 10)
    _, _, (outer, inner) = _laid([Outline.from_region(yoke), disc(15.0)], angles=np.zeros(1))
    assert shapely.contains(outer.convex_hull, inner)


def test_a_point_draws_from_all_sides() -> None:
    middle = Distance.from_points(np.array([[50.0, 50.0]]))
    poses, _, _ = _laid([disc(6.0)] * 7, middle)
    assert np.hypot(poses.x - 50, poses.y - 50).max() < 20


def test_what_is_drawn_the_other_way_goes_there() -> None:
    poses, _, _ = _laid([disc(6.0)] * 6, strengths=np.array([1.0, -1.0] * 3))
    assert poses.y[0::2].min() > 80
    assert poses.y[1::2].max() < 20


def test_what_has_no_room_is_told() -> None:
    outlines = [box(-30.0, -30.0, 30.0, 30.0)] * 3 + [disc(5.0)]
    _, found, _ = _laid(outlines)
    assert found.tolist() == [0, 3]


def test_the_same_seed_gives_the_same_places() -> None:
    first, second, other = (_laid(MIXED, seed=seed)[0] for seed in (0, 0, 1))
    assert first.x.tolist() == second.x.tolist()
    assert first.x.tolist() != other.x.tolist()
