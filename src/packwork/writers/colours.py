"""Colours as people write them, to numbers, and back to the common denominator of XML."""

from __future__ import annotations

from PIL import ImageColor

from packwork.errors import RecipeError

ABSENT = ("none", "transparent")
"""Words for no colour at all."""


def parse_colour(key: str, text: str) -> tuple[int, int, int, int]:
    """Red, green, blue and opacity, 0 to 255, of a CSS colour.

    Raises
    ------
    RecipeError
        Under the option's name ``key``, if the text names no colour.

    Examples
    --------
    >>> parse_colour("background", "tomato")
    (255, 99, 71, 255)
    >>> parse_colour("background", "none")
    (0, 0, 0, 0)
    """
    if text.strip().lower() in ABSENT:
        return (0, 0, 0, 0)
    try:
        channels = ImageColor.getrgb(text.strip())
    except ValueError as error:
        raise RecipeError(
            key, f"{text[:40]!r} is not a colour; use a name, '#rrggbb', 'rgb(...)' or 'none'"
        ) from error
    red, green, blue = channels[:3]
    return (red, green, blue, channels[3] if len(channels) == 4 else 255)


def hex_colour(channels: tuple[int, ...]) -> str:
    """``#rrggbb`` of the first three channels, 0 to 255.

    Examples
    --------
    >>> hex_colour((255, 99, 71, 128))
    '#ff6347'
    """
    return "#{:02x}{:02x}{:02x}".format(*channels[:3])
