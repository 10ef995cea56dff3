"""The judges are judged: every wrong gradient must be seen."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from numerics import (
    STEP,
    assert_adjoint,
    assert_gradient,
    box_mean,
    box_spread,
    central_differences,
    compare,
    smooth_image,
    white_image,
)
from packwork.arrays import FloatArray
from packwork.raster.coverage import coverage, coverage_pullback

SHAPE = (9, 11)
BLOB = np.array([[1.3, 1.7], [7.6, 2.2], [9.4, 5.7], [5.2, 7.8], [2.1, 6.3]])
STARTS = np.array([0, 5])

WRONG: dict[str, Callable[[FloatArray], FloatArray]] = {
    "scaled": lambda g: 1.001 * g,
    "sign flipped": lambda g: -g,
    "x and y swapped": lambda g: g[:, ::-1],
    "vertices shifted by one": lambda g: np.roll(g, 1, axis=0),
    "one entry lost": lambda g: g * (np.arange(g.size).reshape(g.shape) != 3),
    "leaning": lambda g: g + 1e-4 * np.abs(g),
    "not a number": lambda g: g * np.nan,
}


def _weighted(adjoint: FloatArray) -> Callable[[FloatArray], float]:
    return lambda points: float(np.sum(adjoint * coverage(points, STARTS, SHAPE)))


def test_differences_of_a_quadratic_are_exact() -> None:
    at = np.array([[1.0, -2.0], [0.5, 4.0]])
    np.testing.assert_allclose(
        central_differences(lambda x: float(np.sum(x**2)), at), 2 * at, rtol=1e-11
    )


def test_a_right_gradient_passes(rng: np.random.Generator) -> None:
    adjoint = white_image(rng, SHAPE)
    assert_gradient(_weighted(adjoint), coverage_pullback(BLOB, STARTS, adjoint), BLOB)


@pytest.mark.parametrize("wrong", WRONG.values(), ids=WRONG.keys())
def test_a_wrong_gradient_fails(
    wrong: Callable[[FloatArray], FloatArray], rng: np.random.Generator
) -> None:
    adjoint = white_image(rng, SHAPE)
    right = coverage_pullback(BLOB, STARTS, adjoint)
    with pytest.raises(AssertionError):
        assert_gradient(_weighted(adjoint), wrong(right), BLOB)


@pytest.mark.parametrize("shift", [(0, 1), (0, -1), (1, 0), (-1, 0)])
@pytest.mark.parametrize("make", [white_image, smooth_image])
def test_an_adjoint_off_by_one_pixel_fails(
    shift: tuple[int, int],
    make: Callable[[np.random.Generator, tuple[int, int]], FloatArray],
    rng: np.random.Generator,
) -> None:
    adjoint = make(rng, SHAPE)
    shifted = np.roll(adjoint, shift, axis=(0, 1))
    with pytest.raises(AssertionError, match="error="):
        assert_gradient(_weighted(adjoint), coverage_pullback(BLOB, STARTS, shifted), BLOB)


def test_a_constant_adjoint_would_hide_the_pixel() -> None:
    """Why the adjoints of these tests are random."""
    adjoint = np.ones(SHAPE)
    shifted = np.roll(adjoint, (0, 1), axis=(0, 1))
    assert_gradient(_weighted(adjoint), coverage_pullback(BLOB, STARTS, shifted), BLOB)


def test_a_kink_is_seen_as_wrong() -> None:
    """An edge on a grid line has two one-sided derivatives; differences give their mean."""
    square = np.array([[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]])
    adjoint = np.indices((4, 4)).sum(axis=0) ** 2.0

    def value(points: FloatArray) -> float:
        return float(np.sum(adjoint * coverage(points, [0, 4], (4, 4))))

    with pytest.raises(AssertionError):
        assert_gradient(value, coverage_pullback(square, [0, 4], adjoint), square)


def test_bias_is_judged_apart_from_noise(rng: np.random.Generator) -> None:
    at = rng.normal(size=2_000)

    def value(x: FloatArray) -> float:
        return float(np.sum(x**2))

    noisy = 2 * at * (1 + 1e-3 * rng.normal(size=at.shape))
    assert_gradient(value, noisy, at, error=3e-3, bias=1e-4)
    with pytest.raises(AssertionError):
        assert_gradient(value, 2 * at * 1.002, at, error=3e-3, bias=1e-4)


def test_compare_tells_direction_from_length() -> None:
    agreement = compare([3.0, 0.0], [2.0, 0.0])
    assert (agreement.error, agreement.cosine, agreement.bias) == (0.5, 1.0, 0.5)


def test_a_gradient_of_the_wrong_shape_fails() -> None:
    with pytest.raises(AssertionError, match="shape"):
        assert_gradient(lambda x: float(x.sum()), np.ones(3), np.ones((1, 3)))


def test_a_zero_reference_judges_nothing() -> None:
    with pytest.raises(AssertionError, match="judge nothing"):
        assert_gradient(lambda x: 1.0, np.zeros(3), np.ones(3))


def test_the_point_is_left_as_it_was() -> None:
    at = np.array([1.0, 2.0])
    central_differences(lambda x: float(x.sum()), at)
    assert at.tolist() == [1.0, 2.0]
    assert np.log2(STEP) == int(np.log2(STEP))


def test_transposes_are_told_from_others(rng: np.random.Generator) -> None:
    fine, coarse = white_image(rng, (6, 8)), white_image(rng, (3, 4))
    assert_adjoint(lambda x: box_mean(x, 2), lambda y: box_spread(y, 2), fine, coarse)
    with pytest.raises(AssertionError, match="A'y"):
        assert_adjoint(lambda x: box_mean(x, 2), lambda y: 4 * box_spread(y, 2), fine, coarse)
    with pytest.raises(AssertionError, match="A'y"):
        assert_adjoint(
            lambda x: box_mean(x, 2), lambda y: np.roll(box_spread(y, 2), 1, 0), fine, coarse
        )
