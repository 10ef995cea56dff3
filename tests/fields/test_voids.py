"""Clearance of pixels, and relocation into voids."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from packwork.arrays import BoolArray, FloatArray
from packwork.fields.distance_transform import distance_inside
from packwork.fields.voids import Clearance, largest_voids
from strategies import generators

masks = arrays.arrays(np.bool_, st.tuples(st.integers(1, 12), st.integers(1, 12)))


discs = st.lists(
    st.tuples(st.floats(-4, 16), st.floats(-4, 16), st.floats(0, 5)), min_size=1, max_size=6
)


def _centres(shape: tuple[int, int]) -> FloatArray:
    rows, columns = np.indices(shape)
    return np.asarray(np.stack([columns, rows], axis=-1) + 0.5)


def _brute_distance(mask: BoolArray) -> FloatArray:
    """From each True pixel's centre to the nearest False one's, less half a pixel."""
    padded = np.pad(mask, 1)
    outside = _centres(padded.shape)[~padded] - 1
    away = np.linalg.norm(_centres(mask.shape)[:, :, None] - outside, axis=-1).min(axis=-1)
    return np.where(mask, away - 0.5, 0.0)


@given(mask=masks)
def test_distance_inside_equals_brute_force(mask: BoolArray) -> None:
    np.testing.assert_allclose(distance_inside(mask), _brute_distance(mask), atol=1e-12)


@given(mask=masks)
def test_distance_inside_is_that_to_the_edge_within_a_pixels_corner(mask: BoolArray) -> None:
    """Centres stand for squares: exact beside an edge, too long beside a corner."""
    padded = np.pad(mask, 1)
    outside = _centres(padded.shape)[~padded] - 1
    gaps = np.abs(_centres(mask.shape)[:, :, None] - outside) - 0.5
    edge = np.linalg.norm(np.maximum(gaps, 0), axis=-1).min(axis=-1)
    excess = (distance_inside(mask) - edge)[mask]
    assert (excess >= -1e-12).all()
    assert (excess <= np.sqrt(0.5) - 0.5 + 1e-12).all()


@given(mask=masks, taken=discs)
def test_room_equals_brute_force_after_every_disc(
    mask: BoolArray, taken: list[tuple[float, float, float]]
) -> None:
    room = Clearance(mask)
    expected = np.where(mask, _brute_distance(mask), -np.inf)
    for x, y, radius in [*taken, (0.0, 0.0, 0.0)]:
        column, row, largest = room.largest()
        assert largest == pytest.approx(float(expected.max()), abs=1e-9)
        assert expected[int(row), int(column)] == pytest.approx(largest, abs=1e-9)
        room.occupy(x, y, radius)
        away = np.linalg.norm(_centres(mask.shape) - [x, y], axis=-1)
        expected = np.minimum(expected, away - radius)


def test_discs_placed_where_there_is_most_room_do_not_meet() -> None:
    room = Clearance(np.ones((24, 30), dtype=bool))
    placed: list[tuple[float, float, float]] = []
    for _ in range(12):
        x, y, radius = room.largest()
        for other_x, other_y, other in placed:
            assert np.hypot(x - other_x, y - other_y) >= radius + other - 1e-9
        placed.append((x, y, radius))
        room.occupy(x, y, radius)
    assert [r for _, _, r in placed] == sorted((r for _, _, r in placed), reverse=True)


def test_no_room_is_said_so() -> None:
    assert Clearance(np.zeros((3, 4), dtype=bool)).largest()[2] == -np.inf
    room = Clearance(np.ones((4, 4), dtype=bool))
    room.occupy(2.0, 2.0, 50.0)
    assert room.largest()[2] < 0


@given(mask=masks, rng=generators())
def test_the_roomiest_of_some_pixels_is_their_maximum(
    mask: BoolArray, rng: np.random.Generator
) -> None:
    room = Clearance(mask)
    all_of_them = np.arange(mask.size)
    assert room.largest_among(all_of_them) == room.largest()
    some = np.sort(rng.choice(all_of_them, size=(mask.size + 1) // 2, replace=False))
    x, y, radius = room.largest_among(some)
    assert int(y) * mask.shape[1] + int(x) in some
    of_each = [room.largest_among(np.array([pixel]))[2] for pixel in some]
    assert radius == max(of_each)


def _room(side: int = 40) -> Clearance:
    return Clearance(np.ones((side, side), dtype=bool))


def test_each_item_in_turn_takes_the_largest_void_that_is_left() -> None:
    radii = {4: 9.0, 2: 5.0, 7: 3.0}
    found = list(largest_voids(_room(), radii, lambda item, _: radii[item]))
    assert [void.item for void in found] == [4, 2, 7]
    assert [void.radius for void in found] == sorted((v.radius for v in found), reverse=True)
    for k, one in enumerate(found):
        for other in found[:k]:
            apart = np.hypot(one.x - other.x, one.y - other.y)
            assert apart >= radii[other.item] + one.radius - 1


def test_what_is_taken_may_depend_on_the_void() -> None:
    room = Clearance(np.ones((9, 30), dtype=bool))
    found = list(largest_voids(room, range(9), lambda _, radius: radius, least_px=1.0))
    assert found[0].radius == 4.5
    assert len(found) > 1
    assert all(void.radius >= 1.0 for void in found)


def test_it_ends_without_a_void_but_for_items_bound_to_pixels() -> None:
    bound = {1: np.array([0]), 3: np.array([39])}
    found = largest_voids(_room(), [1, 1, 3, 2, 0], lambda *_: 30.0, least_px=0.1, among=bound.get)
    # The second cannot have the pixel that the first has; the fourth finds nothing at all.
    assert [void.item for void in found] == [1, 3, 2]


def test_without_a_least_void_items_lie_where_they_overlap_least() -> None:
    assert len(list(largest_voids(_room(9), range(4), lambda *_: 9.0))) == 4
