"""Parts on many sheets of any outline: nothing lost, nothing off its sheet, nothing overlapping."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.separation.ground import ground_of, tiles
from packwork.separation.shapes import Part
from packwork.separation.sheets import SheetSearch
from packwork.separation.strip import WorkBound
from packwork.separation.windows import FreeSheet, LaidSheet, lay_on_sheets, lay_on_strip

pytestmark = pytest.mark.compiled

TRIANGLE = shapely.Polygon([(-1.5, -1), (1.5, -1), (0, 2)])
SQUARE = shapely.box(-1, -1, 1, 1)
HIDE = shapely.Point(7, 6).buffer(6, quad_segs=12) - shapely.Point(8, 7).buffer(1.5)
STARTED = FreeSheet(shapely.box(0, 0, 12, 10), (shapely.box(3, 3, 9, 7),))


def regions(parts: list[Part], laid: LaidSheet) -> list[shapely.Polygon]:
    return [
        shapely.affinity.affine_transform(
            parts[kind].region, [side * math.cos(a), -math.sin(a), side * math.sin(a), math.cos(a),
                                 x, y],
        )
        for kind, (x, y, a, side) in zip(laid.kinds, laid.poses, strict=True)
    ]  # fmt: skip


def overlap(found: list[shapely.Polygon]) -> float:
    return max(
        (a.intersection(b).area for k, a in enumerate(found) for b in found[:k]), default=0.0
    )


def lay(
    parts: list[Part], sheets: list[FreeSheet], passes: int, seed: int = 0
) -> tuple[list[LaidSheet], Counter[int]]:
    return lay_on_sheets(
        parts, sheets, seed=seed, workers=2, work=WorkBound(passes=passes), stop=lambda: False
    )


@pytest.mark.parametrize("seed", range(3))
def test_every_part_is_laid_once_or_counted_as_left(seed: int) -> None:
    parts = [
        Part(region=SQUARE, count=40, turns=(0.0, 0.4)),
        Part(region=TRIANGLE, count=60, turns=None, mirrors=True),
        Part(region=shapely.box(-2, -0.2, 2, 0.2), count=9, turns=(0.0,), is_optional=True),
    ]
    sheets = [FreeSheet(HIDE), STARTED, *(FreeSheet(shapely.box(0, 0, 14, 8)) for _ in range(20))]
    laid, left = lay(parts, sheets, 120, seed)
    counts = Counter(kind for one in laid for kind in one.kinds) + left
    assert counts == {0: 40, 1: 60, 2: 9}
    assert len({one.sheet for one in laid}) == len(laid) >= 5
    for one in laid:
        sheet, found = sheets[one.sheet], [*sheets[one.sheet].held, *regions(parts, one)]
        assert all(sheet.region.buffer(1e-9).covers(region) for region in found)
        assert overlap(found) < 1e-9


def test_parts_take_no_more_sheets_than_a_row_by_row_layout_would() -> None:
    parts = [Part(region=SQUARE, count=27)]
    sheets = [FreeSheet(shapely.box(0, 0, 6.3, 6.3)) for _ in range(12)]
    found = [lay(parts, sheets, 300, seed) for seed in range(3)]
    assert not any(left for _, left in found)
    assert min(len(laid) for laid, _ in found) <= 4  # three of nine squares would do


def test_sheets_that_are_too_few_are_filled_by_priority() -> None:
    parts = [
        Part(region=SQUARE, count=9, turns=(0.0,)),
        Part(region=SQUARE, count=4, turns=(0.0,), priority=1),
    ]
    laid, left = lay(parts, [FreeSheet(shapely.box(0, 0, 6.5, 4.4))], 200)
    assert Counter(laid[0].kinds)[1] == 4
    assert left[0] + Counter(laid[0].kinds)[0] == 9
    assert left[1] == 0


def test_more_parts_than_a_window_takes_lie_on_one_sheet(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("packwork.separation.windows.MOST_IN_WINDOW", 10)
    parts = [Part(region=shapely.box(0, 0, 1, 1), count=25)]
    sheets = [FreeSheet(shapely.box(0, 0, 9, 9)) for _ in range(5)]
    laid, left = lay(parts, sheets, 2_000)
    assert not left
    assert [one.sheet for one in laid] == [0]
    found = regions(parts, laid[0])
    assert len(found) == 25
    assert overlap(found) < 1e-9


def test_parts_that_fit_only_a_later_sheet_are_laid_there() -> None:
    small, large = FreeSheet(shapely.box(0, 0, 10, 10)), FreeSheet(shapely.box(0, 0, 60, 40))
    sheets = [small] * 14 + [large] * 3
    laid, left = lay([Part(region=shapely.box(0, 0, 15, 12), count=6)], sheets, 400)
    assert not left
    assert min(one.sheet for one in laid) >= 14


def test_optional_parts_alone_take_no_more_sheets_than_they_need() -> None:
    parts = [Part(region=shapely.box(0, 0, 1, 1), count=20, is_optional=True)]
    laid, left = lay(parts, [FreeSheet(shapely.box(0, 0, 9, 9)) for _ in range(4)], 400)
    assert not left
    assert len(laid) == 1


def test_all_parts_are_laid_however_little_work_is_allowed() -> None:
    parts = [Part(region=SQUARE, count=150), Part(region=TRIANGLE, count=250, turns=(0.0, 3.0))]
    sheets = [FreeSheet(shapely.box(0, 0, 20, 12)) for _ in range(40)]
    laid, left = lay(parts, sheets, 1)
    assert not left
    assert Counter(kind for one in laid for kind in one.kinds) == {0: 150, 1: 250}
    assert max(overlap(regions(parts, one)) for one in laid) < 1e-9
    # 1,725 square units of parts on sheets of 240: a third of each is covered at least.
    assert len(laid) <= 21


@pytest.mark.parametrize("passes", [1, 60])
def test_sheets_of_more_parts_than_a_window_takes_are_filled_however_little_work_is_allowed(
    passes: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("packwork.separation.windows.MOST_IN_WINDOW", 40)
    parts = [Part(region=SQUARE, count=150), Part(region=TRIANGLE, count=150, turns=(0.0, 3.0))]
    laid, left = lay(parts, [FreeSheet(shapely.box(0, 0, 30, 24)) for _ in range(9)], passes)
    assert not left
    assert Counter(kind for one in laid for kind in one.kinds) == {0: 150, 1: 150}
    assert max(overlap(regions(parts, one)) for one in laid) < 1e-9
    # 1,275 square units of parts on sheets of 720.
    assert len(laid) <= 5


def test_sheets_are_left_no_sparser_than_one_search_of_some_parts_leaves_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("packwork.separation.windows.MOST_IN_WINDOW", 60)
    angle = shapely.Polygon([(0, 0), (1, 0), (1, 3), (3, 3), (3, 4), (0, 4)])
    tee = shapely.box(0, 0, 3, 0.8) | shapely.box(1.1, 0.8, 1.9, 3)
    parts = [
        Part(region=region, count=100, turns=(0.0, math.pi / 2, math.pi, 1.5 * math.pi))
        for region in (angle, tee, shapely.box(0, 0, 2, 1.3))
    ]
    laid, left = lay(parts, [FreeSheet(shapely.box(0, 0, 40, 30)) for _ in range(6)], 300)
    assert not left
    # 1,276 square units of parts on sheets of 1,200.
    assert len(laid) <= 2


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    ("size", "many", "sheets"), [((29, 19), 4, 1), ((29, 19), 12, 3), ((19, 19), 6, 1)]
)
def test_parts_that_only_just_have_room_on_all_sheets_that_there_are_find_it(
    size: tuple[int, int], many: int, sheets: int, seed: int
) -> None:
    parts = [Part(region=shapely.box(0, 0, *size), count=many, turns=(0.0, math.pi / 2))]
    free = [FreeSheet(shapely.box(0, 0, 60, 40)) for _ in range(sheets)]
    laid, left = lay(parts, free, 2_000, seed)
    assert not left
    assert len(laid) == sheets
    assert max(overlap(regions(parts, one)) for one in laid) < 1e-9


@given(
    wide=st.floats(5, 30), tall=st.floats(5, 19), many=st.integers(1, 12), few=st.integers(0, 6),
    passes=st.sampled_from([1, 40]), seed=st.integers(0, 99),
)  # fmt: skip
@settings(max_examples=12, deadline=None)
def test_all_parts_are_laid_where_each_may_have_a_sheet(
    wide: float, tall: float, many: int, few: int, passes: int, seed: int
) -> None:
    parts = [
        Part(region=shapely.box(0, 0, wide, tall), count=many, turns=(0.0, math.pi / 2)),
        Part(region=shapely.affinity.scale(TRIANGLE, 9, 9), count=few, turns=(0.0, math.pi)),
    ]
    parts = [part for part in parts if part.count]
    small, large = FreeSheet(shapely.box(0, 0, 9, 4)), FreeSheet(shapely.box(0, 0, 60, 40))
    sheets = [small] * 50 + [large] * (many + few)
    laid, left = lay(parts, sheets, passes, seed)
    assert not left
    assert Counter(kind for one in laid for kind in one.kinds) == Counter(
        {kind: part.count for kind, part in enumerate(parts)}
    )
    assert max(overlap(regions(parts, one)) for one in laid) < 1e-9


def filling(passes: int, seed: int) -> SheetSearch:
    parts = [Part(region=SQUARE, count=60), Part(region=TRIANGLE, count=60, turns=(0.0, 3.0))]
    ground = ground_of([shapely.box(0, 0, 20.5, 12.7)])
    return SheetSearch(parts, ground, seed=seed, work=WorkBound(passes=passes))


def test_parts_that_move_together_leave_room_for_more() -> None:
    areas = dict[int, float]()
    for passes in (1, 150):
        searches = [filling(passes, seed) for seed in range(3)]
        poses = [search.fill().poses for search in searches]
        assert all(np.isnan(one[:, 0]).any() for one in poses)
        areas[passes] = sum(
            search.problem.areas[~np.isnan(one[:, 0])].sum()
            for search, one in zip(searches, poses, strict=True)
        )
    assert areas[1] > 3 * 0.5 * 20.5 * 12.7
    assert areas[150] > areas[1]


def test_sheets_go_on_from_their_shortest_and_never_get_longer() -> None:
    search = filling(40, 1)
    with search.pool:
        search.work.start()
        order = np.flatnonzero(search.problem.shape_of == 0)[:12].tolist()
        search.first_fit(order, search.ground.end, math.inf)
        shortest = search.best
        search.best = search.fallback()
        search.begin_anew(1.0)
        assert search.best is shortest
        found = search.shorten()
    assert found.left == shortest.left
    assert found.length < shortest.length
    poses = found.poses[order]
    assert not np.isnan(poses).any()
    laid = LaidSheet(0, (0,) * len(order), poses)
    assert overlap(regions([Part(region=SQUARE)], laid)) < 1e-9


def test_ground_has_obstacles_where_no_sheet_is() -> None:
    ground = ground_of([HIDE, SQUARE])
    first, second = ground.bays
    assert ground.height == pytest.approx(12.0)
    assert first.area == pytest.approx(HIDE.area)
    union = shapely.union_all(ground.obstacles)
    moved = shapely.affinity.translate(HIDE, *first.offset)
    assert union.intersection(moved).area < 1e-9
    assert union.intersection(shapely.affinity.translate(SQUARE, *second.offset)).area < 1e-9
    whole = shapely.box(0, 0, second.end, 12.0)
    assert union.union(moved).area == pytest.approx(whole.area + 1.2 * 12 - 4, rel=1e-6)


def test_many_parts_that_lie_already_are_few_obstacles() -> None:
    held = [shapely.box(x, y, x + 0.6, y + 0.6) for x in range(25) for y in range(20)]
    ground = ground_of([shapely.box(0, 0, 25, 20)], [held])
    assert len(ground.obstacles) < 60
    union = shapely.union_all(ground.obstacles)
    assert union.intersection(shapely.box(0, 0, 25, 20)).area == pytest.approx(500 * 0.36)


def test_tiles_are_small_and_make_up_the_region() -> None:
    found = tiles(HIDE, 2.0)
    sides = np.array([one.bounds for one in found])
    assert (sides[:, 2:] - sides[:, :2]).max() <= 2.0 + 1e-9
    assert sum(one.area for one in found) == pytest.approx(HIDE.area)


@pytest.mark.parametrize("seed", range(4))
def test_what_is_laid_at_last_lies_on_sheets_in_use(seed: int) -> None:
    parts = [Part(region=SQUARE, count=6), Part(region=shapely.box(-2, -1, 2, 1), count=2)]
    laid, left = lay(parts, [FreeSheet(shapely.box(0, 0, 12, 10)) for _ in range(4)], 4, seed)
    assert not left
    assert [one.sheet for one in laid] == [0]


@pytest.mark.parametrize("seed", range(4))
def test_the_widest_part_needs_not_lie_to_a_hair(seed: int) -> None:
    plate = shapely.affinity.scale(shapely.Point(0, 0).buffer(1), 2.03, 2.55)
    sheets = [FreeSheet(shapely.box(0, 0, 20, 20)) for _ in range(3)]
    laid, _ = lay([Part(region=plate, count=2, turns=(0.3,))], sheets, 20, seed)
    assert [one.sheet for one in laid] == [0]


@given(
    counts=st.lists(st.integers(1, 5), min_size=1, max_size=4),
    loose=st.integers(0, 4),
    seed=st.integers(0, 99),
)
@settings(deadline=None, max_examples=15)
def test_parts_that_go_together_lie_on_one_sheet(counts: list[int], loose: int, seed: int) -> None:
    kinds = [
        Part(region=region, count=count, turns=(0.0, 1.5), together=f"set {k}")
        for k, count in enumerate(counts) for region in (SQUARE, TRIANGLE)
    ]  # fmt: skip
    parts = [*kinds, Part(region=SQUARE, count=loose)]
    sheets = [FreeSheet(shapely.box(0, 0, 8, 6)) for _ in range(3)]
    laid, left = lay(parts, sheets, 200, seed)
    for name in {part.together for part in kinds}:
        own = {k for k, part in enumerate(parts) if part.together == name}
        on = [one.sheet for one in laid if own & set(one.kinds)]
        counted = sum(left[k] for k in own)
        assert len(on) <= 1
        assert counted in {0, sum(parts[k].count for k in own)}
        assert bool(on) is (counted == 0)
    placed = Counter(kind for one in laid for kind in one.kinds)
    assert all(placed[k] + left[k] == part.count for k, part in enumerate(parts))
    assert max((overlap(regions(parts, one)) for one in laid), default=0.0) < 1e-9


def test_many_parts_on_a_strip_lie_on_pieces_of_it() -> None:
    parts = [Part(region=SQUARE, count=500), Part(region=TRIANGLE, count=300, turns=(0.0, 3.0))]
    laid = lay_on_strip(
        parts, 20.0, seed=3, workers=1, work=WorkBound(passes=9), stop=lambda: False
    )
    assert Counter(laid.kinds) == {0: 500, 1: 300}
    found = regions(parts, laid)
    left, top, _, bottom = shapely.total_bounds(found)
    assert left >= -1e-9
    assert top >= -1e-9
    assert bottom <= 20.0 + 1e-9
    first, second = shapely.STRtree(found).query(found)
    assert all(found[a].intersection(found[b]).area < 1e-9
               for a, b in zip(first, second, strict=True) if a < b)  # fmt: skip
