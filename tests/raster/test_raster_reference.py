"""The slow twin itself, and what summing coverages leaves out of true compositing."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from packwork.arrays import FloatArray
from packwork.raster.coverage import coverage
from raster_reference import clipped_area, composite, coverage_image
from strategies import generators, star_rings


@given(ring=star_rings())
def test_clipping_agrees_with_shapely(ring: FloatArray) -> None:
    polygon = shapely.Polygon(ring)
    for row in range(8):
        for column in range(8):
            pixel = shapely.box(column, row, column + 1, row + 1)
            area = clipped_area(ring, column, row)
            assert area == pytest.approx(shapely.intersection(polygon, pixel).area, abs=1e-12)


def test_clipping_is_signed() -> None:
    square = np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]])
    assert clipped_area(square, 0, 0) == 1
    assert clipped_area(square[::-1], 0, 0) == -1
    assert clipped_area(square, 5, 5) == 0


coverages = st.lists(st.floats(0, 1), min_size=1, max_size=12)


@given(shares=coverages)
def test_the_sum_exceeds_compositing_by_less_than_one_over_e(shares: list[float]) -> None:
    """``0 <= min(S, 1) - composite <= (1 - 1/n)^n < 1/e`` for n items in one pixel.

    The union bound is the left side. On the right, at fixed S the composite is least
    when all items cover alike, and then the difference is largest at S = 1.
    """
    n = len(shares)
    capped = min(sum(shares), 1.0)
    true = float(composite([np.array([[c]]) for c in shares], 1.0)[0, 0])
    assert -1e-12 <= capped - true <= (1 - 1 / n) ** n + 1e-12 < 1 / math.e + 1e-9


def test_the_bound_is_met_by_items_that_share_a_pixel_equally() -> None:
    for n in range(2, 30):
        alike = composite([np.full((1, 1), 1 / n)] * n, 1.0)
        assert 1 - float(alike[0, 0]) == pytest.approx((1 - 1 / n) ** n)
    two = composite([np.full((1, 1), 0.5)] * 2, 1.0)
    assert 1 - float(two[0, 0]) == 0.25


@given(first=star_rings((3.2, 4.1)), second=star_rings((5.3, 4.4)))
def test_they_differ_only_where_two_boundaries_share_a_pixel(
    first: FloatArray, second: FloatArray
) -> None:
    images = [coverage_image(ring, (9, 10)) for ring in (first, second)]
    difference = np.minimum(images[0] + images[1], 1) - composite(images, 1.0)
    shared = np.all([(c > 1e-12) & (c < 1 - 1e-12) for c in images], axis=0)
    assert np.abs(difference[~shared]).max(initial=0) < 1e-9
    assert difference.sum() <= 0.25 * np.count_nonzero(shared) + 1e-9


def test_the_difference_vanishes_with_the_pixel_size() -> None:
    """Boundaries that cross share fewer and fewer pixels: the mean falls with the square."""
    rings = [
        np.array([[1.1, 1.3], [6.2, 2.1], [5.7, 6.9], [1.9, 6.1]]),
        np.array([[3.7, 0.6], [7.3, 3.9], [4.1, 7.2], [2.2, 4.3]]),
    ]
    means = []
    for factor in (1, 4, 16):
        shape = (8 * factor, 8 * factor)
        images = [coverage(ring * factor, [0, 4], shape) for ring in rings]
        difference = np.minimum(images[0] + images[1], 1) - composite(images, 1.0)
        means.append(float(difference.mean()))
    assert means[1] < means[0] / 6
    assert means[2] < means[1] / 6


@given(rng=generators(), opacity=st.floats(0.05, 0.95))
def test_too_opaque_means_two_items_or_more(rng: np.random.Generator, opacity: float) -> None:
    """On 0/1 coverages the paper's "more opaque than one item" is S > 1."""
    images = [rng.integers(0, 2, (6, 6)).astype(float) for _ in range(3)]
    opaque = composite(images, opacity) > opacity + 1e-9
    np.testing.assert_array_equal(opaque, np.sum(images, axis=0) > 1)
    np.testing.assert_array_equal(composite(images, 1.0), np.minimum(np.sum(images, axis=0), 1))
