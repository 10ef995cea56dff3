"""Polygons of curves as chains of arcs."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from packwork.geometry.arc_chains import arcs_through
from packwork.geometry.arcs import circle


def _polygon(points: np.ndarray) -> shapely.Polygon:
    return shapely.Polygon(points)


def test_discs_that_overlap_are_as_many_arcs_as_they_show() -> None:
    discs = [_polygon(circle((x, 0.0), 5.0).flattened(1e-4)) for x in (0.0, 6.0)]
    edge = shapely.get_coordinates(shapely.union_all(discs).exterior)[:-1]
    line = arcs_through(edge, 1e-6, 3e-4)
    # Where chords meet, between the two, is a corner that lies on neither.
    assert len(line.points) <= 8
    half = np.arccos(3 / 5)
    true = 2 * 25 * (np.pi - half) + 2 * 3 * 4
    assert _polygon(line.flattened(1e-7)).area == pytest.approx(true, rel=1e-6)


def test_what_is_meant_to_be_straight_or_sharp_stays_so() -> None:
    corners = circle((0.0, 0.0), 5.0).flattened(0.02)
    assert not arcs_through(corners, 1e-6, 1e-3).bulges.any()
    star = np.array([[0, 9], [2, 2], [9, 0], [2, -2], [0, -9], [-2, -2], [-9, 0], [-2, 2]], float)
    line = arcs_through(star, 1e-3, 1.0)
    assert sorted(line.points.tolist()) == sorted(star.tolist())
    assert not line.bulges.any()


def test_a_slot_is_two_sides_and_two_arcs() -> None:
    caps = [_polygon(circle((x, 0.0), 2.0).flattened(1e-5)) for x in (0.0, 9.0)]
    edge = shapely.get_coordinates(shapely.union_all(caps).convex_hull.exterior)[:-1]
    line = arcs_through(edge, 1e-6, 3e-5)
    assert sorted(np.abs(line.bulges)) == pytest.approx([0, 0, 1, 1], abs=0.01)


@given(st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6), st.integers(40, 400))
def test_every_corner_lies_on_the_line_and_the_line_near_its_chords(
    waves: list[float], count: int
) -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    radius = 9.0 + sum(a * np.sin((k + 1) * turn + a) for k, a in enumerate(waves))
    points = radius[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    tolerance, chord = 1e-3, 0.05
    line = arcs_through(points, tolerance, chord)
    drawn = shapely.LinearRing(line.flattened(1e-5))
    ring = shapely.LinearRing(points)
    assert shapely.distance(drawn, shapely.points(points)).max() <= tolerance + 2e-5
    assert shapely.hausdorff_distance(drawn, ring) <= chord + 2e-5
