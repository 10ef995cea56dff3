"""Forward: coverage against clipping pixel by pixel, and what must hold for any shape."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from numerics import assert_adjoint, box_mean, white_image, winding_numbers
from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.polygon import signed_area
from packwork.raster.coverage import MAX_SIDE_PX, Rasteriser, coverage
from packwork.raster.kernels import coverage as kernels
from raster_reference import coverage_image
from strategies import (
    POLYGONS,
    SEEDS,
    SHAPES,
    joined,
    lattice_rings,
    ring_sets,
    rounded_sets,
    star_rings,
    wild_rings,
)

ACCURACY = {np.float32: 1e-4, np.float64: 1e-9}
DTYPES = pytest.mark.parametrize("dtype", [np.float32, np.float64])


def _twin(rings: list[FloatArray], shape: tuple[int, int]) -> FloatArray:
    return np.asarray(np.sum([coverage_image(ring, shape) for ring in rings], axis=0))


def _assert_twins(rings: list[FloatArray], shape: tuple[int, int], dtype: Any) -> None:
    got = coverage(*joined(rings), shape, dtype)
    # Both twins round where they cut an edge, by the size of its coordinates.
    reach = max(float(np.abs(ring).max()) for ring in rings)
    assert got.dtype == dtype
    np.testing.assert_allclose(
        got, _twin(rings, shape), rtol=0, atol=ACCURACY[dtype] + 1e-15 * reach
    )


@DTYPES
@pytest.mark.parametrize("make", POLYGONS.values(), ids=POLYGONS.keys())
def test_equals_clipping(make: Any, dtype: Any, rng: np.random.Generator) -> None:
    for _ in range(8):
        _assert_twins(make(rng, 9.0), (9, 11), dtype)


@DTYPES
@given(rings=ring_sets(), shape=SHAPES)
def test_equals_clipping_for_any_rings(
    rings: list[FloatArray], shape: tuple[int, int], dtype: Any
) -> None:
    _assert_twins(rings, shape, dtype)


@DTYPES
@given(ring=lattice_rings(), shape=SHAPES)
def test_edges_on_grid_lines_are_no_exception(
    ring: FloatArray, shape: tuple[int, int], dtype: Any
) -> None:
    np.testing.assert_allclose(
        coverage(*joined([ring]), shape, dtype),
        coverage_image(ring, shape),
        atol=ACCURACY[dtype],
        rtol=0,
    )


@DTYPES
@pytest.mark.parametrize("reach", [1e3, 1e6, 1e9])
def test_equals_clipping_far_off_the_image(
    reach: float, dtype: Any, rng: np.random.Generator
) -> None:
    for _ in range(10):
        far = rng.normal(size=(5, 2)) * reach
        far[0] = rng.uniform(0, 8, 2)
        _assert_twins([far], (8, 8), dtype)


@pytest.mark.parametrize(
    "points",
    [
        [[3.2, 1.1]],
        [[1.5, 1.5], [4.5, 2.5]],
        [[2.5, 0.2], [2.5, 3.7], [2.5, 1.0]],
        [[0.3, 2.5], [5.1, 2.5], [1.0, 2.5]],
        [[2.0, 2.0]] * 4,
        [[-5.0, -5.0], [20.0, 20.0], [-5.0, -5.0]],
        [[4.0, -1.0], [4.0, 9.0], [4.0, 3.0]],
    ],
    ids=["point", "pair", "upright", "level", "repeated", "diagonal", "on a line"],
)
def test_rings_without_area_leave_nothing(points: list[list[float]]) -> None:
    for dtype in ACCURACY:
        assert not coverage(points, [0, len(points)], (5, 6), dtype).any()


def test_empty_rings_leave_nothing() -> None:
    square = [[1, 1], [3, 1], [3, 3], [1, 3]]
    np.testing.assert_array_equal(
        coverage(square, [0, 0, 4, 4], (4, 4)), coverage(square, [0, 4], (4, 4))
    )
    assert not coverage(np.zeros((0, 2)), [0], (2, 2)).any()


@DTYPES
@given(ring=star_rings())
def test_total_is_the_shoelace_area(ring: FloatArray, dtype: Any) -> None:
    total = float(coverage(*joined([ring]), (8, 8), dtype).sum(dtype=np.float64))
    assert total == pytest.approx(signed_area(ring), abs=64 * ACCURACY[dtype])


@DTYPES
@given(ring=wild_rings(0.0, 8.0))
def test_total_is_the_signed_area_of_crossing_rings(ring: FloatArray, dtype: Any) -> None:
    total = float(coverage(*joined([ring]), (8, 8), dtype).sum(dtype=np.float64))
    assert total == pytest.approx(signed_area(ring), abs=64 * ACCURACY[dtype])


@given(rings=ring_sets(), corner=SHAPES, shape=SHAPES)
def test_cropping_the_image_crops_the_coverage(
    rings: list[FloatArray], corner: tuple[int, int], shape: tuple[int, int]
) -> None:
    top, left = corner
    points, starts = joined(rings)
    whole = coverage(points, starts, (top + shape[0] + 2, left + shape[1] + 3))
    cropped = coverage(points - [left, top], starts, shape)
    np.testing.assert_allclose(
        cropped, whole[top : top + shape[0], left : left + shape[1]], atol=1e-9, rtol=0
    )


@DTYPES
@given(rings=ring_sets(), shape=SHAPES)
def test_reversing_flips_the_sign(
    rings: list[FloatArray], shape: tuple[int, int], dtype: Any
) -> None:
    forward = coverage(*joined(rings), shape, dtype)
    backward = coverage(*joined([ring[::-1] for ring in rings]), shape, dtype)
    np.testing.assert_allclose(backward, -forward, atol=ACCURACY[dtype], rtol=0)


@given(rings=ring_sets(), shape=SHAPES, factor=st.integers(2, 4))
def test_averaged_fine_coverage_is_coarse_coverage(
    rings: list[FloatArray], shape: tuple[int, int], factor: int
) -> None:
    points, starts = joined(rings)
    fine = coverage(points * factor, starts, (shape[0] * factor, shape[1] * factor))
    np.testing.assert_allclose(
        box_mean(fine, factor), coverage(points, starts, shape), atol=1e-9, rtol=0
    )


@given(rings=ring_sets(), shape=SHAPES)
def test_transposing_shape_and_image_agree(rings: list[FloatArray], shape: tuple[int, int]) -> None:
    points, starts = joined(rings)
    mirrored = coverage(points[:, ::-1], starts, shape[::-1])
    np.testing.assert_allclose(mirrored.T, -coverage(points, starts, shape), atol=1e-9, rtol=0)


@DTYPES
@given(rings=ring_sets(6), shape=SHAPES, seed=SEEDS)
def test_the_order_of_rings_changes_no_bit(
    rings: list[FloatArray], shape: tuple[int, int], seed: int, dtype: Any
) -> None:
    order = np.random.default_rng(seed).permutation(len(rings))
    first = coverage(*joined(rings), shape, dtype)
    second = coverage(*joined([rings[k] for k in order]), shape, dtype)
    np.testing.assert_array_equal(first, second)


@DTYPES
@given(rings=ring_sets(), shape=SHAPES, turn=st.integers(1, 7))
def test_where_a_ring_starts_changes_no_bit(
    rings: list[FloatArray], shape: tuple[int, int], turn: int, dtype: Any
) -> None:
    rolled = [np.roll(ring, turn, axis=0) for ring in rings]
    np.testing.assert_array_equal(
        coverage(*joined(rings), shape, dtype), coverage(*joined(rolled), shape, dtype)
    )


def test_hundreds_of_items_add_up_exactly_in_any_order(rng: np.random.Generator) -> None:
    rings = [
        rng.uniform(0, 60, 2) + rng.uniform(-9, 9, (5, 2)) for _ in range(12 if _slow() else 240)
    ]
    forward = coverage(*joined(rings), (60, 60), np.float32)
    np.testing.assert_array_equal(forward, coverage(*joined(rings[::-1]), (60, 60), np.float32))


def _slow() -> bool:
    return not hasattr(kernels.sweep, "signatures")


@DTYPES
@given(rings=rounded_sets(4), shape=SHAPES)
def test_pixels_off_the_boundary_hold_exact_winding_numbers(
    rings: list[FloatArray], shape: tuple[int, int], dtype: Any
) -> None:
    """Outside every item the density is exactly zero: no streaks; inside, exactly whole."""
    rows, columns = np.indices(shape)
    boxes = shapely.box(columns, rows, columns + 1, rows + 1)
    edges = shapely.MultiLineString([[*ring, ring[0]] for ring in rings])
    off = shapely.distance(boxes, edges) > 1e-4
    centres = np.column_stack([columns[off], rows[off]]) + 0.5
    expected = np.sum([winding_numbers(centres, ring) for ring in rings], axis=0)
    np.testing.assert_array_equal(coverage(*joined(rings), shape, dtype)[off], expected)


@DTYPES
def test_far_corners_leave_no_streak(dtype: Any, rng: np.random.Generator) -> None:
    """Edges cut at the image's sides end on them exactly, however long they are."""
    rasteriser = Rasteriser((8, 8), dtype)
    for _ in range(300):
        ring = rng.normal(size=(6, 2)) * 10.0 ** rng.uniform(0, 7, (6, 1))
        ring[:, 1] = np.minimum(ring[:, 1], 7.9)
        rasteriser.sweep(ring, np.array([0, 6]))
        assert not rasteriser.accumulation.sum(axis=0).any()
        rasteriser.density()


def test_rasteriser_is_clean_after_each_image(rng: np.random.Generator) -> None:
    rasteriser = Rasteriser((7, 9), np.float32)
    for count in (3, 40, 5, 0, 17):
        points = rng.uniform(-4, 12, (count, 2))
        starts = np.array([0, count])
        rasteriser.sweep(points, starts)
        assert np.array_equal(rasteriser.density(), coverage(points, starts, (7, 9), np.float32))
        assert not rasteriser.accumulation.any()


def test_density_fills_the_image_it_is_given() -> None:
    rasteriser = Rasteriser((2, 2), np.float64)
    rasteriser.sweep(np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), np.array([0, 4]))
    image = np.full((2, 2), 7.0)
    assert rasteriser.density(image) is image
    assert image.tolist() == [[1.0, 0.0], [0.0, 0.0]]


@DTYPES
def test_running_sum_has_its_transpose(dtype: Any, rng: np.random.Generator) -> None:
    def forward(buffer: Any) -> Any:
        density = np.empty((6, 5), dtype=dtype)
        kernels.accumulate(buffer.astype(dtype), density)
        return density

    def backward(image: Any) -> Any:
        swept = np.zeros((7, 5))
        swept[:6] = np.cumsum(image[::-1], axis=0)[::-1]
        return swept

    tolerance = 1e-12 if dtype == np.float64 else 1e-6
    assert_adjoint(
        forward, backward, white_image(rng, (7, 5)), white_image(rng, (6, 5)), error=tolerance
    )


@pytest.mark.parametrize("shape", [(0, 4), (4, 0), (-1, 3), (MAX_SIDE_PX + 1, 2)])
def test_impossible_images_are_refused(shape: tuple[int, int]) -> None:
    with pytest.raises(ShapeError, match="sides must be 1 to"):
        Rasteriser(shape)


@pytest.mark.parametrize("dtype", [np.int32, np.float16, np.uint8])
def test_images_of_other_numbers_are_refused(dtype: Any) -> None:
    with pytest.raises(ShapeError, match="float32 or float64"):
        Rasteriser((2, 2), dtype)


@pytest.mark.parametrize(
    ("points", "starts", "problem"),
    [
        ([[0, 0], [1, np.nan], [1, 1]], [0, 3], "finite"),
        ([[0, 0], [1, np.inf], [1, 1]], [0, 3], "finite"),
        ([[0, 0, 0]], [0, 1], r"shape \(n, 2\)"),
        ([[0, 0], [1, 0], [1, 1]], [0, 2], "ring starts"),
        ([[0, 0], [1, 0], [1, 1]], [1, 3], "ring starts"),
        ([[0, 0], [1, 0], [1, 1]], [0, 2, 1, 3], "decrease"),
        ([[0, 0], [1, 0], [1, 1]], [], "ring starts"),
    ],
)
def test_points_and_starts_are_checked(points: Any, starts: Any, problem: str) -> None:
    with pytest.raises(ShapeError, match=problem):
        coverage(points, starts, (2, 2))


@pytest.mark.compiled
@pytest.mark.parametrize("side", [MAX_SIDE_PX])
def test_the_widest_image_keeps_its_exact_sums(side: int, rng: np.random.Generator) -> None:
    ring = np.array([[0.3, 0.2], [side - 0.4, 0.7], [side * 0.4, 1.9]])
    for dtype, tolerance in ((np.float32, 0.2), (np.float64, 1e-7)):
        image = coverage(ring, [0, 3], (3, side), dtype)
        assert not image[2].any()
        assert float(image.sum(dtype=np.float64)) == pytest.approx(signed_area(ring), abs=tolerance)


@pytest.mark.compiled
@pytest.mark.parametrize("shape", [(3, 4), (1500, 1500)], ids=["small", "large"])
@pytest.mark.parametrize("starts", [[0], [0, 0], [0, 0, 0]])
def test_rings_without_points_cover_nothing(starts: list[int], shape: tuple[int, int]) -> None:
    rasteriser = Rasteriser(shape)
    rasteriser.sweep(np.zeros((0, 2)), np.array(starts))
    assert rasteriser.pullback(np.ones(shape, np.float32)).shape == (0, 2)
    assert not rasteriser.ring_integrals(np.ones(shape, np.float32)).any()
    assert not rasteriser.density().any()


@pytest.mark.parametrize("starts", [[0, 0, 4], [0, 4, 4]])
def test_an_empty_ring_beside_a_full_one_changes_nothing(starts: list[int]) -> None:
    square = np.array([[0, 0], [9, 0], [9, 9], [0, 9.0]])
    assert coverage(square, starts, (1500, 1500)).sum() == 81
