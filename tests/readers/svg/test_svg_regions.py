"""Rings to regions, and dashes."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.geometry.polygon import region
from packwork.readers.budget.crossings import Allowance
from packwork.readers.reading import TooRichError
from packwork.readers.svg.ink import filled
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg.strokes import dashed

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{}</svg>'
RING = '<circle cx="50" cy="50" r="40" fill="none" stroke="#000" stroke-width="4" {}/>'


def item_of(body: str, holes: str = "fill"):
    return item_of_svg(PAGE.format(body).encode(), "a", "a.svg", holes)


def polygon(centre, radius, corners, turn) -> np.ndarray:
    angle = turn * np.linspace(0, 2 * np.pi, corners, endpoint=False)
    return np.asarray(centre) + radius * np.column_stack([np.cos(angle), np.sin(angle)])


RINGS = st.lists(
    st.builds(
        polygon,
        st.tuples(st.integers(0, 9), st.integers(0, 9)),
        st.floats(0.5, 6.0),
        st.integers(3, 9),
        st.sampled_from([-1, 1]),
    ),
    min_size=1,
    max_size=7,
)


@settings(deadline=None)
@given(RINGS, st.sampled_from(["nonzero", "evenodd"]))
def test_rings_fill_what_noding_says(rings, rule):
    quick, slow = filled(rings, rule, Allowance(1e9)), region(rings, rule)
    assert quick.is_valid
    assert shapely.symmetric_difference(quick, slow).area < 1e-9


@pytest.mark.parametrize("turns", [(1, 1, 1), (1, -1, 1), (1, 1, -1), (1, -1, -1), (-1, -1, -1)])
@pytest.mark.parametrize("rule", ["nonzero", "evenodd"])
def test_nested_rings_fill_what_noding_says(turns, rule):
    rings = [polygon((0, 0), 9 - 2 * k, 12, turn) for k, turn in enumerate(turns)]
    quick, slow = filled(rings, rule, Allowance(0)), region(rings, rule)
    assert shapely.symmetric_difference(quick, slow).area < 1e-9


def test_rings_deep_in_each_other_are_too_rich():
    rings = [polygon((0, 0), 9 - k / 1000, 4, 1) for k in range(2000)]
    with pytest.raises(TooRichError, match="pairs of rings"):
        filled(rings, "evenodd", Allowance(1e9))


@given(
    st.lists(st.integers(0, 9), min_size=2, max_size=6).filter(
        lambda d: len(d) % 2 == 0 and sum(d)
    ),
    st.floats(-20, 20),
    st.booleans(),
)
def test_dashes_are_as_long_as_the_pattern_says(dashes, offset, is_closed):
    line = np.array([[0.0, 0.0], [30.0, 0.0], [30.0, 40.0]])
    parts = dashed(line, is_closed, [float(d) for d in dashes], offset)
    length = 120.0 if is_closed else 70.0
    at = (np.arange(0, length, 0.01) + offset) % sum(dashes)
    ends = np.cumsum(dashes)
    shown = float((np.searchsorted(ends, at, side="right") % 2 == 0).sum()) * 0.01
    drawn = sum(float(np.hypot(*np.diff(part, axis=0).T).sum()) for part in parts)
    assert drawn == pytest.approx(shown, abs=0.02 * (2 + 2 * len(parts)))


def test_a_dash_goes_on_over_the_start_of_a_ring():
    square = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])
    (only,) = dashed(square, True, (20.0, 20.0), 10.0)
    assert only.tolist() == [[0, 10], [0, 0], [10, 0]]


def test_countless_dashes_are_a_solid_line():
    line = np.array([[0.0, 0.0], [10.0, 0.0]])
    assert len(dashed(line, False, (1e-5, 1e-5), 0.0)) == 1


def test_outlines_go_round_dashed_frames():
    item = item_of(RING.format('stroke-dasharray="8 5"'))
    solid = item_of(RING.format(""))
    assert item.outline.area == pytest.approx(solid.outline.area)
    assert item.ink.area == pytest.approx(8 / 13 * solid.ink.area, rel=0.03)


def test_outlines_of_arcs_do_not_close_the_ring():
    item = item_of(RING.format('stroke-dasharray="60 1000"'))
    assert item.outline.area == pytest.approx(60 * 4, rel=0.01)
    assert item.outline.area == pytest.approx(item.ink.area)


def test_hidden_shapes_cost_nothing(monkeypatch):
    from packwork.readers.svg.ink import Follower

    followed = []
    whole = Follower._whole_fill
    monkeypatch.setattr(
        Follower, "_whole_fill", lambda self, shape: followed.append(shape) or whole(self, shape)
    )
    sheet = '<rect width="90" height="90"/>'
    item = item_of('<circle cx="40" cy="40" r="9"/>' * 50 + sheet)
    assert item.ink.area == pytest.approx(8100)
    assert len(set(followed)) == 1
