"""The mismatch of pictures, its gradient, and quasi-Newton steps."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.fit.descent import Mismatch, fit_to_picture, minimise
from packwork.geometry.outline import Outline
from strategies import generators

STAR = Outline.from_region(
    shapely.Polygon([(0, 0), (5, 1.2), (9, 0.3), (7, 4.1), (9.2, 8.6), (4.3, 6.1), (0.4, 8)])
)


FRAME = Outline.from_region(
    shapely.box(0, 0, 8, 6).difference(shapely.Point(4, 3).buffer(1.6)).union(
        shapely.box(8.9, 1, 9.7, 5.2)
    )
)  # fmt: skip


def wobbly(counts: list[int], radii: list[float], rng: np.random.Generator) -> np.ndarray:
    """Chains round the middle of a 12 px image, no two points alike."""
    chains = []
    for count, radius in zip(counts, radii, strict=True):
        turns = 2 * np.pi * np.arange(3 * count) / (3 * count) * np.sign(radius)
        around = abs(radius) * np.column_stack([np.cos(turns), np.sin(turns)])
        chains.append((around + 8 + rng.normal(0, 0.3, around.shape)).reshape(count, 3, 2))
    return np.concatenate(chains)


@pytest.mark.parametrize(
    ("target", "counts", "radii"),
    [(STAR, [5], [5.0]), (FRAME, [4, 4, 2], [6.0, -2.0, 3.0]), (STAR, [6], [11.0])],
    ids=["one ring", "parts and a hole", "over the image's rim"],
)
def test_the_gradient_is_the_derivative(
    target: Outline, counts: list[int], radii: list[float], rng: np.random.Generator
) -> None:
    mismatch = Mismatch(target, counts, 12)
    controls = wobbly(counts, radii, rng)
    _, gradient = mismatch(controls)
    assert_gradient(
        lambda at: mismatch(at)[0], gradient.copy(), controls, step=2.0**-16, error=1e-5
    )


def test_the_images_frame_is_undone_by_its_inverse(rng: np.random.Generator) -> None:
    points = rng.normal(size=(5, 2))
    mismatch = Mismatch(STAR, [4], 32)
    assert mismatch.to_units(mismatch.to_px(points)) == pytest.approx(points)


def test_each_level_is_nearer_than_the_start() -> None:
    counts = [7]
    ring = STAR.rings[0]
    step = (np.roll(ring, -1, axis=0) - ring) / 3
    edges = np.stack([ring, ring + step, ring + 2 * step], axis=1)
    stages = fit_to_picture(STAR, 0.8 * edges + 0.7, counts)
    judge = Mismatch(STAR, counts, 128)
    values = [judge(judge.to_px(stage))[0] for stage in stages]
    assert len(stages) == 4
    assert values[-1] < 0.01 * values[0]
    assert values[-1] == min(values)


def rosenbrock(x: FloatArray) -> tuple[float, FloatArray]:
    a, b = x[1:] - x[:-1] ** 2, 1 - x[:-1]
    gradient = np.zeros_like(x)
    gradient[:-1] = -400 * a * x[:-1] - 2 * b
    gradient[1:] += 200 * a
    return float(100 * a @ a + b @ b), gradient


@given(rng=generators())
def test_the_bottom_of_a_bowl_is_found(rng: np.random.Generator) -> None:
    slopes, bottom = rng.uniform(0.1, 30, 12), rng.normal(0, 5, 12)

    def bowl(x: FloatArray) -> tuple[float, FloatArray]:
        return float(slopes @ (x - bottom) ** 2), 2 * slopes * (x - bottom)

    assert minimise(bowl, np.zeros(12), 300, 1e-14) == pytest.approx(bottom, abs=1e-3)


def test_a_crooked_valley_is_followed_to_its_end() -> None:
    calls = 0

    def counted(x: FloatArray) -> tuple[float, FloatArray]:
        nonlocal calls
        calls += 1
        return rosenbrock(x)

    assert minimise(counted, np.zeros(6), 300, 1e-14) == pytest.approx(np.ones(6), abs=1e-4)
    assert calls < 150


def test_it_stays_where_the_slope_is_zero() -> None:
    assert minimise(rosenbrock, np.ones(4), 50, 1e-9).tolist() == [1, 1, 1, 1]


def test_it_never_ends_higher_than_it_began(rng: np.random.Generator) -> None:
    start = rng.normal(0, 3, 8)
    values = [rosenbrock(minimise(rosenbrock, start, n, 0.0))[0] for n in range(12)]
    assert values[0] == rosenbrock(start)[0]
    assert values == sorted(values, reverse=True)


def test_a_gradient_that_lies_ends_the_search() -> None:
    def uphill(x: FloatArray) -> tuple[float, FloatArray]:
        return float(np.abs(x).sum()), -np.sign(x)

    assert minimise(uphill, np.array([1.0, 2.0]), 50, 1e-9).tolist() == [1, 2]
