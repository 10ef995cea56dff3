"""Path data, arcs and shapes to curves, and curves to points."""

from __future__ import annotations

import math
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.readers.svg_syntax.path_data import arc_cubics, parse_path
from packwork.readers.svg_syntax.shapes import flattened, shape_pieces


def ends(data: str) -> list[tuple[float, float]]:
    return [tuple(cubic[3].tolist()) for piece in parse_path(data) for cubic in piece.segments]


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        ("M1 2L3 4", [(3, 4)]),
        ("M1,2,3,4,5,6", [(3, 4), (5, 6)]),
        ("m1 2 1 1", [(2, 3)]),
        ("M1-2L.5.5", [(0.5, 0.5)]),
        ("M0 0h1v2H-1V-2", [(1, 0), (1, 2), (-1, 2), (-1, -2)]),
        ("M0 0 1e1 1E+1", [(10, 10)]),
        ("M0 0h5zl1 1", [(5, 0), (1, 1)]),
        ("M0 0L1 1 2", [(1, 1)]),
        ("M0 0L1 1 oops L2 2", [(1, 1)]),
        ("oops M0 0L1 1", []),
        ("L1 1", []),
        ("", []),
        ("M0 0a1 1 0 0 0 0 0", []),
        ("M0 0A0 5 0 0 0 4 4", [(4, 4)]),
    ],
)
def test_path_data(data, expected):
    assert ends(data) == expected


def test_smooth_commands_mirror_only_their_own_kind():
    cubics = parse_path("M0 0C0 1 1 1 2 0S4 1 4 0")[0].segments
    assert cubics[1, 1].tolist() == [3.0, -1.0]
    plain = parse_path("M0 0L2 0S4 1 4 0")[0].segments
    assert plain[1, 1].tolist() == [2.0, 0.0]


@pytest.mark.parametrize("radius", [5e-324, 1e-320, 1e-12])
def test_arcs_too_small_for_their_place_are_lines(radius):
    end = (24.0, radius)
    assert arc_cubics((24.0, 0.0), end, (radius, radius, 0), 0, 1) == [((24.0, 0.0), end, end)]
    tile = ET.Element("rect", {"width": "24", "height": "150", "rx": repr(radius)})
    (rounded,) = shape_pieces(tile, (24.0, 150.0))
    assert np.isfinite(rounded.segments).all()


@settings(deadline=None)
@given(st.floats(0.1, 50), st.floats(0.1, 50), st.floats(-180, 180), st.booleans(), st.booleans())
def test_arcs_lie_on_an_ellipse(rx, ry, turn, large, sweep):
    start, end = (3.0, -4.0), (17.0, 9.0)
    cubics = np.array(arc_cubics(start, end, (rx, ry, turn), large, sweep))
    points = np.vstack([[start], cubics[:, 2]])
    angle = math.radians(turn)
    back = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    flat = points @ back.T / (rx, ry)
    assert cubics[-1, 2].tolist() == list(end)
    if len(flat) >= 4:
        # A circle through three points holds the others.
        a, b, c = flat[0], flat[len(flat) // 2], flat[-1]
        rows = 2 * np.array([b - a, c - a])
        centre = np.linalg.solve(rows, [b @ b - a @ a, c @ c - a @ a])
        radii = np.hypot(*(flat - centre).T)
        assert np.ptp(radii) < 1e-6 * radii.mean()


def test_flattening_keeps_its_tolerance():
    circle = parse_path("M-50 0a50 50 0 0 1 100 0a50 50 0 0 1-100 0z")[0]
    ring = flattened(circle, 2e-3)
    middles = (ring + np.roll(ring, -1, axis=0)) / 2
    assert np.abs(np.hypot(*ring.T) - 50).max() < 1e-5
    assert np.abs(np.hypot(*middles.T) - 50).max() < 2.1e-3
    assert len(ring) < 400
