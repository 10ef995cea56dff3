"""The whole chain's gradient: controls to polygon to image to one number, and back."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from numerics import assert_gradient
from packwork.fit.descent import Mismatch, fit_to_picture
from packwork.geometry.outline import Outline

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
