from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.errors import ShapeError
from packwork.forces.field import Inward
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.metrics import exact
from packwork.metrics.exact import exact_coverage, exact_metrics
from packwork.metrics.violations import ViolationSet, violations
from packwork.separation.shapes import poles_of

Box = tuple[int, int, int, int]

CELLS = 16
ROOM = shapely.box(3, 3, 13, 13) - shapely.box(6, 6, 9, 9)


def box(left: float, top: float, right: float, bottom: float) -> Outline:
    return Outline.from_region(shapely.box(left, top, right, bottom))


def boxes() -> st.SearchStrategy[list[Box]]:
    span = st.tuples(st.integers(0, CELLS - 1), st.integers(1, 5)).map(
        lambda s: (s[0], min(s[0] + s[1], CELLS))
    )
    one = st.tuples(span, span).map(lambda s: (s[0][0], s[1][0], s[0][1], s[1][1]))
    return st.lists(one, max_size=7)


def cell_counts(found: list[Box]) -> np.ndarray:
    """How many boxes cover each cell of a grid: exact, as their corners are on it."""
    counts = np.zeros((CELLS, CELLS), dtype=int)
    for left, top, right, bottom in found:
        counts[top:bottom, left:right] += 1
    return counts


def box_distance(a: Box, b: Box) -> float:
    across = max(a[0] - b[2], b[0] - a[2], 0)
    down = max(a[1] - b[3], b[1] - a[3], 0)
    return math.hypot(across, down)


def test_two_squares() -> None:
    found = exact_metrics([box(1, 1, 3, 3), box(2, 2, 4, 4)], box(0, 0, 10, 10))
    assert found.overlap_area == pytest.approx(1)
    assert found.overlap == pytest.approx(0.01)
    assert found.coverage == pytest.approx(0.07)
    assert (found.exceeding, found.outside_area, found.min_gap) == (0, 0, 0)


def test_gap_between_items() -> None:
    found = exact_metrics([box(3, 3, 4, 4), box(4.25, 3, 5, 4)], box(0, 0, 10, 10))
    assert found.min_gap == 0.25
    assert found.overlap_area == 0


def test_gap_from_the_edge() -> None:
    assert exact_metrics([box(1e-7, 3, 4, 4)], box(0, 0, 10, 10)).min_gap == pytest.approx(1e-7)
    assert exact_metrics([box(4, 4, 6, 6)], box(0, 0, 10, 10)).min_gap == 4


@pytest.mark.parametrize(
    "touching",
    [
        [box(1, 1, 2, 2), box(2, 1, 3, 2)],
        [box(1, 1, 2, 2), box(2, 2, 3, 3)],
        [box(0, 1, 2, 2)],
    ],
    ids=["along a side", "in a corner", "the edge"],
)
def test_touching_is_no_overlap_and_no_gap(touching: list[Outline]) -> None:
    found = exact_metrics(touching, box(0, 0, 10, 10))
    assert (found.overlap_area, found.outside_area, found.min_gap) == (0, 0, 0)


@pytest.mark.parametrize("least", [1e-6, 3e-4])
def test_the_one_narrow_gap_among_many_is_found(rng: np.random.Generator, least: float) -> None:
    """Of 100 tiles about as far from each other, all within the first reach."""
    gaps = 4e-4 * (1 + rng.random(100) / 10)
    gaps[57] = least
    tiles = [
        box(col, row, col + 1 - gaps[10 * row + col], row + 1 - 5e-4)
        for row in range(10)
        for col in range(10)
    ]
    assert exact_metrics(tiles, box(-1, -1, 11, 11)).min_gap == pytest.approx(least, rel=1e-9)


def test_equal_gaps_are_measured_too() -> None:
    tiles = [box(col, row, col + 0.5, row + 0.5) for row in range(8) for col in range(8)]
    assert exact_metrics(tiles, box(-1, -1, 9, 9)).min_gap == 0.5


def test_no_items() -> None:
    found = exact_metrics([], box(0, 0, 10, 10))
    assert (found.coverage, found.overlap_area, found.outside_area) == (0, 0, 0)
    assert found.min_gap == math.inf
    assert exact_coverage([], box(0, 0, 10, 10)) == 0


def test_item_in_a_hole_is_outside() -> None:
    room = Outline.from_region(ROOM)
    found = exact_metrics([box(7, 7, 8, 8)], room)
    assert (found.outside_area, found.coverage, found.min_gap) == (1, 0, 0)


def test_item_in_the_hole_of_another() -> None:
    frame = Outline.from_region(shapely.box(1, 1, 9, 9) - shapely.box(3, 3, 7, 7))
    found = exact_metrics([frame, box(4, 4, 6, 6)], box(0, 0, 10, 10))
    assert (found.overlap_area, found.min_gap) == (0, 1)
    assert found.coverage == pytest.approx((64 - 16 + 4) / 100)


def test_overlap_is_counted_once_however_deep() -> None:
    found = exact_metrics([box(1, 1, 3, 3)] * 5, box(0, 0, 10, 10))
    assert found.overlap_area == pytest.approx(4)
    assert found.coverage == pytest.approx(0.04)


def test_slivers_do_not_drown() -> None:
    found = exact_metrics([box(-1e-9, 1, 5, 5), box(5 - 1e-9, 1, 9, 5)], box(0, 0, 10, 10))
    assert found.outside_area == pytest.approx(4e-9, rel=1e-4)
    assert found.overlap_area == pytest.approx(4e-9, rel=1e-4)


def test_crossed_outlines_are_repaired() -> None:
    bow_tie = Outline.from_rings([np.array([[1, 1], [3, 3], [3, 1], [1, 3.0]])])
    found = exact_metrics([bow_tie, box(4, 4, 5, 5)], box(0, 0, 10, 10))
    assert found.coverage == pytest.approx(0.03)
    assert found.overlap_area == 0


def test_crossed_container_is_repaired() -> None:
    bow_tie = Outline.from_rings([np.array([[0, 0], [10, 10], [10, 0], [0, 10.0]])])
    found = exact_metrics([box(1, 4, 2, 6)], bow_tie)
    assert found.coverage == pytest.approx(2 / 50)
    assert found.min_gap > 0


def test_container_without_area_is_refused() -> None:
    flat = Outline.from_rings([np.array([[0, 0], [1, 0], [2, 0.0]])])
    with pytest.raises(ShapeError, match="no area"):
        exact_metrics([box(0, 0, 1, 1)], flat)
    with pytest.raises(ShapeError, match="no area"):
        exact_coverage([box(0, 0, 1, 1)], flat)


@given(boxes())
@settings(deadline=None, max_examples=150)
def test_areas_against_counting_cells(found: list[Box]) -> None:
    counts, room = cell_counts(found), cell_counts([(3, 3, 13, 13)]) - cell_counts([(6, 6, 9, 9)])
    got = exact_metrics([box(*b) for b in found], Outline.from_region(ROOM))
    assert got.overlap_area == pytest.approx((counts > 1).sum())
    assert got.outside_area == pytest.approx(((counts > 0) & (room == 0)).sum())
    assert got.coverage == pytest.approx(((counts > 0) & (room == 1)).sum() / room.sum())
    assert got.overlap == pytest.approx(got.overlap_area / room.sum())
    assert got.exceeding == pytest.approx(got.outside_area / room.sum())


@given(boxes())
@settings(deadline=None, max_examples=150)
def test_gap_against_all_pairs(found: list[Box]) -> None:
    side = CELLS + 1
    room = (-1, -1, side, side)
    edges = [min(b[0] + 1, b[1] + 1, side - b[2], side - b[3]) for b in found]
    pairs = [box_distance(a, b) for a, b in combinations(found, 2)]
    got = exact_metrics([box(*b) for b in found], box(*room))
    assert got.min_gap == pytest.approx(min([*edges, *pairs], default=math.inf))


@given(boxes(), st.floats(-3, 3), st.floats(1e-3, 1e3))
@settings(deadline=None, max_examples=60)
def test_turning_and_growing_changes_no_share(found: list[Box], turn: float, scale: float) -> None:
    map_all = affine.similarity(5, -7, turn, scale)
    items, room = [box(*b) for b in found], Outline.from_region(ROOM)
    before = exact_metrics(items, room)
    after = exact_metrics([i.mapped(map_all) for i in items], room.mapped(map_all))
    assert after.coverage == pytest.approx(before.coverage, abs=1e-9)
    assert after.overlap == pytest.approx(before.overlap, abs=1e-9)
    assert after.exceeding == pytest.approx(before.exceeding, abs=1e-9)


@given(boxes(), st.randoms(use_true_random=False))
@settings(deadline=None, max_examples=60)
def test_order_does_not_matter(found: list[Box], random: object) -> None:
    shuffled = list(found)
    random.shuffle(shuffled)  # type: ignore[attr-defined]
    room = Outline.from_region(ROOM)
    one, two = (exact_metrics([box(*b) for b in bs], room) for bs in (found, shuffled))
    assert two.coverage == pytest.approx(one.coverage)
    assert two.overlap_area == pytest.approx(one.overlap_area)
    assert two.min_gap == one.min_gap
    assert exact_coverage([box(*b) for b in found], room) == pytest.approx(one.coverage)


def test_smallest_gap_of_more_than_one_portion_is_found_wherever_it_is() -> None:
    rng = np.random.default_rng(3)
    corners = np.array([(x, y) for x in range(25) for y in range(25)], dtype=float)
    sides = rng.uniform(0.2, 0.9, len(corners))
    tiles = [box(x, y, x + s, y + s) for (x, y), s in zip(corners, sides, strict=True)]
    for moved in (tiles, tiles[::-1], [tiles[k] for k in rng.permutation(len(tiles))]):
        found = exact_metrics(moved, box(-1, -1, 26, 26)).min_gap
        assert found == pytest.approx(1 - sides.max(), abs=1e-12)


@pytest.mark.parametrize("points", [4, 1200])
def test_what_outlines_keep_is_prepared_for_nobody(points: int) -> None:
    # Threads share it, and GEOS lets one at a time ask a prepared region.
    edges = [shapely.box(k, 0, k + 0.9, 1).segmentize(4 / points) for k in range(3)]
    tiles = [Outline.of(edge) for edge in edges]
    container = Outline.of(shapely.box(0, 0, 9, 9).segmentize(36 / points))
    kept = [one.region for one in (*tiles, container)]
    assert exact_metrics(tiles, container).is_clean
    assert violations(tiles, container, 0.5)
    found = ViolationSet(container, 0.5)
    found.change(dict(enumerate(tiles)))
    assert found.violations
    poles_of(kept[-1])
    Inward(container)(np.array([[1.0, 1.0]]))
    assert not shapely.is_prepared(kept).any()


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.tuples(st.integers(0, 40), st.integers(0, 40), st.integers(1, 20)),
        min_size=1,
        max_size=9,
    )
)
def test_strips_see_what_is_nearest_in_any_of_them(tiles: list[tuple[int, int, int]]) -> None:
    x, y, half = np.array(tiles, dtype=np.float64).T / 2
    placed = [box(*ends) for ends in zip(x - half, y - half, x + half, y + half, strict=True)]
    to_edge = np.min([x - half, y - half, 20 - x - half, 20 - y - half])
    beside = np.abs(np.subtract.outer(x, x)) - np.add.outer(half, half)
    above = np.abs(np.subtract.outer(y, y)) - np.add.outer(half, half)
    apart = np.hypot(np.maximum(beside, 0), np.maximum(above, 0))
    nearest = min(float(to_edge), *apart[~np.eye(len(tiles), dtype=bool)].tolist(), np.inf)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(exact, "STRIP", 2)
        found = exact_metrics(placed, box(0, 0, 20, 20))
    assert found.min_gap == pytest.approx(max(nearest, 0.0))
    if nearest > 0:
        assert found.coverage * 400 == pytest.approx(float((4 * half**2).sum()))


def test_strips_lie_across_the_longer_side(monkeypatch: pytest.MonkeyPatch) -> None:
    x, y = np.random.default_rng(0).uniform(2, 3, 40), 2.5 * np.arange(40) + 2
    placed = [box(a - 1, b - 1, a + 1, b + 1) for a, b in zip(x, y, strict=True)]
    seen, made = list[int](), exact._regions
    monkeypatch.setattr(exact, "STRIP", 4)
    monkeypatch.setattr(exact, "_regions", lambda some: seen.append(len(some)) or made(some))
    assert exact_metrics(placed, box(0, 0, 5, 110)).min_gap == pytest.approx(0.5)
    assert max(seen) <= 4 + 2
