"""Curves by their arc length: places, headings, and curves beside them."""

from __future__ import annotations

import numpy as np
import pytest

from packwork.geometry.curves import Curve

ANGLES = np.linspace(np.pi, 2 * np.pi, 200)
ARCH = Curve(10 * np.column_stack([np.cos(ANGLES), np.sin(ANGLES)]))
"""Half a circle over its middle, from left to right."""


def test_arc_lengths_are_those_of_the_circle() -> None:
    assert ARCH.length == pytest.approx(10 * np.pi, rel=1e-4)
    assert ARCH.at(ARCH.length / 2) == pytest.approx([0, -10], abs=1e-2)


def test_it_goes_straight_on_beyond_its_ends() -> None:
    line = Curve(np.array([[0.0, 0.0], [2.0, 0.0]]))
    assert line.at(np.array([-1.0, 5.0])).tolist() == [[-1, 0], [5, 0]]


def test_headings_turn_once_round_half_a_circle() -> None:
    turns = ARCH.turning(1.0, ARCH.length - 1.0, 1.0)
    assert turns.sum() == pytest.approx(np.pi, rel=0.15)
    assert np.ptp(turns) < 1e-2


def test_a_curve_to_the_right_of_one_over_the_middle_is_shorter() -> None:
    inner = ARCH.shifted(np.full(200, 2.0))
    assert inner.length == pytest.approx(8 * np.pi, rel=2e-3)
    assert np.hypot(*inner.points.T) == pytest.approx(8, abs=1e-2)


def test_the_other_way_round_it_is_as_long() -> None:
    assert ARCH.reversed().at(3.0) == pytest.approx(ARCH.at(ARCH.length - 3.0))


def test_points_that_are_twice_in_a_row_are_one() -> None:
    assert len(Curve.through(np.array([[0.0, 0], [0, 0], [1, 0]])).points) == 2
