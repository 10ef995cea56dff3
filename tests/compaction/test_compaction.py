"""Separation, compaction, relocation and simplification of polygons, piece by piece."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from shapely.geometry import Polygon

from packwork.arrays import FloatArray, IntArray
from packwork.compaction import arrangement as arrangements
from packwork.compaction.arrangement import Arrangement, Detail, find_conflicts
from packwork.compaction.compact import blocks, compact_all
from packwork.compaction.kernels.steps import LEAST_GROWTH, MOST_GROWTH, RETURN_WEIGHT, Objective
from packwork.compaction.objective import FixedSize, FreeSizes, SharedSize
from packwork.compaction.outer_simplify import inner_simplified, outer_simplified
from packwork.compaction.separate import relocate, separate, separate_evenly
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import union
from packwork.readers.container import read_container
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from scenes import box, disc, square, star
from strategies import generators, star_rings

GAP, HAIR = 0.01, 0.001


def free(arrangement: Arrangement, areas: FloatArray) -> FreeSizes:
    """Any turn, half to twice the size."""
    n = arrangement.count
    turns = np.full(n, -np.inf), np.full(n, np.inf)
    return FreeSizes(areas, turns, np.full(n, -np.log(2)), np.full(n, np.log(2)))


def is_clean(arrangement: Arrangement) -> bool:
    return len(arrangement.conflicts(arrangement.pairs(GAP), GAP)) == 0


@given(star_rings(), generators())
@settings(deadline=None, max_examples=60)
def test_an_outer_simplification_holds_the_region_and_an_inner_one_is_held(
    ring: FloatArray, rng: np.random.Generator
) -> None:
    region = Outline.from_rings([ring]).region
    tolerance = float(10.0 ** rng.uniform(-5, -0.5))
    assert outer_simplified(region, tolerance).covers(region)
    assert region.covers(inner_simplified(region, tolerance))


def test_outer_simplifications_have_few_vertices_and_are_tight() -> None:
    circle = disc(1.0, 500).region
    cover = outer_simplified(circle, 1e-3)
    assert len(cover.exterior.coords) < 150
    assert cover.area / circle.area < 1.01


@pytest.mark.parametrize("count", [0, 1, 5, 128, 1000])
def test_blocks_hold_every_item_once(count: int) -> None:
    positions = np.random.default_rng(0).uniform(size=(count, 2))
    for turn in range(6):
        found = blocks(positions, turn, most=32)
        assert sorted(np.concatenate([*found, np.zeros(0, int)])) == list(range(count))
        assert max((len(block) for block in found), default=0) <= 32


def test_blocks_are_cut_elsewhere_each_round() -> None:
    positions = np.random.default_rng(0).uniform(size=(100, 2))
    cuts = {tuple(map(len, blocks(positions, turn, most=64))) for turn in range(5)}
    assert len(cuts) == 5


def test_separation_shrinks_only_those_in_conflict() -> None:
    places = np.array([[3.0, 5.0, 0, 0], [4.9, 5.0, 0, 0], [8.0, 8.0, 0, 0]])
    arrangement = Arrangement([square()] * 3, box(0, 0, 10, 10), places)
    moved = separate(arrangement, GAP)
    growth = arrangement.places[:, 3]
    assert is_clean(arrangement)
    assert len(moved) == 0
    assert growth[2] == 0
    assert -0.1 < growth[:2].max() < 0


def test_separation_evenly_leaves_one_size_for_all_and_no_conflict() -> None:
    places = np.array([[3.0, 5.0, 0, 0], [4.7, 5.0, 0, 0], [8.0, 8.0, 0, 0]])
    arrangement = Arrangement([square()] * 3, box(0, 0, 10, 10), places)
    separate_evenly(arrangement, GAP)
    growth = arrangement.places[:, 3]
    assert is_clean(arrangement)
    assert np.ptp(growth) < 1e-6
    assert -0.3 < growth[0] < np.log(0.85)


def test_a_trapped_item_moves_to_a_void() -> None:
    places = np.array([[5.0, 5.0, 0, 0], [5.0, 5.0, 0, 0]])
    arrangement = Arrangement([square(4.0), square(0.4)], box(0, 0, 20, 10), places)
    moved = separate(arrangement, GAP)
    assert is_clean(arrangement)
    assert moved.tolist() == [1]
    assert arrangement.places[1, 0] > 9
    assert arrangement.places[0, 3] > -0.5


def test_items_outside_come_in() -> None:
    places = np.array([[30.0, 30.0, 0, 0], [5.0, 5.0, 0, 0]])
    arrangement = Arrangement([square()] * 2, box(0, 0, 10, 10), places)
    separate(arrangement, GAP)
    assert is_clean(arrangement)


def thin_spiral(turns: int, points: int) -> Outline:
    """A line as wide as a quarter of the way between its turns, 200 across."""
    angle = np.linspace(np.pi, 2 * np.pi * turns, points)
    way = np.column_stack([np.cos(angle), np.sin(angle)])
    apart = 100 / turns
    middle = (apart * angle / (2 * np.pi))[:, None]
    return Outline.from_rings(
        [np.concatenate([(middle + apart / 8) * way, ((middle - apart / 8) * way)[::-1]])]
    )


@pytest.mark.parametrize("hurries", [bool, lambda: True])
def test_items_that_lie_across_thin_lines_are_moved_into_them(hurries: object) -> None:
    wall = thin_spiral(30, 3_000)
    places = np.zeros((20, 4))
    places[:, 0] = np.linspace(-80, 80, 20)
    arrangement = Arrangement([disc(3.0)] * 20, wall, places)
    separate(arrangement, GAP, hurries=hurries)
    assert is_clean(arrangement)
    assert np.exp(arrangement.places[:, 3]).min() > 0.03


def test_separation_evenly_in_a_hurry_is_clean_and_even() -> None:
    places = np.zeros((6, 4))
    places[:, 0] = np.arange(6)
    arrangement = Arrangement([square(1.0)] * 6, box(-9, -9, 9, 9), places)
    asked = [0]

    def hurries() -> bool:
        asked[0] += 1
        return True

    separate_evenly(arrangement, GAP, hurries)
    assert is_clean(arrangement)
    assert np.ptp(arrangement.places[:, 3]) < 1e-3
    assert 0 < asked[0] < 60


def test_a_container_of_very_many_vertices_is_simplified_to_its_safe_side(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("packwork.compaction.outer_simplify.MANY_VERTICES", 1_000)
    region = thin_spiral(10, 3_000).region
    fewer = inner_simplified(region, 0.02)
    assert region.covers(fewer)
    assert fewer.area > 0.97 * region.area
    assert inner_simplified(region, 1e-4 * region.length / 6_000) is region


def test_a_container_of_very_many_parts_keeps_those_of_few_vertices(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    left = np.arange(40.0)
    hairs = list(shapely.box(left, 0.0, left + 0.01, 40.0))
    region = shapely.MultiPolygon([*hairs, shapely.Point(60, 20).buffer(5.0, quad_segs=100)])
    monkeypatch.setattr("packwork.compaction.outer_simplify.MANY_PARTS", 40)
    united: list[int] = []
    monkeypatch.setattr("packwork.compaction.outer_simplify.union", as_counted(united))
    fewer = inner_simplified(region, 0.02)
    assert region.covers(fewer)
    assert fewer.area > 0.99 * region.area
    assert shapely.get_num_coordinates(fewer) < shapely.get_num_coordinates(region) - 200
    assert united == [1]


def as_counted(united: list[int]) -> Callable[[Sequence[Polygon]], Polygon]:
    """Union of regions, with how many they are."""

    def counted(parts: Sequence[Polygon]) -> Polygon:
        united.append(len(parts))
        return union(parts)

    return counted


def test_the_largest_item_gets_the_largest_void() -> None:
    places = np.array([[5.0, 5.0, 0, 0], [0.0, 0.0, 0, 0.0], [0.0, 0.0, 0, 0.0]])
    arrangement = Arrangement([square(4.9), square(0.5), square(2.0)], box(0, 0, 30, 10), places)
    relocate(arrangement, np.array([1, 2]), GAP)
    assert is_clean(arrangement)
    assert arrangement.places[2, 3] == pytest.approx(0.0)
    assert arrangement.places[2, 0] > 12


def test_an_item_without_a_void_stays() -> None:
    arrangement = Arrangement(
        [box(-4.99, -4.99, 4.99, 4.99), square(0.5)],
        box(0, 0, 10, 10),
        np.array([[5.0, 5.0, 0, 0], [2.0, 2.0, 0.5, 0.1]]),
    )
    relocate(arrangement, np.array([1]), GAP)
    assert arrangement.places[1].tolist() == [2.0, 2.0, 0.5, 0.1]


def objective_value(arrangement: Arrangement, objective: Objective, items: IntArray) -> float:
    """Worth of items, less for those out of their bounds, as kernels count it."""
    growth = arrangement.places[items, 3]
    value = objective.weights[items] * np.exp(objective.power * growth)
    below = np.maximum(objective.smallest[items] - growth, 0.0)
    above = np.maximum(growth - objective.largest[items], 0.0)
    return float((value / objective.power - RETURN_WEIGHT * value * (below + above)).sum())


@given(generators())
@settings(deadline=None, max_examples=25)
def test_a_round_never_leaves_a_conflict_nor_loses_area(rng: np.random.Generator) -> None:
    count = int(rng.integers(1, 9))
    shapes = [star(1.0), square(0.8), disc(0.7, 12), box(-1.5, -0.2, 1.5, 0.2)]
    outlines = [shapes[k] for k in rng.integers(4, size=count)]
    places = np.column_stack(
        [rng.uniform(2, 8, (count, 2)), rng.uniform(0, 6, count), np.zeros(count)]
    )
    arrangement = Arrangement(outlines, box(0, 0, 10, 10), places)
    separate(arrangement, GAP)
    objective = free(arrangement, np.array([o.area for o in outlines])).objective(places[:, 3], 0.1)
    everyone = np.arange(count)
    for trust in (2.0, 0.5, 0.1):
        before = objective_value(arrangement, objective, everyone)
        start = arrangement.places.copy()
        compact_all(arrangement, objective, 0, trust, GAP, HAIR)
        moved = (arrangement.places != start).any()
        assert is_clean(arrangement)
        # What is cut to come clear is far less than what a step gains.
        assert (
            objective_value(arrangement, objective, everyone) > before - 0.05 * count or not moved
        )


def test_a_lone_square_fills_its_box() -> None:
    arrangement = Arrangement([square()], box(0, 0, 10, 10), np.array([[3.0, 4.0, 0.7, 0.0]]))
    turns = np.full(1, -np.inf), np.full(1, np.inf)
    sizing = FreeSizes(np.array([4.0]), turns, np.array([-9.0]), np.array([9.0]))
    for trust in np.geomspace(2.0, 0.01, 30):
        objective = sizing.objective(arrangement.places[:, 3], 1.0)
        compact_all(arrangement, objective, 0, trust, GAP, HAIR)
    assert 2 * np.exp(arrangement.places[0, 3]) == pytest.approx(10 - 2 * GAP, abs=0.02)


def test_turn_limits_hold() -> None:
    arrangement = Arrangement([square()], box(0, 0, 10, 10), np.array([[5.0, 5.0, 0.7, 0.0]]))
    turns = np.array([0.6]), np.array([0.8])
    sizing = FreeSizes(np.array([4.0]), turns, np.array([-9.0]), np.array([9.0]))
    for trust in np.geomspace(2.0, 0.01, 30):
        objective = sizing.objective(arrangement.places[:, 3], 1.0)
        compact_all(arrangement, objective, 0, trust, GAP, HAIR)
    assert 0.6 - 1e-6 < arrangement.places[0, 2] < 0.8 + 1e-6


def test_shared_sizes_favour_the_smallest() -> None:
    turns = np.zeros(3), np.zeros(3)
    growth = np.array([-0.2, 0.0, 0.01])
    objective = SharedSize(np.ones(3), turns).objective(growth, 0.05)
    value = objective.weights * np.exp(objective.power * growth)
    assert value[0] > value[1] > value[2]
    assert objective.largest[0] < growth[1]


def test_fixed_sizes_are_done_when_all_are_back() -> None:
    turns = np.zeros(2), np.zeros(2)
    sizing = FixedSize(np.ones(2), turns)
    assert not sizing.is_done(np.array([0.0, -1e-4]))
    assert sizing.is_done(np.zeros(2))
    assert sizing.laggards(np.array([0.0, -0.3])).tolist() == [1]


def test_an_inner_simplification_of_a_coast_keeps_its_land() -> None:
    """Bays that close upon each other must not fill what they enclose."""
    coast = read_container("australia").outline.region
    for tolerance in (0.05, 0.5, 1.0):
        safe = inner_simplified(coast, tolerance)
        assert coast.covers(safe)
        assert coast.area - safe.area < 3 * tolerance * coast.length


def test_specks_neither_vanish_nor_jump() -> None:
    """Items far smaller than the trust region: programmes are no guide there."""
    tiny = np.array([[0.0, 0.0, 0.0, -9.0], [3e-4, 0.0, 0.0, -9.0]])
    two = Arrangement([square(1.0), square(1.0)], square(5.0), tiny)
    turns = np.full(2, -np.inf), np.full(2, np.inf)
    objective = FixedSize(np.full(2, 4.0), turns).objective(two.places[:, 3], 1.0)
    for _ in range(3):
        before = two.places[:, 3].copy()
        compact_all(two, objective, 0, 0.8, 1e-5, 1e-6)
        grown = two.places[:, 3] - before
        assert grown.max() <= MOST_GROWTH
        assert two.places[:, 3].min() >= LEAST_GROWTH


def test_covers_that_are_stopped_are_the_outlines_themselves() -> None:
    poses = Poses(np.zeros(2), np.zeros(2), np.zeros(2), np.ones(2))
    detail = Detail([disc(3.0), square(1.0)], box(-9, -9, 9, 9), poses)
    assert detail.covers(0.1, lambda: True) is detail
    assert detail.covers(0.1) is not detail


@settings(deadline=None, max_examples=20)
@given(generators())
def test_conflicts_of_many_are_found_strip_by_strip(rng: np.random.Generator) -> None:
    count = 40
    outlines = [disc(1.0), box(-3.0, -0.2, 3.0, 0.2)] * (count // 2)
    x, y = rng.uniform(0, 30, (2, count))
    angle, scale = rng.uniform(0, 3, count), rng.uniform(0.5, 2, count)
    poses = Poses(x, y, angle, scale, rng.uniform(0.5, 2, count))
    container = Container("", "", box(2, 2, 28, 28), 30, 30)
    at_once = find_conflicts(container, outlines, poses, 0.1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(arrangements, "STRIP", 7)
        by_strips = find_conflicts(container, outlines, poses, 0.1)
    assert len(at_once) > 10
    assert set(by_strips) == set(at_once)


@pytest.mark.parametrize("size", [(10.0, 1000.0), (1000.0, 10.0)])
def test_strips_lie_across_the_longer_side(size: tuple[float, float]) -> None:
    x, y = (np.linspace(0, side, 100) for side in size)
    poses = Poses(x, y, np.zeros(100), np.ones(100))
    strips = list(arrangements._strips([disc(1.0)] * 100, poses, 0.1, 20))
    assert [len(items) for items in strips] == [20] * 5
