"""Measures on the torus, against the plane with many images."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

from packwork.geometry.lattice import Lattice, moved
from packwork.geometry.outline import Outline
from packwork.metrics.torus import torus_metrics
from packwork.metrics.violations import violations_on_torus
from scenes import placed, poses, star
from strategies import generators

LATTICES = [Lattice(6.0, 4.0), Lattice(6.0, 4.0, 2.0)]


def scattered(rng: np.random.Generator, count: int, scale: float) -> list[Outline]:
    where = poses(
        rng.uniform(-9, 9, count), rng.uniform(-9, 9, count), rng.uniform(0, 6, count), scale
    )
    return placed([star(1.0)] * count, where)


def everywhere(outlines: list[Outline], lattice: Lattice) -> list[shapely.Geometry]:
    shifts = [
        (a * lattice.width, a * lattice.drop + b * lattice.height)
        for a in range(-4, 5) for b in range(-8, 9)
    ]  # fmt: skip
    return [moved(outline.region, shift) for outline in outlines for shift in shifts]


@pytest.mark.parametrize("lattice", LATTICES)
@given(generators())
@settings(deadline=None, max_examples=25)
def test_shares_are_those_of_the_plane_seen_through_the_cell(
    lattice: Lattice, rng: np.random.Generator
) -> None:
    outlines = scattered(rng, 4, 0.9)
    found = torus_metrics(outlines, lattice)
    cell = shapely.box(*lattice.cell)
    seen = [shapely.intersection(one, cell) for one in everywhere(outlines, lattice)]
    seen = [one for one in seen if one.area > 0]
    assert found.coverage == pytest.approx(shapely.union_all(seen).area / cell.area)
    twice = [
        one.intersection(other) for k, one in enumerate(seen) for other in seen[:k]
        if one.intersects(other)
    ]  # fmt: skip
    assert found.overlap_area == pytest.approx(shapely.union_all(twice).area, abs=1e-9)
    assert found.outside_area == 0


@pytest.mark.parametrize("lattice", LATTICES)
@given(generators())
@settings(deadline=None, max_examples=25)
def test_the_smallest_gap_is_that_of_the_plane(lattice: Lattice, rng: np.random.Generator) -> None:
    outlines = scattered(rng, 2, 0.5)
    regions = everywhere(outlines, lattice)
    own = [outline.region for outline in outlines]
    gap = min(
        one.distance(other) for one in own for other in regions
        if not one.equals_exact(other, 1e-9)
    )  # fmt: skip
    found = torus_metrics(outlines, lattice)
    assert found.min_gap == pytest.approx(gap, abs=1e-9)
    pairs = violations_on_torus(outlines, lattice, gap * 1.01 + 1e-9)
    assert pairs
    assert min(one.gap_cu for one in pairs) == pytest.approx(gap, abs=1e-9)


def test_an_item_as_wide_as_the_tile_meets_its_own_image() -> None:
    bar = Outline.box(0.0, 0.0, 6.5, 1.0)
    found = torus_metrics([bar], LATTICES[0])
    assert found.overlap_area == pytest.approx(0.5)
    (only,) = violations_on_torus([bar], LATTICES[0], 0.1)
    assert (only.item, only.other, only.overlap_cu2) == (0, 0, pytest.approx(0.5))
