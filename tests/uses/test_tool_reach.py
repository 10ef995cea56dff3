"""Places that a round tool cannot enter."""

from __future__ import annotations

import logging
import math

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import packwork as pw
from packwork.uses.tool_reach import Unreached, unreached

PLATE = shapely.box(0, 0, 100, 60)


@given(width=st.floats(1, 20), tool=st.floats(2, 15))
@settings(deadline=None, max_examples=40)
def test_a_round_hole_and_a_slot_are_entered_where_they_are_as_wide(
    width: float, tool: float
) -> None:
    if abs(width - tool) < 0.02 * tool:
        return
    hole = shapely.Point(30, 30).buffer(width / 2, quad_segs=64)
    slot = shapely.box(70, 10, 70 + width, 60)
    found = unreached(PLATE - hole - slot, tool)
    assert len(found.narrow) == (2 if width < tool else 0)
    assert found.corners == (0 if width < tool else 2)


@given(angle=st.floats(0, 2 * math.pi), tool=st.floats(2, 9), sides=st.integers(3, 5))
@settings(deadline=None, max_examples=40)
def test_inner_corners_stay_round_and_outer_ones_do_not(
    angle: float, tool: float, sides: int
) -> None:
    turns = [angle + 2 * math.pi * k / sides for k in range(sides)]
    window = shapely.Polygon([(50 + 25 * math.cos(t), 30 + 25 * math.sin(t)) for t in turns])
    assert unreached(PLATE - window, tool) == Unreached((), sides)
    assert unreached(window, tool) == Unreached((), 0)


def test_parts_are_named_and_lie_as_far_apart(caplog: pytest.LogCaptureFixture) -> None:
    part = PLATE - shapely.box(10, 10, 30, 14) - shapely.box(60, 20, 90, 50)
    with caplog.at_level(logging.WARNING):
        found = pw.nest("300x200mm", [(part, 2), (PLATE, 1)], tool="6mm", passes=60)
    first, second, third = (outline.region for outline in found.layouts[0].outlines)
    assert min(first.distance(second), second.distance(third), third.distance(first)) >= 6
    (said,) = (record.message for record in caplog.records if "tool" in record.message)
    assert said == (
        "part: a tool of 6 mm does not enter 1 narrow place, at (20, 48) mm from the lower left "
        "corner; it leaves 4 inner corners round"
    )
