"""Ends of lines and dashes: corners of caps where they belong."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.strokes import (
    FinePoints,
    open_stroke,
    piece_strokes,
    stroke_region,
)
from packwork.readers.svg_syntax.painted import StrokeStyle
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.readers.svg_syntax.shapes import flattened

ARC = "M50 10A40 40 0 0 1 90 50"


@pytest.mark.parametrize("width", [4.0, 20.0, 40.0])
@pytest.mark.parametrize("cap", ["butt", "square"])
def test_corners_of_caps_of_curves(cap: str, width: float) -> None:
    stroke = f'fill="none" stroke="red" stroke-width="{width}" stroke-linecap="{cap}"'
    ink = read_drawing(f'<svg><path d="{ARC}" {stroke}/></svg>'.encode()).ink.body
    points = shapely.get_coordinates(ink)
    near, far = 40 - width / 2, 40 + width / 2
    beyond = width / 2 if cap == "square" else 0.0
    for x, y in [(-beyond, -far), (-beyond, -near), (near, beyond), (far, beyond)]:
        assert np.hypot(*(points - (50 + x, 50 + y)).T).min() < 5e-5 * (40 + width)
    sector = np.pi / 4 * (far**2 - near**2) + 2 * width * beyond
    assert ink.area == pytest.approx(sector, rel=2e-4)


def test_the_same_dashes_at_any_tolerance() -> None:
    body = '<circle r="40" fill="none" stroke="red" stroke-width="2" stroke-dasharray="9 4"/>'
    data = f"<svg>{body}</svg>".encode()
    coarse, fine = (read_drawing(data, tolerance=t).ink.whole for t in (None, 1e-5))
    assert len(coarse.geoms) == len(fine.geoms) == 19
    assert shapely.hausdorff_distance(coarse, fine) < 2.5e-5 * 82


@pytest.mark.parametrize("cap", ["butt", "square"])
@pytest.mark.parametrize("data", [f"M0 0L20 5{ARC.replace('M', 'L')}", "M0 0C0 30 60 30 60 0V-20"])
def test_lines_that_are_straight_at_one_end(data: str, cap: str) -> None:
    (piece,) = parse_path(data)
    pen = StrokeStyle(4.0, cap)
    (got,) = piece_strokes([piece], pen, 1e-3, FinePoints())
    expected = stroke_region(flattened(piece, 1e-7), False, pen, 1e-3)
    assert got.symmetric_difference(expected).area < 1e-3 * expected.length
    assert len(shapely.get_coordinates(got)) < 1_500


@pytest.mark.parametrize("span", [1e-3, 0.02, 0.2, 1.5, 6.0])
@pytest.mark.parametrize("width", [1.0, 6.0, 12.0])
def test_arcs_of_any_length_and_width(span: float, width: float) -> None:
    turns = np.linspace(0.0, span, 2_000)
    unit = np.column_stack([np.cos(turns), np.sin(turns)])
    got = open_stroke(10 * unit, StrokeStyle(width), 1e-3)
    near, far = (10 - width / 2) * unit, (10 + width / 2) * unit
    sector = shapely.Polygon(np.concatenate([near, far[::-1]]))
    assert got.is_valid
    assert got.symmetric_difference(sector).area < 3e-3 * sector.length


def test_what_is_followed_finer_is_bounded() -> None:
    (piece,) = parse_path(ARC)
    spent = FinePoints()
    spent.factor(1e9)
    (plain,), (fine,) = (
        piece_strokes([piece], StrokeStyle(4.0), 1e-3, points) for points in (spent, FinePoints())
    )
    assert shapely.hausdorff_distance(plain, fine) < 0.05
