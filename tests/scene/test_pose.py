"""Poses as maps: what a stretch does, and what was never asked for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from packwork.errors import ShapeError
from packwork.geometry import affine
from packwork.scene.pose import Poses
from scenes import poses


def test_a_point_is_stretched_then_turned_then_moved() -> None:
    where = poses([7.0], [5.0], np.pi / 2, 3.0, 4.0)
    # (1, 0) is 6 to the right, then 6 below; (0, 1) is 1.5 below, then 1.5 to the left.
    moved = affine.apply(where.matrix(0), np.array([[1.0, 0.0], [0.0, 1.0]]))
    np.testing.assert_allclose(moved, [[7.0, 11.0], [5.5, 5.0]], atol=1e-12)


def test_areas_do_not_depend_on_the_stretch() -> None:
    where = poses(np.zeros(3), 0.0, 0.4, 3.0, [0.2, 1.0, 7.0])
    assert [np.linalg.det(where.matrix(k)[:, :2]) for k in range(3)] == pytest.approx([9.0] * 3)
    np.testing.assert_allclose(where.axis_scales.prod(axis=1), 9.0)


def test_without_a_stretch_all_keep_their_proportions() -> None:
    two = np.array([1.0, 2.0])
    assert Poses(two, two, two, two).stretch.tolist() == [1.0, 1.0]


def test_what_replaces_a_place_keeps_the_stretch() -> None:
    where = poses([1.0, 2.0], 0.0, 0.0, 1.0, [2.0, 3.0])
    assert replace(where, x=where.y).stretch.tolist() == [2.0, 3.0]


@pytest.mark.parametrize("count", [1, 3])
def test_one_stretch_for_each_item_or_none(count: int) -> None:
    two = np.ones(2)
    with pytest.raises(
        ShapeError, match=rf"as many numbers of stretch as of x \(2\), not \({count},\)"
    ):
        Poses(two, two, two, two, np.ones(count))
