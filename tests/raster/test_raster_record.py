"""The walk's record and its deposits stay inside what was reserved for them.

The kernels check no bounds, so guards stand on both sides of every array.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.arrays import FloatArray, Image, IntArray
from packwork.raster.coverage import BANDS, Rasteriser, coverage, coverage_pullback
from packwork.raster.kernels import coverage as kernels
from strategies import SHAPES

GUARD = 512
UNTOUCHED = -77_777
BORDERS = [0.0, -0.0, 1.0, 0.5, 3.0, 9.0, np.nextafter(1.0, 0.0), np.nextafter(1.0, 2.0)]
FAR = [1e9, -1e9, 1e5 + 0.5, -3e7, 1e300, -1e300, 1.7e308, -1.7e308]
FINE = [5e-324, -5e-324, 1e-16, -1e-16, 2.0**-17, -(2.0**-17), 2.0**-39, -(2.0**-39)]

coordinates = st.one_of(
    st.sampled_from(BORDERS + FAR + FINE),
    st.integers(-3, 12).map(float),
    st.floats(-1e9, 1e9, allow_nan=False),
    st.floats(-4, 13, allow_nan=False),
)


def _assert_stays_inside(points: FloatArray, starts: IntArray, shape: tuple[int, int]) -> None:
    for dtype in (np.float32, np.float64):
        rasteriser = Rasteriser(shape, dtype)
        rasteriser._points, rasteriser._starts = points, starts
        rasteriser._reserve()
        (record,) = rasteriser._used
        room, deposits = len(record.cells), rasteriser._deposits.size
        cells = np.full(room + GUARD, UNTOUCHED, dtype=np.int32)
        leaves: Image = np.full(room + GUARD, UNTOUCHED, dtype=dtype)
        buffer = np.zeros(deposits + 2 * GUARD, dtype=dtype)
        first = record.first
        # Compiled or not, extreme quotients overflow to infinity and are clamped.
        with np.errstate(all="ignore"):
            kernels.sweep(
                points, starts, np.arange(len(starts) - 1), True, *shape, *rasteriser._magic,
                buffer[GUARD:-GUARD], cells, leaves, first,
            )  # fmt: skip
        used = int(first[-1])
        # A quarter of the room is spare, but a later sweep that just fits may use it up.
        assert used <= -(-room * 4 // 5)
        assert (cells[used:] == UNTOUCHED).all()
        assert not buffer[:GUARD].any()
        assert not buffer[-GUARD:].any()
        assert np.isfinite(buffer).all()
        assert (np.diff(first) > 0).all()
        assert (cells[:used] < shape[0] * shape[1]).all()
        assert (cells[:used] > kernels.ABOVE - shape[1]).all()
        assert ((leaves[:used] >= -1e-6) & (leaves[:used] <= 1 + 1e-6)).all()
        assert (leaves[first[1:] - 1] == 1).all(), "an edge's record must end at its end"


@given(
    points=st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=12),
    cuts=st.lists(st.integers(0, 12), max_size=3),
    shape=SHAPES,
)
def test_any_finite_points(
    points: list[tuple[float, float]], cuts: list[int], shape: tuple[int, int]
) -> None:
    count = len(points)
    starts = np.array([0, *sorted(min(cut, count) for cut in cuts), count])
    _assert_stays_inside(np.array(points), starts, shape)


@pytest.mark.parametrize("scale", 10.0 ** np.arange(-3, 10, 2))
def test_random_points_of_every_size(scale: float, rng: np.random.Generator) -> None:
    for _ in range(30):
        points = rng.normal(size=(10, 2)) * scale
        _assert_stays_inside(points, np.array([0, 3, 3, 10]), (5, 7))


def test_edges_that_cut_all_four_lines(rng: np.random.Generator) -> None:
    """The longest record an edge can leave: beside, above, across, below, beside."""
    for _ in range(60):
        shape = (int(rng.integers(1, 6)), int(rng.integers(1, 6)))
        out = 10.0 ** rng.uniform(-3, 1, (2, 2)) * [[-1, -1], [1, 1]]
        ends = out + np.array([[0, 0], [shape[1], shape[0]]])
        if rng.random() < 0.5:
            ends[:, 0] = ends[::-1, 0]
        _assert_stays_inside(ends, np.array([0, 2]), shape)
        _assert_stays_inside(ends, np.array([0, 1, 2]), shape)


def test_rings_whose_closing_edges_are_all_their_length() -> None:
    """Rings of two points, each beginning where the one before ended: all links are nil."""
    there, back = [[0.3, 0.2], [59.6, 39.7]], [[59.6, 39.7], [0.3, 0.2]]
    points = np.array([*there, *back] * 3)
    _assert_stays_inside(points, np.arange(0, 13, 2), (40, 60))


def test_points_on_every_border(rng: np.random.Generator) -> None:
    borders = np.array([0.0, 5.0, 7.0, *BORDERS, *FINE])
    for _ in range(100):
        _assert_stays_inside(rng.choice(borders, (8, 2)), np.array([0, 8]), (5, 7))


def test_a_ring_far_larger_than_the_image_is_still_right() -> None:
    far = 1e9
    whole = [[-far, -far], [far, -far], [far, far], [-far, far]]
    for dtype in (np.float32, np.float64):
        assert (coverage(whole, [0, 4], (4, 5), dtype) == 1).all()
        gradient = coverage_pullback(whole, [0, 4], np.ones((4, 5), dtype), 1.0)
        np.testing.assert_allclose(gradient, np.sign(whole) * far, rtol=1e-6)


def test_the_record_grows_with_the_points_and_is_kept() -> None:
    rasteriser = Rasteriser((6, 6), np.float32)
    small = np.array([[1.0, 1], [2, 1], [2, 2]])
    rasteriser.sweep(small, np.array([0, 3]))
    large = np.tile(np.array([[-9.0, -9], [20, 20], [20, -9], [-9, 20]]), (9, 1))
    rasteriser.sweep(large, np.array([0, 36]))
    room = len(rasteriser._used[0].cells)
    rasteriser.sweep(small, np.array([0, 3]))
    assert len(rasteriser._used[0].cells) == room >= rasteriser._used[0].first[3]


@given(
    points=st.lists(st.tuples(coordinates, coordinates), min_size=6, max_size=40),
    shape=st.tuples(st.integers(1, 60), st.integers(1, 9)),
)
def test_bands_deposit_in_their_rows_alone_and_change_nothing(
    points: list[tuple[float, float]], shape: tuple[int, int]
) -> None:
    several = np.array(points)
    # Down the image, which is higher than others here.
    several[:, 1] += np.linspace(0, shape[0], len(several)) * (np.abs(several[:, 1]) < 1e4)
    starts = np.array([*range(0, len(several) - 2, 3), len(several)])
    adjoint = np.random.default_rng(0).random(shape, dtype=np.float32)
    whole, parted = Rasteriser(shape), Rasteriser(shape)
    with np.errstate(all="ignore"):
        whole.sweep(several, starts)
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("packwork.raster.coverage.PARTED", 0)
            parted.sweep(several, starts)
        gradients = [one.pullback(adjoint, 0.5).copy() for one in (whole, parted)]
    assert len(parted._used) == BANDS + 1
    height = -(-shape[0] // BANDS)
    for k, record in enumerate(parted._used[:-1]):
        cells = record.cells[: record.first[_edges(starts, record.order)]]
        rows = cells[cells >= 0] // shape[1]
        # A deposit goes to the row below too, and a walk may err by one at a corner.
        assert ((rows >= k * height + 2) | (k == 0)).all()
        assert ((rows < (k + 1) * height - 2) | (k == BANDS - 1)).all()
    np.testing.assert_array_equal(gradients[0], gradients[1])
    np.testing.assert_array_equal(whole.density(), parted.density())


def _edges(starts: IntArray, rings: IntArray) -> int:
    return int((starts[rings + 1] - starts[rings]).sum())
