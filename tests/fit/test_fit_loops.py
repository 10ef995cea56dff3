"""Loops cut off: the region stays, the crossing goes."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.arrays import FloatArray
from packwork.fit.chains import crossings, flattened, straight_chain, without_loops

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
