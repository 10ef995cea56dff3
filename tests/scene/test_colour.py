"""Colours as CSS writes them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.scene.colour import css_colour


@pytest.mark.parametrize(
    ("text", "colour"),
    [
        ("Teal", (0, 128, 128, 255)),
        (" #0f0 ", (0, 255, 0, 255)),
        ("#ff000080", (255, 0, 0, 128)),
        ("none", (0, 0, 0, 0)),
        ("Transparent", (0, 0, 0, 0)),
        ("rgba(255,0,0,1)", (255, 0, 0, 255)),
        ("rgba(255, 0, 0, 0.5)", (255, 0, 0, 128)),
        ("rgb(255 0 0 / 50%)", (255, 0, 0, 128)),
        ("rgba(255,0,0,255)", (255, 0, 0, 255)),
        ("rgb(300,-5,0)", (255, 0, 0, 255)),
        ("rgb(100%, 50%, 0%)", (255, 128, 0, 255)),
        ("hsl(120, 100%, 50%)", (0, 255, 0, 255)),
        ("hsla(-240deg 100% 50% / .5)", (0, 255, 0, 128)),
        ("hsl(0, 0%, 200%)", (255, 255, 255, 255)),
    ],
)
def test_what_css_means(text: str, colour: tuple[int, ...]) -> None:
    assert css_colour(text) == colour


@pytest.mark.parametrize(
    "text",
    [
        "", "vermilionish", "#12", "url(#a)", "url(http://evil)", "rgb()", "rgb(1,2)",
        "rgb(1,2,3,4,5)", "rgb(nan,0,0)", "rgb(1e999,0,0)", "rgb(1deg,0,0)", "rgb(1,,2)",
        "rgb(1,2,3)x", "hsv(1,2,3)", "red" * 100, "rgb(" + "1" * 100_000 + ",0,0)",
    ],
)  # fmt: skip
def test_what_is_no_colour_is_refused(text: str) -> None:
    with pytest.raises(ValueError):
        css_colour(text)


@given(st.text(max_size=20) | st.from_regex(r"(rgb|hsl)a?\([-0-9.e%, /]{0,20}\)", fullmatch=True))
def test_any_text_is_bytes_or_a_value_error(text: str) -> None:
    try:
        channels = css_colour(text)
    except ValueError:
        return
    assert all(0 <= channel <= 255 for channel in channels)
