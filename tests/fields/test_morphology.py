"""The middle line: inside, thin, in every part, in the middle; thickness as by all openings."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from scipy import ndimage

from packwork.arrays import BoolArray
from packwork.fields.morphology import STEPS, Thickness, _removable, medial_axis, thickness

masks = arrays.arrays(np.bool_, st.tuples(st.integers(1, 14), st.integers(1, 14)))
EIGHT = np.ones((3, 3))
CLOCKWISE = [(1, 0), (1, -1), (0, -1), (-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1)]
"""Shifts that bring each neighbour to its pixel, from the one above on."""


@given(mask=masks)
def test_the_axis_is_inside_and_in_as_many_pieces_as_the_region(mask: BoolArray) -> None:
    axis = medial_axis(mask)
    assert axis.shape == mask.shape
    assert not (axis & ~mask).any()
    parts, count = ndimage.label(mask, EIGHT)
    assert set(np.unique(parts[axis])) == set(range(1, count + 1))
    assert ndimage.label(axis, EIGHT)[1] == count


@given(mask=masks)
def test_the_axis_is_what_turns_over_all_pixels_leave(mask: BoolArray) -> None:
    image, removable, unchanged = np.pad(mask, 2).astype(int), _removable(), 0
    turn = 0
    while unchanged < 2:
        around = [np.roll(image, shift, (0, 1)) for shift in CLOCKWISE]
        code = sum(one << bit for bit, one in enumerate(around))
        goes = (image == 1) & removable[turn][code]
        image[goes], turn = 0, 1 - turn
        unchanged = 0 if goes.any() else unchanged + 1
    np.testing.assert_array_equal(medial_axis(mask), image[2:-2, 2:-2])


@pytest.mark.parametrize("width", [5, 9, 15])
def test_a_strip_has_its_axis_half_way_whether_or_not_it_touches_the_image(width: int) -> None:
    alone = medial_axis(np.ones((width, 60), dtype=bool))
    framed = medial_axis(np.pad(np.ones((width, 60), dtype=bool), 3))
    np.testing.assert_array_equal(alone, framed[3:-3, 3:-3])
    rows = np.nonzero(alone[:, width:-width])[0]
    assert np.abs(rows - width // 2).max() <= 1
    assert (alone[:, width:-width].sum(axis=0) == 1).all()


def test_a_ring_keeps_its_hole() -> None:
    away = np.hypot(*(np.indices((60, 60)) - 29.5))
    axis = medial_axis((away > 15) & (away < 27))
    np.testing.assert_allclose(away[axis], 21, atol=1.5)
    assert ndimage.label(~axis)[1] == 2


@given(
    shares=st.lists(st.integers(0, 40), min_size=6, max_size=9).map(sorted),
    missing=st.integers(-1, 41) | st.integers(5, 20),
    radius_px=st.floats(0.4, 20.0),
)
def test_thickness_is_that_of_all_radii(shares: list[int], missing: int, radius_px: float) -> None:
    radii = np.geomspace(0.5, 16.0, len(shares))
    found = Thickness(radii, shares.__getitem__)
    over = np.flatnonzero(np.array(shares) > missing)
    if len(over) in {0, len(shares)}:
        expected = radii[-1 if len(over) == 0 else 0]
    else:
        about = [over[0] - 1, over[0]]
        logs = np.interp(missing, np.take(shares, about), np.log(radii[about]))
        expected = np.exp(logs)
    assert found.radius_for(missing) == pytest.approx(expected)
    wanted = np.interp(np.log(radius_px), np.log(radii), shares)
    assert found.missing_for(radius_px) == pytest.approx(wanted)


def test_few_openings_are_made() -> None:
    away = np.hypot(*(np.indices((60, 60)) - 29.5))
    made = list[int]()
    found = thickness(away < 25, 2.0)
    counted = Thickness(found.radii_px, lambda k: made.append(k) or found.missing_at(k))  # type: ignore[func-returns-value]
    assert 15 < counted.radius_for(0.02) < 26
    assert len(set(made)) < STEPS / 2
