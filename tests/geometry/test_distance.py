"""Distances of regions, and snap rounding."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.geometry import affine
from packwork.geometry import distance as distance_module
from packwork.geometry.distance import (
    CLEFT,
    STEP,
    clearance,
    distance,
    is_clear,
    snap_rounded,
    without_clefts,
)
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import polygon_parts, valid
from packwork.geometry.polygon import region
from strategies import ring_sets


def _star(rng: np.random.Generator) -> shapely.Geometry:
    """A ragged region of one ring or, where that crosses itself, several."""
    count = int(rng.integers(3, 40))
    angle, radius = np.sort(rng.random(count)) * 2 * np.pi, 0.2 + rng.random(count)
    ring = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    return valid(shapely.Polygon(ring))


def test_an_index_tells_the_same_distance(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of regions, lines, regions that meet, and one inside another."""
    monkeypatch.setattr(distance_module, "FEW_PAIRS", 0)
    rng = np.random.default_rng(0)
    for _ in range(100):
        first, second = _star(rng), shapely.affinity.translate(_star(rng), 4 * rng.random())
        for one in (first, first.boundary):
            for pair in ((one, second), (second, one)):
                assert distance(*pair) == pytest.approx(shapely.distance(*pair), abs=1e-12)
    assert distance(shapely.box(0, 0, 9, 9), shapely.box(4, 4, 5, 5)) == 0
    assert distance(shapely.Polygon(), shapely.box(0, 0, 1, 1)) == math.inf


def test_edges_that_are_far_enough_are_told_from_those_that_are_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Just below and just above the clearance that GEOS finds, holes and parts included."""
    rng = np.random.default_rng(1)
    for _ in range(100):
        shape = shapely.union_all([_star(rng), shapely.affinity.translate(_star(rng), 1.5)])
        region = shapely.MultiPolygon(polygon_parts(shape))
        found = float(shapely.minimum_clearance(region))
        assert clearance(region, 9.0) == pytest.approx(found, rel=1e-12)
        assert clearance(region, found / 2) == found / 2
        for few in (0, 20_000):
            monkeypatch.setattr(distance_module, "FEW_VERTICES", few)
            assert is_clear(region, found * (1 - 1e-9))
            assert not is_clear(region, found * (1 + 1e-9))


def test_a_spiral_of_many_turns_is_looked_at_once() -> None:
    """Turns that are all equally near: each edge has its own neighbours to look at, no more."""
    turn = np.linspace(2 * np.pi, 200 * np.pi, 20_000)
    line = np.column_stack([turn * np.cos(turn), turn * np.sin(turn)])
    out = line * (1 + 0.2 * 2 * np.pi / turn)[:, None]
    spiral = shapely.Polygon(np.concatenate([line, out[::-1]]))
    assert shapely.is_valid(spiral)
    assert is_clear(spiral, 1e-3)
    assert not is_clear(spiral, 2.0)


_SIZES = st.sampled_from([1e-3, 1.0, 1e6])


_SLIPS = st.sampled_from([0.0, 1e-13, 1e-9, 1e-7, 1e-5])


TINY = (1e-160, 2.99e-218, 1e-310)


def extent_of(shape: shapely.Geometry) -> float:
    left, top, right, bottom = shape.bounds
    return float(max(right - left, bottom - top))


@pytest.mark.parametrize("tiny", TINY)
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e6])
def test_differences_near_the_smallest_numbers_raise_no_warning(tiny: float, size: float) -> None:
    ring = size * np.array([[0.0, 0.0], [0.0, tiny], [1.0, 0.0]])
    crossed = size * np.array([[1, -1], [-tiny, 0], [0, 1], [0, -1], [1, 0.0]])
    assert snap_rounded(region([ring], "evenodd")).area == 0
    assert snap_rounded(region([crossed], "evenodd")).is_valid


@given(ring_sets(), _SIZES, _SLIPS, st.integers(0, 99), st.booleans())
@settings(deadline=None, max_examples=80)
def test_sound_regions_stay_valid_when_turned_and_rounded(
    rings: list[np.ndarray], size: float, slip: float, seed: int, doubled: bool
) -> None:
    rng = np.random.default_rng(seed)
    # Each ring twice, a hair apart: edges that all but coincide.
    both = [*rings, *(ring[::-1] + slip for ring in rings)] if doubled else rings
    wild = region([size * (r + rng.normal(0, slip, r.shape)) for r in both], "evenodd")
    clean = snap_rounded(wild)
    if clean.area == 0:
        return
    extent, before = extent_of(clean), extent_of(wild)
    assert shapely.minimum_clearance(clean) >= 0.49 * STEP * extent
    # Of slivers a speck may be left: the step is a share of what there was.
    assert abs(clean.area - wild.area) <= 20 * STEP * before * max(wild.length, before)
    outline = Outline.from_region(clean)
    for angle in rng.uniform(0, 6.28, 3):
        placed = outline.mapped(affine.similarity(70.0, 30.0, float(angle), 50.0 / extent))
        assert placed.region.is_valid
        assert shapely.transform(placed.region, lambda p: np.round(p, 7)).is_valid


def test_a_ring_that_all_but_touches_itself_is_parted() -> None:
    # Two squares joined by a neck without width.
    neck = 1e-13
    shape = shapely.Polygon(
        [(0, 0), (2, 0), (2, 1 - neck), (3, 1), (3, 0), (5, 0), (5, 2), (3, 2), (3, 1 + neck),
         (2, 1 + neck), (2, 2), (0, 2)]
    )  # fmt: skip
    assert shape.is_valid
    assert snap_rounded(shape).geom_type == "MultiPolygon"
    assert abs(snap_rounded(shape).area - 8) < 1e-5


def test_a_bay_whose_mouth_a_file_could_close_is_filled() -> None:
    ring = shapely.box(0, 0, 10, 10) - shapely.box(2, 2, 8, 8)
    for mouth, is_filled in ((0.1 * CLEFT, True), (5 * CLEFT, False)):
        slit = ring - shapely.box(5, -1, 5 + 10 * mouth, 5)
        assert (without_clefts(slit).area > 90) is is_filled


def test_a_sound_region_is_left_alone() -> None:
    star = shapely.Point(0, 0).buffer(3.0)
    assert snap_rounded(star) is star
    assert without_clefts(star) is star
