"""Ties between neighbours: slopes and changes against the height itself, and where they lead."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.forces.bonds import SimilarityBond
from packwork.forces.field import ItemGroup


def _tied(count: int) -> tuple[SimilarityBond, FloatArray, FloatArray]:
    rng = np.random.default_rng(3)
    ties = rng.uniform(-1, 1, (count, count))
    ties = (ties + ties.T) / 2
    np.fill_diagonal(ties, 0.0)
    # Close enough that none is beyond the reach of any other.
    return SimilarityBond(ties), rng.uniform(0, 2.0, (count, 2)), rng.uniform(0.5, 1.5, count)


def _group(points: FloatArray, areas: FloatArray) -> ItemGroup:
    return ItemGroup(points, areas, np.zeros(len(points), dtype=np.int64), 10.0)


def test_slopes_are_those_of_the_height() -> None:
    bond, points, areas = _tied(9)
    slopes = bond(_group(points, areas))[1]
    for k, axis in np.ndindex(points.shape):
        step = np.zeros_like(points)
        step[k, axis] = 1e-5
        before, after = (bond(_group(points + s * step, areas))[0].sum() for s in (-1, 1))
        assert np.isclose(slopes[k, axis], (after - before) / 2e-5, rtol=1e-5, atol=1e-9)


def test_changes_are_differences_of_the_height() -> None:
    bond, points, areas = _tied(6)
    places = np.array([[0.5, 0.5], [1.5, 0.2]])
    changes = bond.changes(_group(points, areas), places)
    for k, m in np.ndindex(changes.shape):
        moved = points.copy()
        moved[k] = places[m]
        before, after = (bond(_group(at, areas))[0].sum() for at in (points, moved))
        assert np.isclose(changes[k, m], after - before, atol=1e-12)


def test_what_is_far_is_not_felt() -> None:
    bond = SimilarityBond(np.array([[0.0, 1.0], [1.0, 0.0]]))
    parts, slopes = bond(_group(np.array([[0.0, 0.0], [9.0, 0.0]]), np.ones(2)))
    assert not parts.any()
    assert not slopes.any()
