"""Rings keep clear of themselves, so that no digit that is rounded away matters."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import region
from packwork.geometry.snapping import CLEFT, STEP, snap_rounded, without_clefts
from strategies import ring_sets

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
