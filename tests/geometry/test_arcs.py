"""Lines with arcs: flattened, turned round, mapped, and other curves as arcs."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.geometry.arcs import ArcLine, arcs_along, circle, ellipse

bulges = st.floats(-3, 3).filter(lambda bulge: abs(bulge) > 1e-6)
ends = st.tuples(st.floats(-50, 50), st.floats(-50, 50))


def one_arc(start: tuple[float, float], end: tuple[float, float], bulge: float) -> ArcLine:
    return ArcLine(np.array([start, end]), np.array([bulge, 0.0]))


def centre_of(line: ArcLine) -> tuple[np.ndarray, float]:
    """Centre and radius by three points of it, flattened coarsely."""
    a, b, c = line.flattened(math.inf if len(line.points) > 2 else 1e-3)[[0, 1, -1]]
    matrix = 2 * np.array([b - a, c - a])
    centre = np.linalg.solve(matrix, [b @ b - a @ a, c @ c - a @ a])
    return centre, float(np.hypot(*(a - centre)))


@given(start=ends, end=ends, bulge=bulges, tolerance=st.floats(1e-5, 1e-1))
@settings(deadline=None)
def test_corners_lie_on_the_circle_and_chords_off_it_by_the_tolerance(
    start: tuple[float, float], end: tuple[float, float], bulge: float, tolerance: float
) -> None:
    if math.dist(start, end) < 1:
        return
    line = one_arc(start, end, bulge)
    points = line.flattened(tolerance)
    assert points[0].tolist() == list(start)
    assert points[-1].tolist() == list(end)
    if len(points) < 3 or abs(bulge) < 1e-2:
        return
    centre, radius = centre_of(line)
    assert np.hypot(*(points - centre).T) == pytest.approx(np.full(len(points), radius), rel=1e-6)
    middles = (points[1:] + points[:-1]) / 2
    assert radius - np.hypot(*(middles - centre).T).min() < tolerance * (1 + 1e-6) + 1e-6 * radius


@given(rows=st.lists(st.tuples(st.floats(5, 20), st.floats(-0.5, 0.5)), min_size=3, max_size=8))
@settings(deadline=None)
def test_around_a_ring_lies_all_of_it(rows: list[tuple[float, float]]) -> None:
    turns = 2 * np.pi * np.arange(len(rows)) / len(rows)
    radii, bent = np.array(rows).T
    points = radii[:, None] * np.column_stack([np.cos(turns), np.sin(turns)])
    ring = ArcLine(points, bent, is_closed=True)
    true = shapely.Polygon(ring.flattened(1e-7))
    if not true.is_valid:
        return
    about = shapely.Polygon(ring.flattened(1e-2, around=True))
    assert shapely.area(shapely.difference(true, about)) < 1e-6
    assert about.area - true.area < 1.1e-2 * true.length
    assert shapely.Polygon(ring.reversed().flattened(1e-7)).area == pytest.approx(true.area)


@given(turn=st.floats(0, 6), scale=st.floats(0.1, 9), flips=st.booleans(), bulge=bulges)
@settings(deadline=None)
def test_a_similar_map_moves_the_points_and_keeps_the_bulges(
    turn: float, scale: float, flips: bool, bulge: float
) -> None:
    c, s = scale * math.cos(turn), scale * math.sin(turn)
    matrix = np.array([[c, -s, 7.0], [s, c, -3.0]]) * ([-1.0, 1.0, 1.0] if flips else 1.0)
    line = one_arc((0, 0), (5, 2), bulge)
    mapped = line.mapped(matrix, 1e-6)
    assert mapped.bulges.tolist() == [-bulge if flips else bulge, 0.0 if not flips else -0.0]
    there = line.flattened(1e-3) @ matrix[:, :2].T + matrix[:, 2]
    assert np.abs(mapped.flattened(1e-3 * scale) - there).max() < 1e-6


def test_a_stretched_circle_is_an_ellipse_within_the_tolerance() -> None:
    ring = circle((2.0, 1.0), 3.0).mapped(np.array([[2.0, 0, 0], [0, 1.0, 0]]), 1e-5)
    assert ring.is_closed
    points = ring.flattened(1e-7)
    off = np.abs(np.hypot((points[:, 0] - 4) / 6, (points[:, 1] - 1) / 3) - 1)
    assert off.max() * 6 < 2e-5
    assert len(ring.points) < 300


@given(ratio=st.floats(0.05, 1.0), tolerance=st.floats(1e-7, 1e-3))
@settings(deadline=None, max_examples=30)
def test_an_ellipse_is_met_within_the_tolerance(ratio: float, tolerance: float) -> None:
    axes = np.array([1.0, 0]), np.array([0, ratio])
    line = ellipse(np.zeros(2), *axes, (0.3, 5.0), tolerance)
    turns = np.linspace(0.3, 5.0, 400)
    truth = np.column_stack([np.cos(turns), ratio * np.sin(turns)])
    flat = shapely.LineString(line.flattened(tolerance / 10))
    assert shapely.distance(flat, shapely.points(truth)).max() < 1.5 * tolerance


def test_a_curve_with_a_kink_in_a_part_ends() -> None:
    def curve(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return np.column_stack([t, abs(t)]), np.column_stack([np.ones(len(t)), np.sign(t)])

    line = arcs_along(curve, np.array([-1.0, 0.7]), 1e-6)
    assert np.abs(line.points[:, 1] - abs(line.points[:, 0])).max() < 1e-3
    assert len(line.points) < 100
