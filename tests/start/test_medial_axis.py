"""The start along the middle line, on containers that make it hard."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.arrays import FloatArray
from packwork.fields.distance_transform import distance_inside
from packwork.start.places import medial_axis


def wedge(rows: int = 60, columns: int = 160) -> FloatArray:
    """Strip that grows from nothing to its full height, left to right."""
    row, column = np.indices((rows, columns)) + 0.5
    return np.asarray(np.abs(row - rows / 2) < rows / 2 * column / columns, dtype=np.float64)


def round_image(side: int = 100) -> FloatArray:
    away = np.hypot(*(np.indices((side, side)) + 0.5 - side / 2))
    return np.asarray(away < side / 2, dtype=np.float64)


def test_larger_items_sit_where_the_container_is_wider() -> None:
    radii = np.linspace(4.0, 20.0, 7)
    x, y = medial_axis(wedge(), 1.0, radii, np.random.default_rng(0))
    widths = distance_inside(wedge() > 0.5)[y.astype(int), x.astype(int)]
    assert np.argmax(widths) == np.argmax(radii)
    assert np.corrcoef(radii, widths)[0, 1] > 0.8


def test_items_of_a_strip_line_up_along_its_axis_and_keep_apart() -> None:
    x, y = medial_axis(np.ones((20, 200)), 0.5, np.full(8, 20.0), np.random.default_rng(0))
    assert np.abs(y - 20).max() < 5
    assert np.diff(np.sort(x)).min() > 34


@pytest.mark.parametrize("count", [40, 400])
def test_a_round_container_does_not_collapse_onto_its_short_axis(count: int) -> None:
    radii = np.full(count, 0.8 * 50 / np.sqrt(count))
    x, y = medial_axis(round_image(), 1.0, radii, np.random.default_rng(0))
    away = np.hypot(x - 50, y - 50)
    assert np.mean(away < 25) < 0.4
    quarters = np.histogram2d(x, y, bins=2, range=[[0, 100], [0, 100]])[0]
    assert quarters.min() > 0.5 * count / 4


def test_many_more_items_than_axis_pixels_get_places_of_their_own() -> None:
    image = np.zeros((12, 40))
    image[4:7, 5:35] = 1
    x, y = medial_axis(image, 1.0, np.full(60, 0.5), np.random.default_rng(0))
    assert len(np.unique(np.column_stack([x, y]).astype(int), axis=0)) > 40
    assert image[y.astype(int), x.astype(int)].all()


def test_every_part_of_a_container_gets_items() -> None:
    image = np.zeros((30, 90))
    for left in (0, 30, 60):
        image[5:25, left + 5 : left + 25] = 1
    x, _ = medial_axis(image, 1.0, np.full(6, 4.0), np.random.default_rng(0))
    assert np.bincount((x // 30).astype(int), minlength=3).tolist() == [2, 2, 2]


@pytest.mark.parametrize("shape", [(1, 1), (2, 2), (2, 9)])
def test_a_few_pixels_are_enough(shape: tuple[int, int]) -> None:
    x, y = medial_axis(np.ones(shape), 0.1, np.full(50, 30.0), np.random.default_rng(0))
    assert ((x >= 0) & (x <= 10 * shape[1]) & (y >= 0) & (y <= 10 * shape[0])).all()
