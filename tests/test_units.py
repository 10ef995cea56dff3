"""Lengths and sheets as people write them: one grammar, one line for nonsense."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.errors import RecipeError
from packwork.units import (
    LARGEST_PX,
    PER_INCH,
    SHEETS,
    SMALLEST_PX,
    UNITS,
    CanvasSize,
    as_unit,
    canvas_size,
    convert,
    parse_length,
    split_length,
)

INCH = {"px": 96, "mm": 25.4, "cm": 2.54, "in": 1, "pt": 72}
TEXTS = st.text(max_size=12) | st.text("0123456789,.-+ex mpincta%", max_size=12)


@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.parametrize("to", UNITS)
def test_an_inch_is_an_inch_in_every_unit(unit: str, to: str) -> None:
    assert convert(INCH[unit], unit, to) == pytest.approx(INCH[to], rel=1e-15)


@given(st.floats(1e-6, 1e6), st.sampled_from(sorted(PER_INCH)), st.sampled_from(sorted(PER_INCH)))
def test_there_and_back_is_where_it_was(value: float, unit: str, to: str) -> None:
    assert convert(convert(value, unit, to), to, unit) == pytest.approx(value, rel=1e-14)
    assert convert(value, unit, unit) == value


@pytest.mark.parametrize(
    ("text", "unit", "length"),
    [
        ("2", "mm", 2),
        ("0", "in", 0),
        ("1mm", "mm", 1),
        ("1 MM", "cm", 0.1),
        ("1in", "pt", 72),
        ("96px", "in", 1),
        ("5%", "mm", 10),
        (".5cm", "mm", 5),
        ("1e-3", "px", 1e-3),
    ],
)
def test_lengths(text: str, unit: str, length: float) -> None:
    assert parse_length(text, unit, 200.0) == pytest.approx(length, rel=1e-14)


@pytest.mark.parametrize("text", ["", "wide", "-1", "1 parsec", "nan", "inf", "2 2", "%"])
def test_what_is_no_length_says_what_would_do(text: str) -> None:
    with pytest.raises(ValueError, match=f"use a length such as 4, 1mm.*not {text!r}"):
        parse_length(text, "px", 1.0)


@pytest.mark.parametrize("text", ["1e999", "1e308in", "1e-30mm"])
def test_lengths_beyond_measure_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match=f"use a length of 1e-09 to 1e\\+09, or 0, not {text!r}"):
        parse_length(text, "px", 1.0)


@pytest.mark.parametrize(
    ("text", "size"),
    [
        (600, CanvasSize(600, None, "px")),
        (0.5, CanvasSize(0.5, None, "px")),
        ("600", CanvasSize(600, None, "px")),
        ("8in", CanvasSize(8, None, "in")),
        (" 20 cm ", CanvasSize(20, None, "cm")),
        ("200x150mm", CanvasSize(200, 150, "mm")),
        ("200mm x 150mm", CanvasSize(200, 150, "mm")),
        ("200mmx150", CanvasSize(200, 150, "mm")),
        ("300×400", CanvasSize(300, 400, "px")),
        ("A4", CanvasSize(210, 297, "mm")),
        ("a4-landscape", CanvasSize(297, 210, "mm")),
        ("letter", CanvasSize(8.5, 11, "in")),
        ("Letter-Landscape", CanvasSize(11, 8.5, "in")),
    ],
)
def test_canvas_sizes(text: str | float, size: CanvasSize) -> None:
    assert canvas_size(text) == size


@pytest.mark.parametrize(
    "text",
    ["0x5mm", "5parsec", "-3in", "1e99mm", "", "wide", "8inx", "x", "x5", "5x5x5", "nan", "inf",
     "200mmx8in", "A7", "A4-portrait", "5%", "1e999", 0, -1.0, math.nan, math.inf, 1e7,
     f"{'9' * 5000}mm"],
)  # fmt: skip
def test_nonsense_is_one_clear_line(text: str | float) -> None:
    with pytest.raises(RecipeError) as refusal:
        canvas_size(text)
    assert refusal.value.key == "canvas"
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 200


def test_a_side_out_of_bounds_is_told_in_its_own_unit() -> None:
    with pytest.raises(RecipeError, match=r"0\.000265 to 2\.65e\+05 mm long, not 0 mm"):
        canvas_size("0x5mm")
    for side_px in (SMALLEST_PX, LARGEST_PX):
        assert canvas_size(side_px).width == side_px


@given(TEXTS)
def test_any_text_is_a_canvas_or_refused(text: str) -> None:
    try:
        size = canvas_size(text)
    except RecipeError as refusal:
        assert refusal.key == "canvas"  # noqa: PT017
    else:
        assert 0 < size.side < math.inf
        assert size.unit in UNITS


@given(TEXTS)
def test_any_text_is_a_length_or_none(text: str) -> None:
    found = split_length(text)
    assert found is None or (isinstance(found[0], float) and found[1] == found[1].lower())


def test_each_a_size_is_half_of_the_one_before() -> None:
    for k in range(6):
        (width, height, _), (half_width, half_height, _) = SHEETS[f"a{k}"], SHEETS[f"a{k + 1}"]
        assert half_height == width
        assert half_width == pytest.approx(height / 2, abs=0.5)


def test_only_names_of_units_are_units() -> None:
    assert [as_unit(text) for text in ("mm", "px", "q", "", None, ["mm"])] == [
        "mm", "px", None, None, None, None,
    ]  # fmt: skip
