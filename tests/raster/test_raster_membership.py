"""Pixel centres against Shapely, and who owns a centre on a boundary."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from numerics import winding_numbers
from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import region
from packwork.raster.membership import centre_count
from strategies import POLYGONS, SHAPES, generators, joined, ring_sets, star_rings


def _centres(shape: tuple[int, int]) -> tuple[FloatArray, FloatArray]:
    rows, columns = np.indices(shape)
    return np.asarray(columns + 0.5), np.asarray(rows + 0.5)


@given(ring=star_rings(), shape=SHAPES, rng=generators())
def test_simple_rings_hold_what_shapely_says(
    ring: FloatArray, shape: tuple[int, int], rng: np.random.Generator
) -> None:
    ring = ring + rng.normal(size=2)
    inside = shapely.contains_xy(shapely.Polygon(ring), *_centres(shape))
    np.testing.assert_array_equal(centre_count(ring, [0, len(ring)], shape), inside)


@pytest.mark.parametrize("make", POLYGONS.values(), ids=POLYGONS.keys())
def test_cleaned_outlines_hold_what_shapely_says(make: Any, rng: np.random.Generator) -> None:
    for _ in range(10):
        shape = region(make(rng, 9.0), "evenodd")
        outline = Outline.from_region(shape)
        inside = shapely.contains_xy(shape, *_centres((9, 11)))
        np.testing.assert_array_equal(centre_count(outline.points, outline.starts, (9, 11)), inside)


@given(rings=ring_sets(), shape=SHAPES, rng=generators())
def test_any_rings_add_up_to_winding_numbers(
    rings: list[FloatArray], shape: tuple[int, int], rng: np.random.Generator
) -> None:
    # Nudged off the lattice: on a boundary the two twins may decide differently.
    nudged = [ring + rng.uniform(0.01, 0.3, (len(ring), 2)) for ring in rings]
    x, y = _centres(shape)
    centres = np.column_stack([x.ravel(), y.ravel()])
    expected = np.sum([winding_numbers(centres, ring) for ring in nudged], axis=0)
    counts = centre_count(*joined(nudged), shape)
    np.testing.assert_array_equal(counts.ravel(), expected)


def test_several_items_are_counted_apart() -> None:
    squares = [np.array([[0.0, 0], [3, 0], [3, 3], [0, 3]]) + k for k in range(3)]
    assert centre_count(*joined(squares), (5, 5)).tolist() == [
        [1, 1, 1, 0, 0],
        [1, 2, 2, 1, 0],
        [1, 2, 3, 2, 1],
        [0, 1, 2, 2, 1],
        [0, 0, 1, 1, 1],
    ]


@given(cut=st.integers(-2, 8).map(lambda k: k + 0.5), upright=st.booleans())
def test_a_boundary_through_centres_gives_each_to_one_side(cut: float, upright: bool) -> None:
    """Two halves that share an edge hold every centre once, never twice, never none."""
    halves = [shapely.box(-9, -9, cut, 20), shapely.box(cut, -9, 20, 20)]
    if not upright:
        halves = [shapely.box(-9, -9, 20, cut), shapely.box(-9, cut, 20, 20)]
    outlines = [Outline.from_region(half) for half in halves]
    counts = [centre_count(o.points, o.starts, (6, 6)) for o in outlines]
    assert (counts[0] + counts[1] == 1).all()
    ahead = _centres((6, 6))[0 if upright else 1] >= cut
    np.testing.assert_array_equal(counts[1], ahead)


@pytest.mark.parametrize("far", [1e4, 1e9, 1e300])
def test_rings_far_off_the_image(far: float) -> None:
    whole = np.array([[-far, -far], [far, -far], [far, far], [-far, far]])
    assert (centre_count(whole, [0, 4], (4, 5)) == 1).all()
    for away in ([3 * far, 0], [-3 * far, 0], [0, 3 * far], [0, -3 * far]):
        assert not centre_count(whole + away, [0, 4], (4, 5)).any()


def test_images_without_pixels_are_refused() -> None:
    with pytest.raises(ShapeError, match="at least one row"):
        centre_count([[0, 0], [1, 0], [1, 1]], [0, 3], (0, 3))
