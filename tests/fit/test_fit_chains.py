"""Chains of cubics: their polygons, the way back, straight ones."""

from __future__ import annotations

import numpy as np
import pytest

from numerics import assert_adjoint
from packwork.arrays import FloatArray
from packwork.fit.chains import Chains, bernstein, flattened, straight_chain
from packwork.geometry.bezier import flatten_cubic


@pytest.mark.parametrize("steps", [1, 2, 16])
def test_the_basis_is_a_partition_of_one(steps: int) -> None:
    assert bernstein(steps).sum(axis=1) == pytest.approx(1)
    assert bernstein(steps)[0].tolist() == [1, 0, 0, 0]


def test_polygons_run_along_the_curves(rng: np.random.Generator) -> None:
    chain = rng.normal(size=(3, 3, 2))
    points = Chains([3], 8).points(chain).reshape(3, 8, 2)
    for k in range(3):
        end = chain[(k + 1) % 3, 0]
        # A tolerance that asks for exactly eight steps.
        bend = max(
            np.hypot(*(chain[k, 0] - 2 * chain[k, 1] + chain[k, 2])),
            np.hypot(*(chain[k, 1] - 2 * chain[k, 2] + end)),
        )
        along = flatten_cubic(*chain[k], end, tolerance=6 * bend / (8 * 7.5**2))
        assert points[k, 0] == pytest.approx(chain[k, 0])
        assert points[k, 1:] == pytest.approx(along[:-1])


def test_every_chain_closes_on_itself(rng: np.random.Generator) -> None:
    controls = rng.normal(size=(7, 3, 2))
    both = Chains([3, 4], 5)
    assert both.starts.tolist() == [0, 15, 35]
    apart = [Chains([3], 5).points(controls[:3]), Chains([4], 5).points(controls[3:])]
    assert both.points(controls) == pytest.approx(np.concatenate(apart))


@pytest.mark.parametrize("counts", [[4], [1, 4, 2]])
def test_gather_is_the_transpose_of_points(counts: list[int], rng: np.random.Generator) -> None:
    chains = Chains(counts, 6)
    controls = rng.normal(size=(sum(counts), 3, 2))
    by_points = rng.normal(size=(6 * sum(counts), 2))
    assert_adjoint(chains.points, chains.gather, controls, by_points)


def test_a_straight_chain_flattens_to_its_polygon() -> None:
    ring: FloatArray = np.array([[0, 0], [4, 0], [1, 3.0]])
    points = np.concatenate(flattened(straight_chain(ring), 0.01))
    assert points.tolist() == np.roll(ring, -1, axis=0).tolist()
