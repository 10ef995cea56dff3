"""Poses to points and back: values by matrices, the way back as the exact transpose."""

from __future__ import annotations

import numpy as np
import pytest

from numerics import assert_gradient
from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.solve.outlines import Ensemble
from scenes import as_array, box, disc, from_array, placed, poses, square, star

PX_PER_CU = 0.75


def holed() -> Outline:
    """Square with a square hole off its middle."""
    return Outline.from_region(box(-3, -3, 3, 3).region - box(-1, -2, 2, 1).region)


def test_points_stand_where_the_matrix_puts_them(rng: np.random.Generator) -> None:
    outlines = [square(), holed(), star()]
    where = poses(*rng.normal(size=(3, 3)), [0.5, 2.0, 3.0], [1.0, 0.4, 2.5])
    points = Ensemble(outlines).place(where, PX_PER_CU)
    expected = np.concatenate([outline.points for outline in placed(outlines, where)])
    np.testing.assert_allclose(points, PX_PER_CU * expected, atol=1e-12)


def test_rings_start_where_their_items_put_them() -> None:
    starts = Ensemble([square(), holed(), square()]).ring_starts
    assert starts.tolist() == [0, 4, 8, 12, 16]


@pytest.mark.parametrize("outlines", [[star()], [square(), holed(), disc(2.0, 7), star()]])
def test_gather_is_the_transpose_of_the_derivative_of_place(
    outlines: list[Outline], rng: np.random.Generator
) -> None:
    n = len(outlines)
    ensemble = Ensemble(outlines)
    at = np.column_stack([rng.normal(size=(n, 3)), rng.uniform(-1, 1, (n, 2))])
    pull = rng.normal(size=ensemble.place(from_array(at), PX_PER_CU).shape)

    def value(numbers: FloatArray) -> float:
        return float(np.vdot(pull, ensemble.place(from_array(numbers), PX_PER_CU)))

    ensemble.place(from_array(at), PX_PER_CU)
    gathered = ensemble.gather(pull, from_array(at), PX_PER_CU).copy()
    assert_gradient(value, gathered, at, error=1e-7)


def test_as_array_and_from_array_are_inverse(rng: np.random.Generator) -> None:
    where = poses(rng.normal(size=4), 1.0, 2.0, rng.uniform(1, 2, 4), rng.uniform(1, 2, 4))
    again = from_array(as_array(where))
    np.testing.assert_allclose(again.scale, where.scale)
    np.testing.assert_allclose(again.stretch, where.stretch)
    np.testing.assert_array_equal(again.x, where.x)


def test_sums_per_item_are_sums_over_its_rings() -> None:
    ensemble = Ensemble([square(), holed(), square()])
    assert ensemble.per_item(np.array([1.0, 20.0, 300.0, 4.0])).tolist() == [1.0, 320.0, 4.0]
