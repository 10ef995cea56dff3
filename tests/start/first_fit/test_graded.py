"""Items as large as they find a place, in the order of their weights."""

from __future__ import annotations

from functools import cache
from itertools import combinations

import numpy as np
import pytest

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.readers.builtin import builtin_container, builtin_item
from packwork.scene.container import Container
from packwork.start.first_fit.between import fit_between
from packwork.start.first_fit.graded import Graded, graded_fit, sizes_down
from packwork.start.first_fit.greedy_board import Candidate
from scenes import box


def shapes(count: int) -> list[Outline]:
    return [builtin_item(("star", "heart", "square")[k % 3]).outline for k in range(count)]


@cache
def put(count: int = 40, **options: float) -> tuple[Container, Graded]:
    container = builtin_container("heart")
    asked = [Candidate(one, 0.97 if k else 4.0, (0.0, 0.5)) for k, one in enumerate(shapes(count))]
    return container, graded_fit(container, asked, count, np.random.default_rng(1), **options)


@pytest.mark.parametrize("margin", [0.0, 4.0])
def test_nothing_overlaps_or_sticks_out(margin: float) -> None:
    container, found = put(margin_cu=margin)
    every = shapes(40)
    placed = [
        every[k].mapped(found.poses.matrix(position)).region
        for position, k in enumerate(found.placed)
    ]
    assert len(placed) > 30
    assert all(container.outline.region.contains(one) for one in placed)
    wall = container.outline.region.boundary
    assert all(one.distance(wall) >= margin for one in placed)
    assert all(one.distance(other) > margin for one, other in combinations(placed, 2))


def test_ranks_never_cross() -> None:
    _, found = put()
    assert (np.diff(found.poses.scale) <= 0).all()
    assert (found.poses.scale[1:] <= 0.97 * found.poses.scale[:-1] * (1 + 1e-12)).all()


def test_a_grid_and_a_least_size_hold() -> None:
    _, found = put(smallest=0.3, grid=0.1)
    assert found.poses.scale.min() >= 0.3 - 1e-9
    assert found.poses.scale / 0.1 == pytest.approx(np.round(found.poses.scale / 0.1))


def test_what_finds_no_place_is_left_out() -> None:
    _, found = put(count=60, smallest=1.0)
    assert 0 < len(found.placed) < 60
    assert len(found.poses) == len(found.placed)


def test_patience_ends_the_search() -> None:
    container = builtin_container("heart")
    read = []

    def asked() -> object:
        for k, one in enumerate(shapes(500)):
            read.append(k)
            yield Candidate(one, 1.0 if k else 3.0)

    graded_fit(container, asked(), 500, np.random.default_rng(1), smallest=2.9, patience=3)
    assert len(read) < 40


def test_one_seed_gives_one_answer() -> None:
    first, second = put()[1].poses, put.__wrapped__()[1].poses
    assert np.array_equal(first.x, second.x)
    assert np.array_equal(first.scale, second.scale)


def test_a_container_too_small_for_any_size_holds_nothing() -> None:
    assert len(put(smallest=100.0)[1].placed) == 0


def test_what_is_larger_than_the_canvas_comes_down_to_it() -> None:
    container = builtin_container("square")
    asked = [Candidate(builtin_item("square").outline, 1e3)]
    found = graded_fit(container, asked, 1, np.random.default_rng(1))
    [outline] = [asked[0].outline.mapped(found.poses.matrix(0))]
    assert container.outline.region.contains(outline.region)
    assert outline.area > 0.8 * container.outline.area


def test_sizes_end_at_the_least() -> None:
    assert sizes_down(1.0, 2.0) == []
    assert sizes_down(2.0, 2.0) == [2.0]
    assert min(sizes_down(3.0, 1.1)) == 1.1


def test_a_long_item_does_not_hold_all_later_ones_down(monkeypatch: pytest.MonkeyPatch) -> None:
    container = Container("", "", box(0, 0, 200, 100), 200.0, 100.0)
    square, bar = box(-1, -1, 1, 1), box(-9, -0.5, 9, 0.5)
    asked = [Candidate(square, 60.0), Candidate(square, 1.0), Candidate(bar, 1.0)]
    asked += [Candidate(square, 1.0)] * 7

    def scales() -> FloatArray:
        return graded_fit(container, asked, 10, np.random.default_rng(0)).poses.scale

    found = scales()
    monkeypatch.setattr("packwork.start.first_fit.graded.JAMMED", 0.0)
    held_down = scales()
    assert held_down[-1] < 0.1 * held_down[0]
    assert found[-1] > 3 * held_down[-1]
    assert (np.diff(found) <= 0).all()


@pytest.mark.parametrize("unit", [0.01, 1.0, 100.0])
def test_steps_go_on_through_items_that_find_no_place(unit: float) -> None:
    container = Container("", "", box(0, 0, 100 * unit, 100 * unit), 100 * unit, 100 * unit)
    square, bar = box(-1, -1, 1, 1), box(-40, -0.5, 40, 0.5)
    asked = [Candidate(bar, 20 * unit), Candidate(square, 0.5), Candidate(bar, 0.5)]
    asked += [Candidate(square, 0.8), Candidate(bar, 0.9), Candidate(square, 1.0)]
    found = graded_fit(container, asked, 6, np.random.default_rng(0), smallest=1.5 * unit)
    assert found.placed.tolist() == [1, 3, 5]
    assert found.poses.scale / unit == pytest.approx([10.0, 4.0, 3.6])


def test_the_unit_does_not_matter() -> None:
    """Also where some items are put a second time, and other numbers of them find a place."""
    square, bar = box(-1, -1, 1, 1), box(-18, -0.5, 18, 0.5)
    asked = [Candidate(square, 1.0), Candidate(bar, 1.0), *[Candidate(square, 1.0)] * 6]

    def placed(unit: float) -> Graded:
        container = Container("", "", box(0, 0, 200 * unit, 100 * unit), 200 * unit, 100 * unit)
        first = Candidate(square, 45 * unit)
        rng = np.random.default_rng(0)
        return graded_fit(container, [first, *asked], 9, rng, smallest=4 * unit)

    ours = placed(1.0)
    for unit in (2.0**-7, 2.0**7):
        other = placed(unit)
        assert other.placed.tolist() == ours.placed.tolist()
        assert other.poses.scale / unit == pytest.approx(ours.poses.scale)


def test_known_lengths_leave_room_for_the_last() -> None:
    """And no size rises again once there is more room than was thought."""
    container = Container("", "", box(0, 0, 100, 100), 100, 100)
    tiles = [Candidate(box(-1, -1, 1, 1), step) for step in (10.0, *[1.0] * 79)]
    rng = np.random.default_rng
    plain = graded_fit(container, tiles, 80, rng(0), smallest=1.5)
    held = graded_fit(container, tiles, 80, rng(0), smallest=1.5, lengths=[1.0] * 80)
    assert 2 * len(plain.placed) < len(held.placed)
    assert (np.diff(held.poses.scale) <= 0).all()


def test_where_all_cannot_be_placed_nothing_is_held_down() -> None:
    container = Container("", "", box(0, 0, 100, 100), 100, 100)
    tiles = [Candidate(box(-1, -1, 1, 1), step) for step in (12.0, *[1.0] * 399)]
    plain, held = (
        graded_fit(container, tiles, 400, np.random.default_rng(0), smallest=4.5, lengths=lengths)
        for lengths in ([], [1.0] * 400)
    )
    assert held.poses.scale.tolist() == plain.poses.scale.tolist()


def _unbounded(items: list[Outline]) -> FloatArray:
    container = Container("", "", box(0, 0, 200, 100), 200.0, 100.0)
    asked = [Candidate(one, 1.0 if k else 100.0) for k, one in enumerate(items)]
    rng = np.random.default_rng(0)
    found = graded_fit(container, asked, len(items), rng, is_first_bounded=False)
    assert len(found.placed) == len(items)
    return found.poses.scale


def test_a_first_item_of_any_size_leaves_the_next_ones_their_places() -> None:
    square, bar = box(-1, -1, 1, 1), box(-3, -0.5, 3, 0.5)
    for items in ([square] * 10, [square, bar] * 5, [bar, square, bar, *[square] * 7]):
        found = _unbounded(items)
        assert (np.diff(found) <= 0).all()
        two = _unbounded(items[:2])
        assert found[0] == pytest.approx(two[0])
    assert _unbounded([square])[0] > 45


def test_what_one_item_lacks_later_ones_have_again() -> None:
    """As far as asked for, and never more than the one before."""
    container = Container("", "", box(0, 0, 200, 100), 200.0, 100.0)
    square, bar = box(-1, -1, 1, 1), box(-9, -0.5, 9, 0.5)
    steps = [40.0, 0.9, *[0.7] * 6]
    asked = [Candidate(bar if k == 1 else square, step) for k, step in enumerate(steps)]

    def scales(regained: float) -> FloatArray:
        rng = np.random.default_rng(0)
        return graded_fit(container, asked, len(asked), rng, regained=regained).poses.scale

    none, half, all_of_it = scales(0.0), scales(0.5), scales(1.0)
    assert none[0] == half[0] == all_of_it[0]
    lacks = 0.9 * none[0] / none[1]
    assert lacks > 2
    assert none[2:] == pytest.approx(none[1] * 0.7 ** np.arange(1, 7))
    own = none[0] * 0.9 * 0.7 ** np.arange(1, 7)
    assert all_of_it[2:] == pytest.approx(np.minimum(own, all_of_it[1]))
    assert half[2:] == pytest.approx(np.minimum(own / lacks**0.5, half[1]))


@pytest.mark.parametrize("margin", [0.0, 0.05, 2.0])
def test_a_margin_takes_no_rows_of_pixels_more(margin: float) -> None:
    """A row of pixels all round each item wasted half the room of thousands of small words."""
    tile = box(-1.0, -1.0, 1.0, 1.0)
    container = Container("", "", box(0.0, 0.0, 100.0, 100.0), 100.0, 100.0)
    asked = [Candidate(tile, step) for step in (8.0, *[1.0] * 15)]
    found = graded_fit(container, asked, len(asked), np.random.default_rng(1), margin_cu=margin)
    regions = [tile.mapped(found.poses.matrix(k)).region for k in range(len(asked))]
    least = min(one.distance(other) for one, other in combinations(regions, 2))
    assert margin <= least < margin + 200 / 700


def meetings(found: Graded, tile: Outline, kinds: list[int]) -> int:
    """Pairs of one kind with less than half a height of the smaller one between them."""
    placed = [
        (kinds[k], scale, tile.mapped(found.poses.matrix(position)).region)
        for position, (k, scale) in enumerate(zip(found.placed, found.poses.scale, strict=True))
    ]
    return sum(
        kind == alike and one.distance(other) < min(scale, its)
        for (kind, scale, one), (alike, its, other) in combinations(placed, 2)
    )


def test_copies_of_a_word_stand_apart() -> None:
    container, tile = builtin_container("heart"), box(-3, -1, 3, 1)
    kinds = [k % 5 for k in range(60)]

    def met(has_kinds: bool) -> int:
        first = 0.03 * container.side
        asked = [
            Candidate(tile, 1.0 if k else first, kind=kind if has_kinds else None)
            for k, kind in enumerate(kinds)
        ]
        found = graded_fit(container, asked, 60, np.random.default_rng(1))
        assert sorted(found.placed) == list(range(60))
        return meetings(found, tile, kinds)

    assert 4 * met(has_kinds=True) < met(has_kinds=False)


def test_an_item_that_another_comes_before_takes_its_step_once() -> None:
    """The first of a rank stands beside its copy wherever it goes, the next does not."""
    container, tile = Container("", "", box(0, 0, 54, 54), 54.0, 54.0), box(-1, -1, 1, 1)
    steps, kinds = (10.0, 0.8, 1.0), "aab"
    asked = [Candidate(tile, step, kind=kind) for step, kind in zip(steps, kinds, strict=True)]
    found = graded_fit(container, asked, 3, np.random.default_rng(0))
    assert found.placed.tolist() == [0, 2, 1]
    assert found.poses.scale == pytest.approx([10.0, 8.0, 8.0])


def test_copies_between_others_stand_apart_from_those_too() -> None:
    container, tile = builtin_container("circle"), box(-3, -1, 3, 1)
    middle = 0.5 * container.side
    lying = [tile.mapped(np.array([[60.0, 0, middle], [0, 60.0, middle]]))]
    asked = [Candidate(tile, 20.0, kind=kind) for kind in range(4)]
    least, rng = np.full(4, 10.0), np.random.default_rng(0)
    found = fit_between(container, lying, asked, least, rng, kinds=[0], most=12)
    copies = [
        tile.mapped(found.poses.matrix(position)).region
        for position in np.flatnonzero(found.placed == 0)
    ]
    assert copies
    assert min(one.distance(lying[0].region) for one in copies) > 10.0
