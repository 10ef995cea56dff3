"""Distances, components and ways inside regions against SciPy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from scipy import ndimage

from packwork.arrays import BoolArray
from packwork.fields.distance_transform import distance_to, label_components, lengthwise, nearest_to
from packwork.fields.morphology import eroded

masks = arrays.arrays(np.bool_, st.tuples(st.integers(1, 14), st.integers(1, 14)))


SHARES = (0.01, 0.2, 0.5, 0.99)


@given(mask=masks.filter(np.any))
def test_distances_and_the_choice_among_nearest_pixels_are_those_of_scipy(mask: BoolArray) -> None:
    distance, nearest = ndimage.distance_transform_edt(~mask, return_indices=True)
    np.testing.assert_array_equal(distance_to(mask), distance)
    np.testing.assert_array_equal(np.stack(nearest_to(mask)), nearest)


@pytest.mark.parametrize("share", SHARES)
def test_so_they_are_of_a_large_image_of_any_density(share: float) -> None:
    mask = np.random.default_rng(0).random((300, 200)) < share
    distance, nearest = ndimage.distance_transform_edt(~mask, return_indices=True)
    np.testing.assert_array_equal(distance_to(mask), distance)
    np.testing.assert_array_equal(np.stack(nearest_to(mask)), nearest)


def test_nothing_is_near_to_nothing() -> None:
    assert np.isinf(distance_to(np.zeros((2, 3), dtype=bool))).all()


def test_a_mask_may_lie_in_memory_as_it_likes() -> None:
    mask = np.random.default_rng(0).random((20, 30)) < SHARES[0]
    np.testing.assert_array_equal(distance_to(mask.T), distance_to(mask).T)
    np.testing.assert_array_equal(distance_to(mask[::2, ::3]), distance_to(mask[::2, ::3].copy()))


@given(mask=masks)
def test_parts_are_those_of_scipy(mask: BoolArray) -> None:
    labels, count = label_components(mask)
    np.testing.assert_array_equal(labels, ndimage.label(mask)[0])
    assert count == labels.max()


@given(mask=masks, steps=st.integers(1, 3))
def test_an_erosion_is_that_of_scipy(mask: BoolArray, steps: int) -> None:
    np.testing.assert_array_equal(
        eroded(mask, steps), ndimage.binary_erosion(mask, iterations=steps)
    )


def test_it_rises_along_a_bent_corridor() -> None:
    mask = np.zeros((30, 40), dtype=bool)
    mask[2:6, 2:38] = True
    mask[2:28, 34:38] = True
    mask[24:28, 8:38] = True
    away = lengthwise(mask)
    assert np.isnan(away[10, 10])
    ends = sorted([away[4, 2], away[26, 8]])
    assert ends[0] < 5
    assert ends[1] > 70
    middle = away[4, 20], away[4, 36], away[15, 36], away[26, 30]
    steps = np.diff(middle) * (1 if away[4, 2] < away[26, 8] else -1)
    assert (steps > 5).all()


def test_a_straight_one_is_measured_by_its_pixels() -> None:
    assert lengthwise(np.ones((1, 9), dtype=bool)).tolist() == [list(range(9))]


def test_parts_follow_each_other_from_the_left() -> None:
    mask = np.ones((3, 11), dtype=bool)
    mask[:, 5] = False
    away = lengthwise(mask)
    assert away[:, :5].max() < away[:, 6:].min()
