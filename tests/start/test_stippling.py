"""Weighted Voronoi stippling: cells by density, inside the region, repeatable."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.start.stippling import stippled


def test_even_density_gives_even_cells() -> None:
    inside = np.ones((60, 60))
    found = stippled(inside, np.ones_like(inside), 40, np.random.default_rng(0))
    assert found.areas.sum() == inside.size
    assert found.areas.std() < 0.2 * found.areas.mean()


@pytest.mark.parametrize("factor", [4.0, 16.0])
def test_cells_shrink_by_the_square_root_of_the_density(factor: float) -> None:
    """Gersho's law in the plane: area of a cell by the density to the power of minus one half."""
    density = np.ones((80, 160))
    density[:, 80:] = factor
    found = stippled(np.ones_like(density), density, 200, np.random.default_rng(1), rounds=60)
    left = found.x < 80
    ratio = found.areas[left].mean() / found.areas[~left].mean()
    assert ratio == pytest.approx(np.sqrt(factor), rel=0.2)


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
