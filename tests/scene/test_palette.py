"""Palettes by name and by hand; those that are named can be told apart."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest

from packwork.scene.colour import css_colour
from packwork.scene.palette import PALETTES, palette_colours


@pytest.mark.parametrize("name", PALETTES)
def test_named_palettes_are_as_they_stand(name: str) -> None:
    assert palette_colours(name.upper()) == PALETTES[name]
    assert all(colour == colour.lower() for colour in PALETTES[name])


def lightness(colour: str) -> float:
    """Of a grey that looks as light, about: Rec. 709 luma."""
    red, green, blue, _ = css_colour(colour)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


SCALES = {"viridis", "cividis"}


@pytest.mark.parametrize("name", sorted(SCALES))
def test_scales_get_lighter_by_even_steps(name: str) -> None:
    steps = np.diff([lightness(colour) for colour in PALETTES[name]])
    assert steps.min() > 8
    assert steps.max() < 3 * steps.min()


@pytest.mark.parametrize("name", sorted(PALETTES.keys() - SCALES))
def test_neighbours_in_a_named_palette_differ(name: str) -> None:
    for a, b in combinations(PALETTES[name], 2):
        away = sum((p - q) ** 2 for p, q in zip(css_colour(a), css_colour(b), strict=True)) ** 0.5
        assert away > 40 or abs(lightness(a) - lightness(b)) > 40, (a, b)


@pytest.mark.parametrize(
    ("value", "colours"),
    [
        ("#e63946", ("#e63946",)),
        ("#E63946 , teal", ("#e63946", "#008080")),
        ("rgb(1,2,3),hsl(0, 100%, 50%)", ("#010203", "#ff0000")),
        (["red", "#00f8"], ("#ff0000", "#0000ff88")),
        (("red",), ("#ff0000",)),
    ],
)
def test_palettes_by_hand(value: Any, colours: tuple[str, ...]) -> None:
    assert palette_colours(value) == colours


@pytest.mark.parametrize(
    "value", ["", ",", "red,", "#12", "none", "red,transparent", [], [3], 3, None, "tol"]
)
def test_what_is_no_palette(value: Any) -> None:
    with pytest.raises(ValueError, match=r"colour|cannot be seen"):
        palette_colours(value)
