"""Weighted Voronoi stippling: cells by density, inside the region, repeatable."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.start.places import stippled


def test_even_density_gives_even_cells() -> None:
    inside = np.ones((60, 60))
    found = stippled(inside, np.ones_like(inside), 40, np.random.default_rng(0))
    assert found.areas.sum() == inside.size
    assert found.areas.std() < 0.2 * found.areas.mean()


@pytest.mark.parametrize("factor", [4.0, 16.0])
def test_cells_shrink_with_the_density_from_any_seed(factor: float) -> None:
    """At best by its root (Gersho's law in the plane); points drawn by the density alone, by all.

    Three points fall to each row here: drawn in even steps they would stand in columns.
    """
    density = np.ones((40, 80))
    density[:, 40:] = factor
    ratios = []
    for seed in range(5):
        found = stippled(np.ones_like(density), density, 120, np.random.default_rng(seed))
        left = found.x < 40
        ratios.append(found.areas[left].mean() / found.areas[~left].mean())
    assert np.sqrt(factor) < min(ratios)
    assert max(ratios) < factor


def test_points_lie_in_a_convex_region_and_repeat() -> None:
    y, x = np.mgrid[0:50, 0:50]
    disc = ((x - 25) ** 2 + (y - 25) ** 2 < 400).astype(float)
    first, second = (
        stippled(disc, np.ones_like(disc), 30, np.random.default_rng(2)) for _ in range(2)
    )
    assert (np.hypot(first.x - 25.5, first.y - 25.5) < 21).all()
    assert np.array_equal(first.x, second.x)


def test_more_points_than_pixels_keep_an_area() -> None:
    found = stippled(np.ones((3, 3)), np.ones((3, 3)), 20, np.random.default_rng(0))
    assert len(found.x) == 20
    assert found.areas.min() >= 1
