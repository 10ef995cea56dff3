"""Colours that an option names, and colours as the common denominator of XML."""

from __future__ import annotations

from packwork.errors import RecipeError
from packwork.scene.colour import Colour, css_colour


def parse_colour(key: str, text: str) -> Colour:
    """Red, green, blue and opacity, 0 to 255, of a CSS colour.

    Raises
    ------
    RecipeError
        Under the option's name ``key``, if the text names no colour.

    Examples
    --------
    >>> parse_colour("background", "tomato")
    (255, 99, 71, 255)
    >>> parse_colour("background", "rgba(255, 0, 0, 1)")
    (255, 0, 0, 255)
    """
    try:
        return css_colour(text)
    except ValueError as error:
        raise RecipeError(
            key, f"{text[:40]!r} is not a colour; use a name, '#rrggbb', 'rgb(...)' or 'none'"
        ) from error
