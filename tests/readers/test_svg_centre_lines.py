"""Ends of lines and dashes: corners of caps where they belong."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from packwork.readers.svg.centre_lines import centre_lines
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.path_data import parse_path
from packwork.readers.svg.strokes import Pen

ARC = "M50 10A40 40 0 0 1 90 50"


@pytest.mark.parametrize(("cap", "beyond"), [("butt", 0.0), ("square", 2.0)])
def test_corners_of_caps_of_curves(cap: str, beyond: float) -> None:
    stroke = f'fill="none" stroke="red" stroke-width="4" stroke-linecap="{cap}"'
    ink = read_drawing(f'<svg><path d="{ARC}" {stroke}/></svg>'.encode()).ink.body
    points = shapely.get_coordinates(ink)
    for corner in [(50 - beyond, 8), (50 - beyond, 12), (88, 50 + beyond), (92, 50 + beyond)]:
        assert np.hypot(*(points - corner).T).min() < 3e-5 * 44


def test_the_same_dashes_at_any_tolerance() -> None:
    body = '<circle r="40" fill="none" stroke="red" stroke-width="2" stroke-dasharray="9 4"/>'
    data = f"<svg>{body}</svg>".encode()
    coarse, fine = (read_drawing(data, tolerance=t).ink.whole for t in (None, 1e-5))
    assert len(coarse.geoms) == len(fine.geoms) == 19
    assert shapely.hausdorff_distance(coarse, fine) < 1e-4 * 82


def test_points_stay_few_and_corners_stay() -> None:
    (piece,) = parse_path(f"M0 0L20 5{ARC.replace('M', 'L')}")
    ((line, is_closed),) = centre_lines([piece], Pen(2.0), 1e-3)
    assert not is_closed
    assert len(line) < 250
    assert [20.0, 5.0] in line.tolist()
    distances = shapely.distance(
        shapely.LineString(line), shapely.points(centre_lines([piece], Pen(), 1e-5)[0][0])
    )
    assert distances.max() < 1.01e-3
