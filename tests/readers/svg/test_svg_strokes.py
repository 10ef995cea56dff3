"""Pens along lines: corners, caps and closed lines."""

from __future__ import annotations

import math

import numpy as np
import pytest

from packwork.readers.svg.strokes import stroke_region
from packwork.readers.svg_syntax.painted import StrokeStyle


@pytest.mark.parametrize(
    ("pen", "area"),
    [
        (StrokeStyle(2), 40),
        (StrokeStyle(2, "square"), 44),
        (StrokeStyle(2, "round"), 40 + math.pi),
        (StrokeStyle(2, join="bevel"), 39.5),
        (StrokeStyle(2, join="round"), 39 + math.pi / 4),
        (StrokeStyle(2, miter_limit=1.4), 39.5),
        (StrokeStyle(2, miter_limit=1.42), 40),
    ],
)
def test_right_angle(pen, area):
    corner = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]])
    assert stroke_region(corner, False, pen, 1e-5).area == pytest.approx(area, abs=1e-3)


def test_closed_lines_have_no_caps():
    square = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])
    assert stroke_region(square, True, StrokeStyle(2, "square"), 0.01).area == pytest.approx(80)
