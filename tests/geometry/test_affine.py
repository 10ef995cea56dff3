"""Affine maps: composition, similarity, and the way of turning."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.geometry import affine

numbers = st.floats(-50, 50)
maps = st.lists(numbers, min_size=6, max_size=6).map(lambda m: np.array(m).reshape(2, 3))
clouds = st.lists(st.tuples(numbers, numbers), min_size=1, max_size=5).map(np.array)


@given(outer=maps, inner=maps, points=clouds)
def test_composing_is_applying_one_after_the_other(
    outer: np.ndarray, inner: np.ndarray, points: np.ndarray
) -> None:
    together = affine.apply(affine.compose(outer, inner), points)
    np.testing.assert_allclose(
        together, affine.apply(outer, affine.apply(inner, points)), atol=1e-8
    )


@given(first=maps, second=maps, third=maps)
def test_composing_is_associative(first: np.ndarray, second: np.ndarray, third: np.ndarray) -> None:
    left = affine.compose(affine.compose(first, second), third)
    right = affine.compose(first, affine.compose(second, third))
    np.testing.assert_allclose(left, right, atol=1e-6)


@given(matrix=maps)
def test_identity_is_neutral(matrix: np.ndarray) -> None:
    np.testing.assert_array_equal(affine.compose(matrix, affine.identity()), matrix)
    np.testing.assert_array_equal(affine.compose(affine.identity(), matrix), matrix)


@given(x=numbers, y=numbers, angle=st.floats(-7, 7), scale=st.floats(0.01, 100))
def test_similarities_scale_every_distance_alike_and_do_not_mirror(
    x: float, y: float, angle: float, scale: float
) -> None:
    matrix = affine.similarity(x, y, angle, scale)
    assert np.linalg.det(matrix[:, :2]) == pytest.approx(scale**2)
    np.testing.assert_allclose(
        matrix[:, :2].T @ matrix[:, :2], scale**2 * np.eye(2), atol=1e-9 * scale**2
    )
    assert affine.apply(matrix, np.zeros((1, 2))).tolist() == [[x, y]]


@given(ratio=st.floats(0.01, 100))
def test_stretching_keeps_areas_and_makes_squares_as_wide_as_said(ratio: float) -> None:
    matrix = affine.stretched(ratio)
    wide, high = affine.apply(matrix, np.ones((1, 2)))[0]
    assert wide * high == pytest.approx(1.0)
    assert wide / high == pytest.approx(ratio)
    back = affine.compose(affine.stretched(1 / ratio), matrix)
    np.testing.assert_allclose(back, affine.identity(), atol=1e-12)


def test_positive_turns_are_clockwise_on_screen() -> None:
    quarter = affine.similarity(0, 0, np.pi / 2, 1.0)
    right = np.array([[1.0, 0.0]])
    np.testing.assert_allclose(affine.apply(quarter, right), [[0.0, 1.0]], atol=1e-15)


def test_composing_leaves_its_arguments_alone() -> None:
    outer, inner = affine.similarity(1, 2, 0.3, 4), affine.similarity(5, 6, 0.7, 8)
    before = outer.copy(), inner.copy()
    affine.compose(outer, inner)
    np.testing.assert_array_equal(outer, before[0])
    np.testing.assert_array_equal(inner, before[1])
