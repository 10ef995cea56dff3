"""Paths of letters against the way that all other drawings go, and what is left to that."""

import re
from itertools import count

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.geometry.polygon import silhouette
from packwork.readers.gate.door import parse_xml
from packwork.readers.layouts.lettering import LetteringOutlines, lettering_path
from packwork.readers.svg.drawing import read_drawing

GLYPHS = (
    "M0 0C0-40 60-40 60 0C60 40 0 40 0 0ZM20 0C20 15 40 15 40 0C40-15 20-15 20 0Z",
    "M0 0L10 0L10-40L0-40ZM0-45L10-45L10-60L0-60Z",
    "M0 0Q30-60 60 0Q30 60 0 0ZM40 10L70 40L60 45L35 20Z",
    "M0 0L40 0L40 40L0 40ZM10 10L30 10L30 30L10 30ZM15 15L25 15L25 25L15 25Z",
)
RULES = ("nonzero", "evenodd")


def moved(data, x):
    """Path data to the right by ``x``, written as it is."""
    numbers = count()
    tokens = re.findall(r"[A-Z]|-?\d+", data)
    told = [t if t.isalpha() else f"{int(t) + x * (next(numbers) % 2 == 0)} " for t in tokens]
    return re.sub(r" (?=[A-Z])", "", "".join(told))


def painted(data, rule):
    text = f'<svg viewBox="-99 -99 9999 299"><path fill-rule="{rule}" d="{data}"/></svg>'
    ink = read_drawing(text.encode(), tolerance=1e-4).ink.body
    return shapely.transform(ink, lambda points: points - 99)


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.tuples(st.sampled_from(GLYPHS), st.integers(20, 90)), min_size=1, max_size=6),
    st.sampled_from(RULES),
    st.booleans(),
)
def test_letters_are_outlined_as_drawings_are(glyphs, rule, keeps_holes):
    at, parts = 0, []
    for glyph, step in glyphs:
        parts.append(moved(glyph, at))
        at += step
    data = "".join(parts)
    expected = painted(data, rule)
    found = LetteringOutlines(1e-6).outline(data, rule, 1e-4, keeps_holes=keeps_holes)
    whole = expected if keeps_holes else silhouette(expected)
    apart = shapely.symmetric_difference(found.region, whole).area
    assert apart <= 4e-4 * whole.length
    assert found.region.is_valid


def test_what_recurs_is_the_same_to_the_last_bit():
    outlines = LetteringOutlines(1e-6)
    data = moved(GLYPHS[0], 0) + moved(GLYPHS[0], 300)
    rings = outlines.outline(data, "nonzero", 0.1, keeps_holes=True).rings
    assert len(rings) == 4
    assert (rings[0] + np.array([300, 0]) == rings[2]).all()


@pytest.mark.parametrize(
    "data",
    [
        "M0 0h4v4z",
        "M0 0L4 0L4 4",
        "M0 0L4 0L4 4Zx",
        "M0 0L1e1 0L4 4Z",
        "M0 0L4 0L4 4ZM9 9L9.0001 9L9.0001 9.0001Z",
        "M0 0L4 0L8 0Z",
        "M0 0L99999999 0L4 4Z",
        "M0 0L1 0L1 1Z" * 401,
        "",
    ],
    ids=["relative", "open", "strange", "exponent", "speck", "flat", "huge", "many", "empty"],
)
def test_other_paths_are_left_to_the_reader_of_drawings(data):
    assert LetteringOutlines(1e-6).outline(data, "nonzero", 0.01, keeps_holes=False) is None


@pytest.mark.parametrize(
    "text",
    [
        '<path d="M0 0L1 0L1 1Z" fill="none"/>',
        '<path d="M0 0L1 0L1 1Z" fill="url(#a)"/>',
        '<path d="M0 0L1 0L1 1Z" stroke="#000000"/>',
        '<path d="M0 0L1 0L1 1Z" transform="scale(2)"/>',
        '<g opacity="0.5"><path d="M0 0L1 0L1 1Z"/></g>',
        '<g fill="none"><path d="M0 0L1 0L1 1Z"/></g>',
        '<g><path d="M0 0L1 0L1 1Z"/><path d="M0 0L1 0L1 1Z"/></g>',
        '<path d="M0 0L1 0L1 1Z"><title>one</title></path>',
        '<path d="M0 0L1 0L1 1Z" fill-rule="inherit"/>',
        '<rect width="4" height="4"/>',
    ],
)
def test_what_is_more_than_one_path_in_one_colour_is_a_drawing(text):
    assert lettering_path(parse_xml(text.encode())) is None
