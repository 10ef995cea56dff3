"""What a zone's items feel: against differences of a value that is drawn another way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import shapely

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.scene.pose import Limits, Zone
from packwork.solve.free_space import ZonePull
from packwork.solve.level import Level
from packwork.solve.options import SolveOptions
from packwork.solve.relocate_trapped import relocate_trapped, violation_shares
from packwork.solve.solver import solve
from scenes import (
    as_array,
    box,
    disc,
    from_array,
    placed,
    poses,
    share_inside,
    square,
    square_container,
    star,
)

Options = Callable[..., SolveOptions]
PX_PER_CU = 2.0
ZONE = box(20, 30, 60, 70)


@pytest.mark.parametrize("side", [1e-4, 0.01, 0.1])
def test_a_zone_thinner_than_a_pixel_has_room(side: float) -> None:
    thin = Zone(box(20, 30, 20 + side, 30 + side), np.array([0]))
    assert ZonePull(thin, [star()], (50, 50), 0.5).room.any()


def pull(items: list[int], outlines: list) -> ZonePull:
    return ZonePull(Zone(ZONE, np.array(items)), outlines, (200, 200), PX_PER_CU)


def area_outside(outlines: list, where: object, items: list[int]) -> float:
    """Exact, in squared canvas units: no pixels."""
    placed_outlines = placed(outlines, where)
    return sum(shapely.difference(placed_outlines[k].region, ZONE.region).area for k in items)


def test_the_gradient_is_that_of_the_area_outside(rng: np.random.Generator) -> None:
    """Centres in the zone, so that nothing is called back; edges across its border."""
    outlines = [disc(corners=24), star(), square()]
    where = poses([24.3, 57.1, 40.7], [41.2, 66.3, 50.1], [0.4, -0.7, 1.1], [9.0, 12.0, 11.0])
    items = [0, 1]
    by_pose = np.zeros((3, 5))
    pull(items, outlines).add(by_pose, where, 3.0)

    def value(numbers: FloatArray) -> float:
        return 3.0 * area_outside(outlines, from_array(numbers), items)

    assert not by_pose[2].any()
    # Float32 coverages, and borders of the zone that lie on pixels' edges.
    assert_gradient(value, by_pose, as_array(where), step=2.0**-8, error=2e-3)


def test_an_item_that_lost_its_zone_is_pulled_straight_back() -> None:
    by_pose = np.zeros((1, 5))
    pull([0], [disc()]).add(by_pose, poses([90.0], [50.0], 0.0, 4.0), 1.0)
    assert by_pose[0, 0] > 0
    assert by_pose[0, 1] == pytest.approx(0, abs=0.05 * by_pose[0, 0])


def test_two_walks_leave_nothing_behind() -> None:
    outlines = [disc(), star()]
    where = poses([24.3, 57.1], [41.2, 66.3], 0.0, 9.0)
    zone = pull([0, 1], outlines)
    first, second = np.zeros((2, 5)), np.zeros((2, 5))
    zone.add(first, where, 1.0)
    zone.add(second, where, 1.0)
    np.testing.assert_array_equal(first, second)


def limits_of(items: list[int], count: int, **changes: object) -> Limits:
    return replace(Limits.free(count), zones=(Zone(ZONE, np.array(items)),), **changes)


def test_what_lies_outside_its_zone_is_in_violation_and_relocated_into_it() -> None:
    container, outlines = square_container(), [disc(), disc()]
    where = poses([80.0, 85.0], [50.0, 20.0], 0.0, 6.0)
    level = Level(container, outlines, 200, limits=limits_of([0], 2))
    shares = violation_shares(level, where, level.density(where))
    np.testing.assert_allclose(shares, [1, 0], atol=1e-3)
    areas = np.array([outline.area for outline in outlines])
    after, (relocation,) = relocate_trapped(
        level, where, areas, where.scale, where.scale, limits_of([0], 2)
    )
    assert relocation.item == 0
    assert shapely.contains_xy(ZONE.region, after.x[0], after.y[0])


def test_relocation_leaves_held_items_where_they_are() -> None:
    outlines = [square(), disc()]
    where = poses([38.0, 38.0], [50.0, 50.0], 0.0, [32.0, 20.0])
    level = Level(square_container(), outlines, 200)
    areas = np.array([outline.area for outline in outlines])
    held = replace(Limits.free(2), x=np.array([np.nan, 38.0]))
    _, relocations = relocate_trapped(level, where, areas, where.scale, where.scale, held)
    assert [relocation.item for relocation in relocations] == [0]


def test_a_solve_brings_those_of_a_zone_into_it(quick: Options) -> None:
    """Nearly all, whatever the start; the finish is there for the rest."""
    outlines = [disc(), star(), square()] * 4
    items, zone = [0, 1, 2, 3], replace(square_container(), outline=ZONE)
    options = quick(epochs=250, levels=(40, 120))
    shares: list[list[float]] = [[], []]
    for seed in range(4):
        rng = np.random.default_rng(seed)
        start = poses(rng.uniform(15, 85, 12), rng.uniform(15, 85, 12), 0.0, np.full(12, 9.0))
        bounds = {"smallest": start.scale / 2, "largest": start.scale * 2}
        for k, given in enumerate((Limits.free(12), limits_of(items, 12))):
            limits = replace(given, **bounds)
            end = solve(square_container(), outlines, start, start.scale, options, limits=limits)
            ends = placed(outlines, end.poses)
            shares[k] += [share_inside(ends[item], zone) for item in items]
    free, held = np.mean(shares, axis=1)
    assert free < 1 / 2
    assert held > 9 / 10
