"""Containers on canvases of other sizes and units, and the poses that follow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from packwork.scene.container import Container, brought_over, on_canvas
from packwork.units import canvas_size
from scenes import box, poses, square_container


@pytest.fixture
def wide() -> Container:
    """A box on a canvas twice as wide as high, off its middle."""
    return Container("wide", "wide", box(10, 10, 30, 20), 80.0, 40.0)


@pytest.mark.parametrize(
    ("size", "canvas", "bounds"),
    [
        ("160", (160, 80, "px"), (20, 20, 60, 40)),
        ("8cm", (8, 4, "cm"), (1, 1, 3, 2)),
        ("200x150mm", (200, 150, "mm"), (25, 50, 75, 75)),
        ("40x80in", (40, 80, "in"), (5, 35, 15, 40)),
    ],
)
def test_the_canvas_of_the_container_is_fitted_and_centred(
    wide: Container, size: str, canvas: tuple[float, float, str], bounds: tuple[float, ...]
) -> None:
    placed = on_canvas(wide, canvas_size(size))
    assert (placed.width, placed.height, placed.unit) == canvas
    assert placed.outline.bounds == pytest.approx(bounds)


def test_no_size_leaves_the_container_as_it_is(wide: Container) -> None:
    assert on_canvas(wide, None) is wide


def test_the_same_canvas_moves_nothing(wide: Container) -> None:
    again = on_canvas(wide, canvas_size("80x40"))
    np.testing.assert_array_equal(again.outline.points, wide.outline.points)


@pytest.mark.parametrize("size", ["8cm", "200x150mm", "150x200mm", "0.5in"])
def test_poses_follow_their_container(size: str) -> None:
    old = square_container(100.0, 5.0)
    new = on_canvas(old, canvas_size(size))
    before = poses([20.0, 80.0], [30.0, 60.0], 0.5, [2.0, 3.0])
    after = brought_over(before, old, new)
    scale = new.outline.extent / old.outline.extent
    np.testing.assert_allclose(after.scale, before.scale * scale)
    np.testing.assert_array_equal(after.angle, before.angle)
    left, top, *_ = new.outline.bounds
    np.testing.assert_allclose(after.x - left, (before.x - 5.0) * scale)
    np.testing.assert_allclose(after.y - top, (before.y - 5.0) * scale)


def test_poses_on_a_canvas_of_the_same_size_stay_to_the_bit() -> None:
    old = square_container(100.0, 5.0)
    before = poses([20.0, 80.0], [30.0, 60.0])
    assert brought_over(before, old, replace(old, outline=box(1, 1, 9, 9))) is before


def test_there_and_back_is_where_it_was() -> None:
    old = square_container(100.0, 5.0)
    new = on_canvas(old, canvas_size("A4-landscape"))
    before = poses([20.0, 80.0], [30.0, 60.0], 0.5, [2.0, 3.0])
    again = brought_over(brought_over(before, old, new), new, old)
    for name in ("x", "y", "scale"):
        np.testing.assert_allclose(getattr(again, name), getattr(before, name), rtol=1e-12)
