"""Items of one kind change places with others: as large as who lay there, if they may."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import shapely

from packwork.geometry.outline import Outline
from packwork.scene.neighbours import side_by_side
from packwork.scene.pose import NO_LIMITS, Limits
from packwork.solve.exchange import exchange
from packwork.solve.options import SolveOptions
from packwork.solve.solver import solve
from scenes import disc, placed, poses, square, square_container, star

Options = Callable[..., SolveOptions]
ROW = poses([10.0, 30.0, 50.0, 70.0], [50.0, 50.5, 50.0, 50.5], 0.1, [9.0, 9.0, 8.0, 8.0])
RNG = np.random.default_rng(0)
KINDS = np.array([0, 0, 1, 1])


def limits(**changes: object) -> Limits:
    return replace(Limits.free(4), kinds=KINDS, **changes)


def beside_its_kind(outlines: list, where: object, kinds: np.ndarray) -> int:
    pairs = side_by_side(placed(outlines, where))
    return int(np.count_nonzero(kinds[pairs[:, 0]] == kinds[pairs[:, 1]]))


def test_a_row_of_pairs_becomes_a_row_in_turn() -> None:
    outlines = [disc(), disc(), square(), square()]
    after, moved = exchange(
        square_container().outline, outlines, ROW, limits(), ROW.scale / 2, ROW.scale * 2, RNG
    )
    assert beside_its_kind(outlines, ROW, KINDS) == 2
    assert beside_its_kind(outlines, after, KINDS) == 0
    assert sorted(after.x) == sorted(ROW.x)
    assert len(moved) == 2
    areas = [outline.area for outline in placed(outlines, ROW)]
    for k in moved:
        (there,) = np.flatnonzero(ROW.x == after.x[k])
        assert np.isclose(placed(outlines, after)[k].area, areas[there])


def test_sizes_that_are_fixed_stay() -> None:
    outlines = [disc(), disc(), square(), square()]
    after, _ = exchange(
        square_container().outline, outlines, ROW, limits(), ROW.scale, ROW.scale, RNG
    )
    np.testing.assert_array_equal(after.scale, ROW.scale)
    assert beside_its_kind(outlines, after, KINDS) == 0


def test_pinned_items_are_not_exchanged() -> None:
    held = limits(x=np.array([10.0, np.nan, np.nan, np.nan]))
    after, moved = exchange(
        square_container().outline, [disc()] * 4, ROW, held, ROW.scale / 2, ROW.scale * 2, RNG
    )
    assert after.x[0] == 10.0
    assert 0 not in moved


def test_sketchy_items_are_shared_out_among_parts() -> None:
    tiles = shapely.union_all([shapely.box(0, 0, 40, 100), shapely.box(60, 0, 100, 100)])
    outlines = [star(), star(), disc(), disc()]
    where = poses([10.0, 30.0, 70.0, 90.0], [50.0] * 4, 0.1, [9.0] * 4)
    region, bounds = Outline.from_region(tiles), (where.scale / 2, where.scale * 2)
    after, moved = exchange(region, outlines, where, NO_LIMITS, *bounds, RNG)
    assert len(moved) == 2
    assert sorted(after.x[:2] < 50) == [False, True]
    kept, nobody = exchange(region, outlines, where, NO_LIMITS, where.scale, where.scale, RNG)
    assert nobody == []
    assert kept is where


def test_without_kinds_nothing_happens() -> None:
    after, moved = exchange(
        square_container().outline, [disc()] * 4, ROW, Limits.free(4), ROW.scale, ROW.scale, RNG
    )
    assert after is ROW
    assert moved == []


def test_a_solve_keeps_kinds_apart(quick: Options) -> None:
    rng = np.random.default_rng(1)
    kinds = np.repeat(np.arange(4), 6)
    start = poses(rng.uniform(15, 85, 24), rng.uniform(15, 85, 24), 0.0, np.full(24, 8.0))
    outlines = [[disc(), square()][kind % 2] for kind in kinds]
    bounds = {"smallest": start.scale / 2, "largest": start.scale * 2}
    losses = {"containment": 5.5, "overlap": 5.5, "filling": 1.0, "apart": 0.5}
    counts = []
    for asked in (np.arange(24), kinds):
        end = solve(
            square_container(), outlines, start, start.scale,
            quick(epochs=250, levels=(40, 120), losses=losses),
            limits=replace(Limits.free(24), kinds=asked, **bounds),
        ).poses  # fmt: skip
        counts.append(beside_its_kind(outlines, end, kinds))
    assert counts[1] <= 2 < counts[0] - 2
