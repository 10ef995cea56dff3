"""Lattices: what is brought into the cell, and what meets a box."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings

from packwork.geometry.lattice import Lattice, moved
from strategies import generators

LATTICES = [Lattice(4.0, 3.0), Lattice(4.0, 3.0, 1.5)]


@pytest.mark.parametrize("lattice", LATTICES)
@given(generators())
@settings(deadline=None, max_examples=40)
def test_points_come_into_the_cell_by_lattice_vectors(
    lattice: Lattice, rng: np.random.Generator
) -> None:
    points = rng.uniform(-30, 30, (20, 2))
    inside = lattice.wrapped(points)
    assert (inside >= 0).all()
    assert (inside[:, 0] <= lattice.width).all()
    assert (inside[:, 1] <= lattice.height).all()
    columns = (points[:, 0] - inside[:, 0]) / lattice.width
    rows = (points[:, 1] - inside[:, 1] - columns * lattice.drop) / lattice.height
    assert np.allclose(columns, np.rint(columns))
    assert np.allclose(rows, np.rint(rows), atol=1e-9)


@pytest.mark.parametrize("lattice", LATTICES)
@given(generators())
@settings(deadline=None, max_examples=40)
def test_translations_that_meet_a_box_are_all_and_no_others(
    lattice: Lattice, rng: np.random.Generator
) -> None:
    left, top = rng.uniform(-9, 9, 2)
    width, height = rng.uniform(0.1, 5, 2)
    bounds = (float(left), float(top), float(left + width), float(top + height))
    found = {tuple(np.round(v, 6)) for v in lattice.meeting(bounds, lattice.cell)}
    cell = shapely.box(*lattice.cell)
    for a in range(-6, 7):
        for b in range(-12, 13):
            shift = (a * lattice.width, a * lattice.drop + b * lattice.height)
            meets = moved(shapely.box(*bounds), shift).intersects(cell)
            assert meets == (tuple(np.round(shift, 6)) in found)
