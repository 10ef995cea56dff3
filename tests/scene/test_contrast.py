"""Colours made readable keep their hue and get the contrast asked for."""

from __future__ import annotations

import colorsys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.scene.colour import css_colour
from packwork.scene.contrast import between, contrast, readable

COLOURS = st.integers(0, 0xFFFFFF).map(lambda number: f"#{number:06x}")


@given(COLOURS, COLOURS, st.floats(1.0, 4.0))
def test_any_colour_becomes_readable_on_any_background(colour, background, least) -> None:
    # Black or white gives 4.58 at least on any background.
    assert contrast(readable(colour, background, least), background) >= least - 0.05


@pytest.mark.parametrize("colour", ["#ffd000", "#40e0d0", "#ff9999"])
def test_hue_stays_and_no_more_changes_than_it_takes(colour: str) -> None:
    found = readable(colour, "white", 3.0)
    assert contrast(found, "white") == pytest.approx(3.0, abs=0.1)
    hues = [
        colorsys.rgb_to_hls(*(channel / 255 for channel in css_colour(c)[:3]))[0]
        for c in (colour, found)
    ]
    apart = abs(hues[0] - hues[1])
    assert min(apart, 1 - apart) < 0.04


def test_colours_in_between_are_even() -> None:
    steps = [between(("#000000", "#ffffff"), share) for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
    assert steps == sorted(steps)
    assert len(set(steps)) == 5
