"""Backward: vertex gradients against central differences, on the image and off it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from numerics import (
    assert_gradient,
    box_spread,
    central_differences,
    compare,
    smooth_image,
    white_image,
)
from packwork.arrays import FloatArray, Image, IntArray
from packwork.geometry.polygon import signed_area
from packwork.raster.coverage import Rasteriser, coverage, coverage_pullback
from strategies import POLYGONS, SHAPES, generators, joined, ring_sets

SHAPE = (9, 11)
ADJOINTS = pytest.mark.parametrize("adjoint_of", [white_image, smooth_image])
KINDS = pytest.mark.parametrize("make", POLYGONS.values(), ids=POLYGONS.keys())


class Seen:
    """What the pullback differentiates: adjoint on the image, ``beyond`` off it."""

    def __init__(self, adjoint: Image, starts: IntArray, beyond: float) -> None:
        self.adjoint, self.starts, self.beyond = adjoint, starts, beyond

    def __call__(self, points: FloatArray) -> float:
        shape = (self.adjoint.shape[0], self.adjoint.shape[1])
        image = coverage(points, self.starts, shape)
        area = sum(signed_area(ring) for ring in np.split(points, self.starts[1:-1]))
        return float(np.sum(self.adjoint * image) + self.beyond * (area - image.sum()))


@KINDS
@ADJOINTS
@pytest.mark.parametrize("beyond", [0.0, -1.7])
def test_equals_central_differences(
    make: Any, adjoint_of: Any, beyond: float, rng: np.random.Generator
) -> None:
    for _ in range(3):
        points, starts = joined(make(rng, 9.0))
        seen = Seen(adjoint_of(rng, SHAPE), starts, beyond)
        gradient = coverage_pullback(points, starts, seen.adjoint, beyond)
        if not gradient.any():
            np.testing.assert_allclose(central_differences(seen, points), 0, atol=1e-9)
        else:
            # Areas beyond the image grow with the ring's reach, and so does rounding.
            reach = max(1.0, float(np.abs(points).max()) / 100)
            assert_gradient(seen, gradient, points, error=1e-6 * reach)


@KINDS
@ADJOINTS
def test_single_precision_is_close_and_does_not_lean(
    make: Any, adjoint_of: Any, rng: np.random.Generator
) -> None:
    for _ in range(3):
        points, starts = joined(make(rng, 9.0))
        adjoint = adjoint_of(rng, SHAPE).astype(np.float32)
        exact = coverage_pullback(points, starts, adjoint.astype(np.float64), 0.5)
        met = compare(coverage_pullback(points, starts, adjoint, 0.5), exact)
        assert met.error < 1e-4, met
        assert abs(met.bias) < 2e-5, met


@given(rings=ring_sets(), shape=SHAPES, rng=generators(), beyond=st.floats(-3, 3))
def test_moving_and_scaling_by_greens_theorem(
    rings: list[FloatArray], shape: tuple[int, int], rng: np.random.Generator, beyond: float
) -> None:
    """A constant adjoint everywhere makes the loss an area: known for any shape."""
    points, starts = joined(rings)
    area = sum(signed_area(ring) for ring in rings)
    gradient = coverage_pullback(points, starts, np.full(shape, beyond), beyond)
    np.testing.assert_allclose(gradient.sum(axis=0), 0, atol=1e-8)
    assert float(np.sum(gradient * points)) == pytest.approx(2 * beyond * area, abs=1e-6)
    turned = gradient[:, 1] * points[:, 0] - gradient[:, 0] * points[:, 1]
    assert float(turned.sum()) == pytest.approx(0, abs=1e-6)


@given(rings=ring_sets(), shape=SHAPES, rng=generators(), factor=st.integers(2, 3))
def test_a_spread_adjoint_on_a_finer_image_gives_the_same_gradient(
    rings: list[FloatArray], shape: tuple[int, int], rng: np.random.Generator, factor: int
) -> None:
    """Averaging pixels and rendering commute; so do their pullbacks."""
    points, starts = joined(rings)
    points = points + rng.uniform(0.01, 0.02, points.shape)
    adjoint = rng.normal(size=shape)
    coarse = coverage_pullback(points, starts, adjoint, 0.3)
    fine = coverage_pullback(points * factor, starts, box_spread(adjoint, factor), 0.3 / factor**2)
    np.testing.assert_allclose(fine * factor, coarse, atol=1e-7)


@given(rings=ring_sets(), shape=SHAPES, rng=generators(), beyond=st.floats(-3, 3))
def test_linear_in_the_adjoint(
    rings: list[FloatArray], shape: tuple[int, int], rng: np.random.Generator, beyond: float
) -> None:
    points, starts = joined(rings)
    first, second = rng.normal(size=(2, *shape))
    together = coverage_pullback(points, starts, 2 * first - 3 * second, 2 * beyond)
    apart = 2 * coverage_pullback(points, starts, first, beyond) - 3 * coverage_pullback(
        points, starts, second
    )
    np.testing.assert_allclose(together, apart, atol=1e-9)


def test_each_ring_sees_the_same_adjoint(rng: np.random.Generator) -> None:
    """The density is a sum: other items change no item's gradient for one adjoint."""
    rings = POLYGONS["holed"](rng, 9.0)
    adjoint = white_image(rng, SHAPE)
    alone = np.concatenate([coverage_pullback(r, [0, len(r)], adjoint, 0.4) for r in rings])
    np.testing.assert_array_equal(coverage_pullback(*joined(rings), adjoint, 0.4), alone)


def test_reversing_flips_the_sign(rng: np.random.Generator) -> None:
    ring = POLYGONS["partly off"](rng, 9.0)[0]
    adjoint = white_image(rng, SHAPE)
    forward = coverage_pullback(ring, [0, len(ring)], adjoint, 0.4)
    backward = coverage_pullback(ring[::-1], [0, len(ring)], adjoint, 0.4)
    np.testing.assert_allclose(backward[::-1], -forward, atol=1e-11)


@pytest.mark.parametrize(
    ("x", "y"),
    [(-6, 4), (16, 4), (5, -6), (5, 16)],
    ids=["left", "right", "above", "below"],
)
def test_an_item_that_left_feels_only_what_lies_beyond(x: float, y: float) -> None:
    """Wholly off the image the force on the whole is zero, its size still feels one."""
    about_zero = np.array([[-1.2, -1.1], [1.3, -0.9], [1.0, 1.2], [-0.8, 1.4]])
    ring = about_zero + np.array([x, y])
    adjoint = np.random.default_rng(0).normal(size=(9, 11))
    assert not coverage_pullback(ring, [0, 4], adjoint).any()
    gradient = coverage_pullback(ring, [0, 4], adjoint, 2.0)
    np.testing.assert_allclose(gradient.sum(axis=0), 0, atol=1e-12)
    growth = float(np.sum(gradient * about_zero))
    assert growth == pytest.approx(2 * 2.0 * signed_area(ring))


def test_gradient_reads_the_last_sweep_only(rng: np.random.Generator) -> None:
    rasteriser = Rasteriser(SHAPE, np.float64)
    adjoint = white_image(rng, SHAPE)
    for kind in ("tiny", "inside", "holed"):
        points, starts = joined(POLYGONS[kind](rng, 9.0))
        rasteriser.sweep(points, starts)
        rasteriser.density()
        np.testing.assert_array_equal(
            rasteriser.pullback(adjoint), coverage_pullback(points, starts, adjoint)
        )
        rasteriser.sweep(points, starts)
        np.testing.assert_array_equal(
            rasteriser.pullback(2 * adjoint), 2 * coverage_pullback(points, starts, adjoint)
        )
