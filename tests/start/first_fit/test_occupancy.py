"""Places found by bits are those that a look at every pixel finds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.ndimage import binary_dilation

from packwork.arrays import BoolArray
from packwork.fields.distance_transform import distance_inside
from packwork.geometry.outline import Outline
from packwork.start.first_fit.kernels import row_bits
from packwork.start.first_fit.occupancy import TALLEST, Occupancy, Stencil, covered, cut, stencil_of

REACH = 2


def _stencil(mask: BoolArray) -> Stencil:
    return stencil_of(mask, (0, 0), REACH)


def _touching(mask: BoolArray, free: BoolArray, row: int, column: int) -> float | None:
    """Share of the fringe's pixels that are taken; None if the mask meets a taken pixel."""
    taken = np.pad(~free, REACH, constant_values=True)
    here = np.zeros_like(taken)
    height, width = mask.shape
    top, left = row + REACH, column + REACH
    if row + height > free.shape[0] or column + width > free.shape[1]:
        return None
    here[top : top + height, left : left + width] = mask
    if (here & taken).any():
        return None
    away = np.linalg.norm(np.mgrid[-REACH : REACH + 1, -REACH : REACH + 1], axis=0)
    fringe = binary_dilation(here, away**2 <= REACH**2 + REACH) & ~here
    return float(taken[fringe].mean())


def _random(seed: int, width: int, open_share: float = 0.97) -> tuple[BoolArray, BoolArray]:
    rng = np.random.default_rng(seed)
    free = rng.random((24, width)) < open_share
    mask = rng.random((rng.integers(1, 6), rng.integers(1, 12))) < 0.8
    mask[0, 0] = mask[-1, -1] = True
    return free, mask


@pytest.mark.parametrize("width", [20, 64, 70, 130])
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_best_place_is_that_of_a_look_at_all(seed: int, width: int) -> None:
    free, mask = _random(seed, width)
    place = Occupancy(free, REACH).best_place(_stencil(mask), np.zeros(free.shape))
    assert place is not None
    score, row, column = place
    scores = {
        (y, x): found
        for y in range(free.shape[0])
        for x in range(width)
        if (found := _touching(mask, free, y, x)) is not None
    }
    assert scores, "a case without a place says nothing"
    assert score == pytest.approx(max(scores.values()))
    assert scores[row, column] == pytest.approx(score)


@pytest.mark.parametrize("pull", [0.3, 1.0, 5.0])
@pytest.mark.parametrize("open_share", [0.97, 0.9995])
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_field_draws_to_where_it_is_worth_most(seed: int, open_share: float, pull: float) -> None:
    free, mask = _random(seed, 70, open_share)
    field = np.random.default_rng(seed).random(free.shape)
    noise = np.zeros(free.shape)
    place = Occupancy(free, REACH).best_place(_stencil(mask), noise, True, field, pull)
    scores = {
        (y, x): found + pull * field[y, x]
        for y in range(free.shape[0])
        for x in range(70)
        if (found := _touching(mask, free, y, x)) is not None
    }
    assert place is not None
    assert place[0] == pytest.approx(max(scores.values()))
    assert scores[place[1:]] == pytest.approx(place[0])


@pytest.mark.parametrize("away", range(REACH + 2))
def test_a_place_so_far_from_what_is_taken_touches_as_much_as_a_look_tells(away: int) -> None:
    free, mask = np.ones((24, 70), dtype=bool), np.ones((3, 4), dtype=bool)
    free[12, 20:23] = False
    row, column = 13 + away, 21
    worth = np.full(free.shape, -np.inf)
    worth[row, column] = 0.0
    place = Occupancy(free, REACH).best_place(_stencil(mask), worth, True)
    assert place == (pytest.approx(_touching(mask, free, row, column)), row, column)


def test_what_is_put_meets_nothing_until_nothing_fits() -> None:
    free, mask = _random(5, 70)
    occupancy, left, count = Occupancy(free, REACH), free.copy(), 0
    while (place := occupancy.best_place(_stencil(mask), np.zeros(free.shape))) is not None:
        _, row, column = place
        here = left[row : row + mask.shape[0], column : column + mask.shape[1]]
        assert here[mask].all()
        here[mask] = False
        occupancy.take(mask, row, column)
        count += 1
    assert count > 10
    assert all(_touching(mask, left, y, x) is None for y in range(24) for x in range(70))


@pytest.mark.parametrize("is_everywhere", [False, True])
def test_an_origin_comes_only_where_it_may(is_everywhere: bool) -> None:
    free = np.ones((20, 70), dtype=bool)
    worth = np.full(free.shape, -np.inf)
    worth[9, 65] = worth[1, 30] = 0.0
    mask = np.ones((3, 4), dtype=bool)
    stencil = stencil_of(mask, (1, 2), REACH)
    occupancy = Occupancy(free, REACH)
    found = []
    while (place := occupancy.best_place(stencil, worth, is_everywhere)) is not None:
        found.append(place[1:])
        occupancy.take(stencil.mask, *place[1:])
    # What touches nothing is looked at only if asked.
    assert found == ([(0, 28), (8, 63)] if is_everywhere else [(0, 28)])


def test_what_lies_off_the_occupancy_is_not_kept() -> None:
    occupancy = Occupancy(np.ones((5, 5), dtype=bool), REACH)
    before = int(occupancy.taken.sum())
    occupancy.take(np.ones((3, 3), dtype=bool), -2, 4)
    assert int(occupancy.taken.sum()) == before + 1
    occupancy.take(np.ones((3, 3), dtype=bool), 9, 9)
    assert int(occupancy.taken.sum()) == before + 1


@given(st.integers(0, 2**32), st.integers(1, 200))
def test_smeared_rows_tell_of_any_pixel_within_their_box(seed: int, width: int) -> None:
    rng = np.random.default_rng(seed)
    taken = rng.random((12, width)) < 0.05
    occupancy = Occupancy(~taken, 1)
    # What is taken later is smeared upwards too.
    occupancy.take(np.ones((2, 1), dtype=bool), 9, width // 2)
    taken[9:11, width // 2] = True
    beyond = np.pad(taken, ((0, 0), (0, 600)), constant_values=True)
    rows = occupancy._rows[..., : -(-width // 64)].copy()
    bits = np.unpackbits(rows.view(np.uint8), axis=-1, bitorder="little")[..., :width]
    for tall in range(TALLEST + 1):
        for level in range(bits.shape[1]):
            y, x = rng.integers(12), rng.integers(width)
            want = beyond[y : y + 2**tall, x : x + 2**level].any()
            assert bool(bits[tall, level, y, x]) == want


@given(st.integers(0, 2**32))
def test_places_beside_spans_are_kept_only_where_there_are_no_others(seed: int) -> None:
    rng = np.random.default_rng(seed)
    free = rng.random((40, 192)) < rng.choice([0.01, 0.3, 1.0])
    height, width = map(int, rng.integers(1, 30, size=2))
    gap = min(height, width)
    first = rng.integers(-5, (40, 192), size=(rng.integers(5), 2))
    end = first + rng.integers(1, 70, size=first.shape)
    apart = free.copy()
    for (top, left), (bottom, right) in zip(first, end, strict=True):
        rows = slice(max(top - height - gap, 0), bottom + gap)
        apart[rows, max(left - width - gap, 0) : right + gap] = False
    bits = np.packbits(free, axis=1, bitorder="little").view("<u8")
    spans = np.stack([first[:, 0], end[:, 0], first[:, 1], end[:, 1]], axis=1)
    assert row_bits.keep_off(spans, height, width, bits) == apart.any()
    found = np.unpackbits(bits.view(np.uint8), axis=1, bitorder="little").astype(bool)
    assert (found == (apart if apart.any() else free)).all()


@given(st.integers(0, 2**32))
def test_boxes_cover_a_mask_and_nothing_else(seed: int) -> None:
    rng = np.random.default_rng(seed)
    mask = rng.random(rng.integers(1, 40, size=2)) < rng.choice([0.5, 0.95, 1.0])
    found = np.zeros_like(mask)
    for row, first, tall, wide, j, k in row_bits.boxes_of(mask, TALLEST, 4):
        found[row : row + tall, first : first + wide] = True
        # Two of these heights and widths cover the box.
        assert 2**j <= tall <= 2 ** (j + 1)
        assert j <= TALLEST
        assert 2**k <= wide <= 2 ** (k + 1)
        assert k <= 4
    assert (found == mask).all()


@pytest.mark.parametrize(
    ("margin", "is_quick"),
    [(0.3, False), (1.0, False), (2.0, False), (3.0, False), (2.0, True), (3.0, True), (9.0, True)],
)
def test_a_margin_takes_what_is_near_the_outline(margin: float, is_quick: bool) -> None:
    """All that a buffer covers, and not much more; holes get smaller."""
    tall = np.array([[0.0, 0], [20, 0], [20, 30], [12, 30], [12, 8], [8, 8], [8, 30], [0, 30]])
    hole = np.array([[2.0, 2], [2, 6], [6, 6], [6, 2]])
    outline = Outline.from_rings([tall + 0.25, hole + 0.25])
    mask, origin = covered(outline, margin, is_quick)
    want = cut(Outline.from_region(outline.region.buffer(margin)), 1)
    down, along = np.subtract(origin, want.origin)
    grown = np.zeros_like(mask)
    height, width = want.mask.shape
    grown[down : down + height, along : along + width] = want.mask
    assert not (grown & ~mask).any()
    assert np.count_nonzero(mask) <= 1.1 * np.count_nonzero(grown)


@pytest.mark.parametrize("width", [20, 64, 130, 400])
def test_whole_rows_are_cleared_as_parts_of_them_are(width: int) -> None:
    rng = np.random.default_rng(width)
    free = rng.random((row_bits.BLOCK * 3 + 5, width)) < 0.995
    free[40:80] = False
    mask = rng.random((7, min(width // 2, 90))) < 0.5
    mask[0, 0] = True
    occupancy, stencil = Occupancy(free, REACH), _stencil(mask)
    for top, bottom in ((0, len(free)), (3, 60), (90, len(free)), (5, 9)):
        found = occupancy.free_places(stencil, top, bottom)
        want = np.full((bottom - top, found.shape[1] - 1), row_bits.ALL)
        row_bits.clear_taken(occupancy._rows, stencil.boxes, 7, top, bottom, 0, want)
        assert (found[:, :-1] == want).all()
        assert not found[:, -1].any()
    assert occupancy.free_places(stencil).any()


def test_clearance_is_kept_up() -> None:
    free, mask = _random(3, 70)
    occupancy = Occupancy(free, REACH)
    assert occupancy.clearance.distances.shape == free.shape
    for _ in range(8):
        place = occupancy.best_place(
            _stencil(mask), occupancy.clearance.distances, is_everywhere=True
        )
        assert place is not None
        occupancy.take(mask, *place[1:])
    inner = occupancy.taken[REACH:-REACH, REACH:-REACH] == 0
    assert occupancy.clearance.distances == pytest.approx(distance_inside(inner))
