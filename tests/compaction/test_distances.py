from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

from packwork.compaction.arrangement import LEAST_STRIDE, Arrangement
from packwork.compaction.kernels.broad_phase import pairs_of
from packwork.geometry.outline import Outline
from scenes import box
from strategies import SEEDS, generators


def blob(rng: np.random.Generator) -> Outline:
    """Star-shaped polygon about its origin, sometimes with a hole."""
    count = int(rng.integers(3, 50))
    turns = 2 * np.pi * (np.arange(count) + rng.uniform(0, 0.7, count)) / count
    spokes = np.column_stack([np.cos(turns), np.sin(turns)])
    rings = [rng.uniform(0.5, 1.5, count)[:, None] * spokes]
    if rng.random() < 0.3 and count > 4:
        rings.append((0.2 * spokes)[::-1])
    return Outline.from_rings(rings)


def true_distance(one: Outline, other: Outline) -> float:
    return float(shapely.distance(one.region, other.region))


@given(generators())
@settings(deadline=None, max_examples=60)
def test_distances_are_those_of_geos(rng: np.random.Generator) -> None:
    outlines = [blob(rng) for _ in range(6)]
    places = np.column_stack(
        [rng.uniform(2, 8, 6), rng.uniform(2, 8, 6), rng.uniform(-9, 9, 6), rng.normal(0, 0.5, 6)]
    )
    wall = box(0, 0, 10, 10)
    arrangement = Arrangement(outlines, wall, places)
    placed = [
        Outline(arrangement.board.points[a:b], outline.starts)
        for outline, a, b in zip(
            outlines, arrangement.board.starts, arrangement.board.starts[1:], strict=False
        )
    ]
    pairs = arrangement.pairs(20.0)
    for (i, j), found in zip(pairs, arrangement.distances(pairs, 3.0), strict=True):
        if j < 6:
            expected = true_distance(placed[i], placed[j])
        elif wall.region.covers(placed[i].region):
            expected = shapely.distance(wall.region.boundary, placed[i].region)
        else:
            expected = 0.0
        assert found == pytest.approx(min(expected, 3.0), abs=1e-9)


def wavy(points: int) -> Outline:
    """Container of many edges, with a hole."""
    turns = 2 * np.pi * np.arange(points) / points
    spokes = np.column_stack([np.cos(turns), np.sin(turns)])
    rings = [5 + (4 + np.cos(9 * turns))[:, None] * spokes, (5 + 0.8 * spokes)[::-1]]
    return Outline.from_rings(rings)


@given(generators())
@settings(deadline=None, max_examples=40)
def test_distances_from_a_container_of_many_edges(rng: np.random.Generator) -> None:
    wall, outlines = wavy(10 * LEAST_STRIDE - 7), [blob(rng) for _ in range(8)]
    places = np.column_stack([rng.uniform(0, 10, (8, 2)), np.zeros(8), rng.normal(-1.5, 0.5, 8)])
    arrangement = Arrangement(outlines, wall, places)
    pairs = np.column_stack([np.arange(8), np.full(8, 8)])
    for (i, _), found in zip(pairs, arrangement.distances(pairs, 3.0), strict=True):
        points = arrangement.board.points[slice(*arrangement.board.starts[i : i + 2])]
        region = Outline(points, outlines[i].starts).region
        is_inside = wall.region.covers(region)
        expected = shapely.distance(wall.region.boundary, region) if is_inside else 0.0
        assert found == pytest.approx(min(expected, 3.0), abs=1e-9)


@given(SEEDS)
@settings(deadline=None, max_examples=30)
def test_every_near_pair_is_listed_once(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 60))
    places = np.column_stack([rng.uniform(0, 30, (count, 2)), np.zeros((count, 2))])
    arrangement = Arrangement([box(-1, -1, 1, 1)] * count, box(0, 0, 30, 30), places)
    pairs = arrangement.pairs(0.5)
    away = np.abs(places[:, None, :2] - places[None, :, :2]).max(axis=2)
    near = {(i, j) for i in range(count) for j in range(i + 1, count) if away[i, j] <= 2.5}
    listed = [(int(i), int(j)) for i, j in pairs]
    assert len(listed) == len(set(listed))
    assert set(listed) == near | {(i, count) for i in range(count)}


@given(SEEDS)
@settings(deadline=None, max_examples=30)
def test_pairs_of_some_items_are_all_near_pairs_with_one_of_them(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 60))
    places = np.column_stack([rng.uniform(0, 30, (count, 2)), np.zeros((count, 2))])
    arrangement = Arrangement([box(-1, -0.5, 1, 0.5)] * count, box(-9, -9, 40, 40), places)
    items = rng.permutation(count)[: rng.integers(1, count + 1)]
    every = {tuple(pair) for pair in arrangement.pairs(0.7).tolist()}
    found = [tuple(pair) for pair in pairs_of(arrangement.board.boxes, items, 0.7).tolist()]
    assert len(set(found)) == len(found)
    assert set(found) == {pair for pair in every if set(pair) & set(items.tolist())}


def test_an_item_beyond_every_wall_is_not_inside() -> None:
    places = np.array([[0.0, 0, 0, 0], [90.0, 0, 0, 0]])
    two = Arrangement([box(-1, -1, 1, 1)] * 2, box(-9, -9, 9, 9), places)
    assert two.distances(np.array([[0, 2], [1, 2]]), 0.5).tolist() == [0.5, 0.0]


def test_an_item_in_a_notch_of_the_container_is_not_inside() -> None:
    notched = Outline.from_region(
        shapely.difference(shapely.box(-30, -30, 30, 30), shapely.box(-9, -30, 9, 20))
    )
    one = Arrangement([box(-1, -1, 1, 1)], notched, np.zeros((1, 4)))
    assert one.distances(np.array([[0, 1]]), 0.5).tolist() == [0.0]


def test_an_item_in_the_hole_of_another_is_clear() -> None:
    frame = Outline.from_region(shapely.box(-4, -4, 4, 4) - shapely.box(-2, -2, 2, 2))
    arrangement = Arrangement([frame, box(-1, -1, 1, 1)], box(-9, -9, 9, 9), np.zeros((2, 4)))
    assert arrangement.distances(np.array([[0, 1]]), 9.0).tolist() == [1.0]


def test_an_item_wholly_inside_another_meets_it() -> None:
    outlines = [box(-4, -4, 4, 4), box(-1, -1, 1, 1)]
    arrangement = Arrangement(outlines, box(-9, -9, 9, 9), np.zeros((2, 4)))
    assert arrangement.distances(np.array([[0, 1]]), 9.0).tolist() == [0.0]


def test_edges_that_cross_far_from_all_corners_meet() -> None:
    outlines = [box(-5, -0.1, 5, 0.1), box(-0.1, -5, 0.1, 5)]
    arrangement = Arrangement(outlines, box(-9, -9, 9, 9), np.zeros((2, 4)))
    assert arrangement.distances(np.array([[0, 1]]), 1.0).tolist() == [0.0]


@pytest.mark.parametrize("x", [0.0, 20.0])
def test_a_hole_of_the_container_and_its_outside_are_walls(x: float) -> None:
    ring = Outline.from_region(shapely.box(-9, -9, 9, 9) - shapely.box(-1, -1, 1, 1))
    arrangement = Arrangement([box(-0.5, -0.5, 0.5, 0.5)], ring, np.array([[x, 0.0, 0.0, 0.0]]))
    assert arrangement.distances(np.array([[0, 1]]), 1.0).tolist() == [0.0]


def test_a_hole_of_the_container_inside_an_item_is_met() -> None:
    ring = Outline.from_region(shapely.box(-9, -9, 9, 9) - shapely.box(-1, -1, 1, 1))
    arrangement = Arrangement([box(-3, -3, 3, 3)], ring, np.zeros((1, 4)))
    assert arrangement.distances(np.array([[0, 1]]), 1.0).tolist() == [0.0]
