"""Covers of outlines of several parts, which are simplified once for all that hold them."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.arrays import FloatArray
from packwork.compaction.outer_simplify import Covers
from packwork.geometry.outline import Outline

TOLERANCE = 0.02


def _blob(phase: float = 0.0) -> FloatArray:
    angle = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    radius = 1 + 0.3 * np.sin(3 * angle + phase)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def _moved(ring: FloatArray, x: float, y: float = 0.0) -> FloatArray:
    return ring + np.array([x, y])


@pytest.mark.parametrize("apart", [4.0, 2.7])
def test_a_cover_holds_all_parts(apart: float) -> None:
    """Of fewer vertices, by hardly more area, whether boxes of parts meet or not."""
    outline = Outline.from_rings(
        [_blob(), _moved(_blob(1.0), apart, 0.5), _moved(_blob(), 2 * apart)]
    )
    cover = Covers().cover(outline, TOLERANCE)
    assert cover.region.is_valid
    assert cover.region.covers(outline.region)
    assert len(cover.points) < len(outline.points) / 3
    assert cover.area < outline.area + 2 * TOLERANCE * outline.region.length


def test_parts_that_recur_are_simplified_once() -> None:
    """Wherever they lie, and in whichever outline; of other tolerances again."""
    covers = Covers()
    rng = np.random.default_rng(0)
    for _ in range(5):
        x = 3 * np.arange(4) + rng.random(4) * 0.1
        rings = [_moved(_blob(), along, rng.random()) for along in x]
        cover = covers.cover(Outline.from_rings(rings), TOLERANCE)
        assert cover.region.covers(Outline.from_rings(rings).region.buffer(-1e-9))
    assert len(covers.known) == 1
    covers.cover(Outline.from_rings(rings), TOLERANCE / 4)
    assert len(covers.known) == 2


def test_parts_whose_covers_would_meet_become_one() -> None:
    """Two tiles a hair apart: no rings that cross each other."""
    tile = np.array([[0.0, 0], [1, 0], [1, 1], [0.5, 1.001], [0, 1]])
    outline = Outline.from_rings([tile, _moved(tile, 1 + 1e-4)])
    cover = Covers().cover(outline, TOLERANCE)
    assert cover.region.is_valid
    assert cover.region.covers(outline.region)


def test_parts_with_holes_and_islands_in_them_keep_them() -> None:
    """Letters whose counters are free, one in the counter of another."""
    ring = [3 * _blob(), (2 * _blob())[::-1]]
    outline = Outline.from_rings([*ring, *(one / 4 for one in ring), _moved(_blob(), 9.0)])
    covers = Covers()
    cover = covers.cover(outline, TOLERANCE)
    assert cover.region.is_valid
    assert cover.region.covers(outline.region)
    assert (len(cover.rings), len(covers.known)) == (5, 3)
    assert cover.area < outline.area + 2 * TOLERANCE * outline.region.length
