"""The greedy start: largest first, where there is most room."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.arrays import FloatArray
from packwork.start.places import distance_field
from strategies import generators


def disc_image(side: int) -> FloatArray:
    """Mask of a disc as wide as the image."""
    away = np.hypot(*(np.indices((side, side)) + 0.5 - side / 2))
    return np.asarray(away < side / 2, dtype=np.float64)


def gaps(x: FloatArray, y: FloatArray, radii: FloatArray) -> FloatArray:
    """Distance between each two discs, negative where they overlap."""
    apart = np.hypot(np.subtract.outer(x, x), np.subtract.outer(y, y))
    between = apart - np.add.outer(radii, radii)
    first, second = np.triu_indices(len(x), 1)
    return np.asarray(between[first, second])


@given(count=st.integers(2, 8), radius=st.floats(1.0, 5.0), rng=generators())
def test_a_few_small_discs_never_overlap(
    count: int, radius: float, rng: np.random.Generator
) -> None:
    radii = rng.uniform(0.5, 1.0, count) * radius
    x, y = distance_field(disc_image(60), 1.0, radii, rng)
    assert gaps(x, y, radii).min() > 0
    assert (np.hypot(x - 30, y - 30) + radii < 31).all()


def test_the_largest_gets_the_most_room() -> None:
    image = np.zeros((40, 100))
    image[4:36, 4:36] = 1
    image[15:25, 60:70] = 1
    x, _ = distance_field(image, 1.0, np.array([1.0, 9.0]), np.random.default_rng(0))
    assert x[1] == pytest.approx(20, abs=2)


def test_canvas_units_come_back_whatever_the_image_is() -> None:
    radii = np.array([8.0, 5.0, 3.0])
    for px_per_cu in (0.5, 1.0, 2.0):
        image = disc_image(round(80 * px_per_cu))
        x, y = distance_field(image, px_per_cu, radii, np.random.default_rng(1))
        assert gaps(x, y, radii).min() > -0.5
        assert np.hypot(x - 40, y - 40).max() < 40


@pytest.mark.parametrize("shape", [(1, 1), (5, 5), (2, 9)])
def test_more_items_than_pixels_still_get_places_on_the_image(shape: tuple[int, int]) -> None:
    x, y = distance_field(np.ones(shape), 0.1, np.full(200, 30.0), np.random.default_rng(0))
    assert np.isfinite(x).all()
    assert np.isfinite(y).all()
    assert (x.min() >= 0) & (x.max() <= 10 * shape[1])
    assert (y.min() >= 0) & (y.max() <= 10 * shape[0])


def test_seeds_differ_and_one_seed_is_one_start() -> None:
    radii = np.full(6, 4.0)
    first, again, other = (
        distance_field(disc_image(50), 1.0, radii, np.random.default_rng(seed))
        for seed in (3, 3, 4)
    )
    np.testing.assert_array_equal(first, again)
    assert np.abs(np.subtract(first, other)).max() > 1e-3


def test_items_spread_over_all_parts_of_a_container() -> None:
    image = np.zeros((30, 90))
    for left in (0, 30, 60):
        image[5:25, left + 5 : left + 25] = 1
    x, y = distance_field(image, 1.0, np.full(6, 4.0), np.random.default_rng(0))
    assert np.bincount((x // 30).astype(int), minlength=3).tolist() == [2, 2, 2]
    assert image[y.astype(int), x.astype(int)].all()
