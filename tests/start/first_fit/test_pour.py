"""Pours: each item has a way to its place, nothing meets on the way, and the heap is close."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from scipy.ndimage import label
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from packwork.arrays import BoolArray, FloatArray
from packwork.forces.field import Direction
from packwork.forces.forces import FieldForce
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.progress import never
from packwork.scene.container import Container
from packwork.start.first_fit.kernels import ways
from packwork.start.first_fit.lowest_fit import Falling, lowest_fit
from packwork.start.first_fit.occupancy import Bits
from packwork.start.first_fit.pour import Poured, Source, pour
from scenes import box, disc, square_container, star

DOWN = Direction(np.pi / 2)
TURNS = np.arange(4) * np.pi / 2
MIXED = [star(9.0), disc(6.0), box(-9.0, -2.0, 9.0, 2.0)] * 6
TOP = np.column_stack([np.linspace(15.0, 85.0, 15), np.full(15, 15.0)])


def _falling(outlines: list[Outline], margin: float = 0.0) -> Falling:
    count = len(outlines)
    force = FieldForce(DOWN, np.ones(count))
    return Falling(
        outlines,
        np.ones(count),
        [TURNS] * count,
        np.arange(count),
        [force],
        margin,
        np.ones(count, bool),
    )


def _poured(
    outlines: list[Outline],
    points: FloatArray = TOP,
    container: Container | None = None,
    every: int = 2,
    seed: int = 0,
    margin: float = 0.0,
    basin: Outline | None = None,
) -> Poured:
    room = container or square_container()
    source = Source(points, np.zeros(len(points), dtype=int), every)
    rng = np.random.default_rng(seed)
    falling = _falling(outlines, margin)
    return pour(room, basin or room.outline, falling, source, rng, never)


def _regions(outlines: list[Outline], found: Poured) -> list[shapely.Polygon]:
    return [outlines[k].mapped(found.poses.matrix(int(k))).region for k in found.items]


@pytest.mark.parametrize("seed", range(4))
def test_nothing_meets_in_any_round(seed: int) -> None:
    found = _poured(MIXED, margin=0.5, seed=seed)
    assert len(found.items) == len(MIXED)
    wall = square_container().outline.region
    for items, points in found.rounds():
        regions = [
            MIXED[k].mapped(similarity(x, y, found.poses.angle[k] + turn, 1.0)).region
            for k, (x, y, turn) in zip(items, points, strict=True)
        ]
        assert all(shapely.contains_properly(wall, region) for region in regions)
        tree = shapely.STRtree(regions)
        first, second = tree.query(regions, predicate="dwithin", distance=0.99)
        assert (first == second).all()


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("every", [1, 7])
def test_items_come_in_one_by_one_and_end_at_their_places(every: int, seed: int) -> None:
    found = _poured(MIXED, every=every, seed=seed)
    starts = np.array([flight.start for flight in found.flights])
    assert starts[0] == 0
    assert np.diff(starts).min() >= every
    steps = np.concatenate([np.diff(flight.points, axis=0) for flight in found.flights])
    assert np.hypot(*steps.T[:2]).max() < 6.0
    *_, (items, points) = found.rounds()
    assert sorted(items) == list(range(len(MIXED)))
    assert points.T.tolist() == [
        found.poses.x[items].tolist(),
        found.poses.y[items].tolist(),
        [0.0] * 18,
    ]


def test_a_pour_is_about_as_low_as_what_is_put_without_a_way() -> None:
    outlines, higher = MIXED * 2, []
    for seed in range(5):
        rng = np.random.default_rng(seed)
        laid, _ = lowest_fit(square_container(), _falling(outlines), rng, never)
        higher.append(laid.y.mean() - _poured(outlines, seed=seed).poses.y.mean())
    assert np.median(higher) < 2.0


def test_nothing_comes_where_no_way_leads() -> None:
    two = shapely.union(shapely.box(5, 50, 45, 95), shapely.box(50, 5, 95, 60))
    container = Container("two", "two", Outline.from_region(two), 100.0, 100.0)
    found = _poured([disc(6.0)] * 6, np.array([[70.0, 15.0]]), container)
    assert len(found.items) == 6
    assert found.poses.x.min() > 50


def test_a_roof_keeps_the_room_below_it_dry() -> None:
    room = shapely.union(shapely.box(10, 5, 90, 60), shapely.box(30, 60, 70, 95))
    hut = Container("hut", "hut", Outline.from_region(room), 100.0, 100.0)
    outlines, force = [box(-37.0, -3.0, 37.0, 3.0), *[disc(4.0)] * 3], FieldForce(DOWN, np.ones(4))
    falling = Falling(
        outlines, np.ones(4), [np.zeros(1)] * 4, np.arange(4), [force], 0.0, np.zeros(4, bool)
    )
    source = Source(np.array([[50.0, 15.0]]), np.zeros(1, dtype=int), 1)
    found = pour(hut, hut.outline, falling, source, np.random.default_rng(0), never)
    assert found.items.tolist() == [0, 1, 2, 3]
    assert found.poses.y[1:].max() < found.poses.y[0]


def test_what_comes_from_beyond_the_canvas_ends_in_the_container() -> None:
    container = Container("cup", "cup", box(20.0, 0.0, 80.0, 95.0), 100.0, 100.0)
    basin = box(20.0, -500.0, 80.0, 95.0)
    above = np.array([[50.0, -10.0]])
    outlines = [disc(9.0)] * 40
    found = _poured(outlines, above, container, basin=basin)
    assert 12 < len(found.items) < 40
    assert all(flight.points[0, 1] < 0 for flight in found.flights)
    assert all(container.outline.region.contains(one) for one in _regions(outlines, found))


def _bits(mask: BoolArray) -> Bits:
    return np.packbits(mask, axis=1, bitorder="little").view("<u8")


@pytest.mark.parametrize("width", [64, 192])
@pytest.mark.parametrize("share", [0.55, 0.7, 0.95])
def test_a_flood_fills_what_hangs_together(width: int, share: float) -> None:
    rng = np.random.default_rng(width)
    for _ in range(10):
        mask = rng.random((30, width)) < share
        seeds = (rng.random(mask.shape) < 0.003) & mask
        numbers, _ = label(mask)
        reached = _bits(seeds)
        ways.flood(_bits(mask), reached)
        expected = mask & np.isin(numbers, np.unique(numbers[seeds]))
        assert (reached == _bits(expected)).all()


def test_costs_of_ways_are_those_of_shortest_paths() -> None:
    rng = np.random.default_rng(0)
    price = rng.uniform(0.2, 1.2, (20, 25))
    price[rng.random(price.shape) < 0.3] = np.inf
    price[3, 4] = 1.0
    costs = np.full(price.shape, np.inf)
    costs[3, 4] = 0.0
    ways.spread_costs(price, costs)
    rows, columns = np.indices(price.shape)
    edges = []
    for y in (-1, 0, 1):
        for x in (-1, 0, 1):
            to_row, to_column = rows + y, columns + x
            is_inside = (to_row >= 0) & (to_row < 20) & (to_column >= 0) & (to_column < 25)
            here = np.flatnonzero(is_inside & ((x != 0) | (y != 0)))
            there = (to_row * 25 + to_column).ravel()[here]
            edges.append(np.array([here, there, np.hypot(x, y) * price.ravel()[there]]))
    a, b, lengths = np.concatenate(edges, axis=1)
    is_open = np.isfinite(lengths)
    graph = coo_array((lengths[is_open], (a[is_open].astype(int), b[is_open].astype(int))))
    assert np.allclose(costs.ravel(), dijkstra(graph.tocsr(), indices=3 * 25 + 4))
