"""Fewer points: within the tolerance, still simple, never nothing."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import signed_area
from packwork.geometry.simplify import closed, hull, hull_areas, simplified
from scenes import disc, square, star
from strategies import star_rings

COMB = np.array(
    [[0, 0], [9, 0], [9, 6], [8, 6], [8, 1], [5, 1],
     [5, 6], [4, 6], [4, 1], [1, 1], [1, 6], [0, 6.0]]
)  # fmt: skip
FRAME = Outline.from_region(shapely.box(0, 0, 20, 20) - shapely.box(9, 9, 11, 11))


def _assert_sound(outline: Outline) -> None:
    assert outline.region.is_valid
    assert outline.area > 0
    assert outline.area == pytest.approx(outline.region.area)
    for ring in outline.rings:
        assert shapely.LinearRing(ring).is_simple
        assert signed_area(ring) != 0


@given(ring=star_rings(), tolerance=st.floats(0, 20))
def test_simplified_stays_simple_and_near(ring: FloatArray, tolerance: float) -> None:
    outline = Outline.from_rings([ring])
    fewer = simplified(outline, tolerance)
    _assert_sound(fewer)
    assert len(fewer.points) <= len(outline.points)
    away = shapely.hausdorff_distance(fewer.region.boundary, outline.region.boundary, 0.1)
    assert away <= 2 * tolerance + 1e-9


def test_nothing_collapses() -> None:
    sliver = Outline.from_rings([np.array([[0, 0], [100, 0.1], [200, 0], [100, 0.2]])])
    _assert_sound(simplified(sliver, 50.0))
    _assert_sound(simplified(FRAME, 500.0))


def test_zero_tolerance_and_radius_change_nothing() -> None:
    assert simplified(FRAME, 0.0) is FRAME
    assert closed(FRAME, 0.0) is FRAME


@given(ring=star_rings(), radius=st.floats(0.01, 20))
def test_closed_stays_simple_and_holds_the_old_outline(ring: FloatArray, radius: float) -> None:
    outline = Outline.from_rings([ring])
    wider = closed(outline, radius)
    _assert_sound(wider)
    # Round joins are drawn with few segments: a corner loses a share of the radius.
    corners = shapely.distance(shapely.points(outline.points), wider.region)
    assert float(corners.max()) <= 0.1 * radius
    assert wider.region.within(hull(outline).region.buffer(0.03 * radius + 1e-9))


def test_clefts_close_by_their_width() -> None:
    comb = Outline.from_rings([COMB])
    assert closed(comb, 1.0).area == pytest.approx(comb.area, rel=0.05)
    assert closed(comb, 2.0).area > 0.8 * hull(comb).area


def test_closing_fills_holes() -> None:
    assert closed(FRAME, 2.0).area == pytest.approx(400, rel=1e-3)


@given(ring=star_rings())
def test_hull_is_convex_and_holds_the_outline(ring: FloatArray) -> None:
    outline = Outline.from_rings([ring])
    shape = hull(outline)
    _assert_sound(shape)
    assert outline.region.within(shape.region.buffer(1e-9))
    sides = np.diff(shape.points, axis=0, append=shape.points[:1])
    following = np.roll(sides, -1, axis=0)
    assert (sides[:, 0] * following[:, 1] - sides[:, 1] * following[:, 0] > -1e-9).all()


def test_hull_areas_fill_the_bays() -> None:
    spiky = star()
    areas = hull_areas([square(), spiky, disc(), spiky])
    assert areas[0] == pytest.approx(4)
    assert areas[2] == pytest.approx(disc().area)
    assert areas[1] == areas[3] > 1.2 * spiky.area
