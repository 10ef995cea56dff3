"""Chains of cubics: points, derivatives, loops."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from numerics import assert_adjoint
from packwork.arrays import FloatArray
from packwork.fit.chains import (
    Chains,
    bernstein,
    crossings,
    flattened,
    straight_chain,
    without_loops,
)
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


SQUARE = straight_chain(np.array([[0, 0], [8, 0], [8, 8], [0, 8.0]]))


def ring_of(chain: FloatArray) -> shapely.LinearRing:
    return shapely.LinearRing(np.concatenate(flattened(chain, 0.002)))


def with_knot_at_a_corner(corner: int) -> FloatArray:
    """Square whose sides run past one corner, cross, and come back to it."""
    chain = SQUARE.copy()
    into = (SQUARE[corner, 0] - SQUARE[corner - 1, 0]) / 8
    out = (SQUARE[(corner + 1) % 4, 0] - SQUARE[corner, 0]) / 8
    chain[corner - 1, 2] = SQUARE[corner, 0] + 0.3 * into + 2 * out
    chain[corner, 1] = SQUARE[corner, 0] - 2 * into - 0.3 * out
    return chain


@pytest.mark.parametrize("corner", range(4))
def test_a_knot_at_a_cut_is_trimmed(corner: int) -> None:
    chain = with_knot_at_a_corner(corner)
    assert not ring_of(chain).is_simple
    mended = without_loops(chain, 0.002)
    assert mended is not None
    assert ring_of(mended).is_simple
    assert shapely.Polygon(ring_of(mended)).area == pytest.approx(64, abs=8)


def test_a_loop_of_one_curve_goes_away() -> None:
    chain = SQUARE.copy()
    chain[1, 1:] = [[10, 10], [10, -2]]
    assert not ring_of(chain).is_simple
    mended = without_loops(chain, 0.002)
    assert mended is not None
    assert ring_of(mended).is_simple
    assert mended[:, 0].tolist() == chain[:, 0].tolist()


def test_a_simple_chain_comes_back_as_it_was() -> None:
    assert np.array_equal(without_loops(SQUARE, 0.002), SQUARE)


def test_a_crossing_of_strangers_is_not_mended() -> None:
    bow_tie = np.array([[0, 0], [8, 8], [9, 4], [8, 0], [0, 8], [-1, 4.0]])
    assert without_loops(straight_chain(bow_tie), 0.002) is None


def test_crossings_tell_where_they_are() -> None:
    bow_tie = straight_chain(np.array([[0, 0], [8, 8], [8, 0], [0, 8.0]]))
    found = crossings(flattened(bow_tie, 0.002))
    assert [(c.one, c.two) for c in found] == [(0, 2)]
    assert [found[0].t_one, found[0].t_two] == pytest.approx([0.5, 0.5])
