"""Area integrals per ring against the image weighted by that ring's own coverage."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given

from numerics import assert_adjoint, white_image
from packwork.arrays import FloatArray, Image
from packwork.geometry.polygon import signed_area
from packwork.raster.coverage import Rasteriser, coverage
from raster_reference import coverage_image
from strategies import POLYGONS, SHAPES, generators, joined, ring_sets


def _integrals(rings: list[FloatArray], image: Image, dtype: Any = np.float64) -> FloatArray:
    rasteriser = Rasteriser((image.shape[0], image.shape[1]), dtype)
    rasteriser.sweep(*joined(rings))
    return rasteriser.ring_integrals(image)


@given(rings=ring_sets(), shape=SHAPES, rng=generators())
def test_equals_the_image_weighted_by_clipping(
    rings: list[FloatArray], shape: tuple[int, int], rng: np.random.Generator
) -> None:
    image = rng.normal(size=shape)
    expected = [float(np.sum(image * coverage_image(ring, shape))) for ring in rings]
    np.testing.assert_allclose(_integrals(rings, image), expected, atol=1e-8)


@pytest.mark.parametrize("make", POLYGONS.values(), ids=POLYGONS.keys())
@pytest.mark.parametrize(("dtype", "accuracy"), [(np.float32, 2e-3), (np.float64, 1e-8)])
def test_equals_the_image_weighted_by_coverage(
    make: Any, dtype: Any, accuracy: float, rng: np.random.Generator
) -> None:
    for _ in range(5):
        rings = make(rng, 9.0)
        image = white_image(rng, (9, 11)).astype(dtype)
        expected = [
            float(np.sum(image * coverage(ring, [0, len(ring)], (9, 11)))) for ring in rings
        ]
        np.testing.assert_allclose(_integrals(rings, image, dtype), expected, atol=accuracy)


@pytest.mark.parametrize(
    ("shift", "share"),
    [((0, 0), 1.0), ((-2, 0), 0.5), ((0, -2), 0.5), ((6, 6), 0.25), ((40, 0), 0.0)],
    ids=["on", "left", "above", "corner", "off"],
)
def test_ones_integrate_to_the_area_on_the_image(shift: tuple[int, int], share: float) -> None:
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]]) + shift
    assert _integrals([square], np.ones((8, 8)))[0] == pytest.approx(16 * share)


def test_holes_come_out_negative(rng: np.random.Generator) -> None:
    outer, hole = POLYGONS["holed"](rng, 9.0)[:2]
    inner = hole * 0.5 + 2.25
    totals = _integrals([outer, inner], np.ones((9, 9)))
    assert totals[1] == pytest.approx(signed_area(inner))
    assert totals[1] < 0 < totals[0]


def test_is_the_transpose_of_rendering(rng: np.random.Generator) -> None:
    """Weights on rings to a density, and an image to integrals: one map and its transpose."""
    rings = POLYGONS["tiny"](rng, 9.0) + POLYGONS["self-crossing"](rng, 9.0)
    images = [coverage(ring, [0, len(ring)], (9, 9)) for ring in rings]

    def render(weights: Any) -> Any:
        return np.tensordot(weights, images, axes=1)

    assert_adjoint(
        render,
        lambda image: _integrals(rings, image),
        rng.normal(size=len(rings)),
        white_image(rng, (9, 9)),
        error=1e-10,
    )
