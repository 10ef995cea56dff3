"""Colours as people write them in CSS, to numbers."""

from __future__ import annotations

import colorsys
import math
import re
from typing import TypeAlias

from PIL import ImageColor

from packwork.errors import RecipeError

Colour: TypeAlias = tuple[int, int, int, int]
"""Red, green, blue and opacity, 0 to 255."""

ABSENT = ("none", "transparent")
"""Words for no colour at all."""

_LONGEST = 100
_CALL = re.compile(r"(rgb|hsl)a?\s*\(([^()]*)\)", re.IGNORECASE)
_SEPARATOR = re.compile(r"\s*[,/]\s*|\s+")
_VALUE = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(%|deg)?")
_UNITS = {"rgb": ({"", "%"},) * 3, "hsl": ({"", "deg"}, {"", "%"}, {"", "%"})}


def css_colour(text: str) -> Colour:
    """Colour of a name, ``#rrggbb``, ``rgb()`` or ``hsl()`` with or without opacity.

    Channels out of range are clamped, as CSS says.

    Raises ``ValueError`` if the text is none of these.

    Examples
    --------
    >>> css_colour("tomato"), css_colour("#f008"), css_colour("rgb(300 0 50% / 0.5)")
    ((255, 99, 71, 255), (255, 0, 0, 136), (255, 0, 128, 128))
    >>> css_colour("none")
    (0, 0, 0, 0)
    """
    word = text.strip()
    if word.lower() in ABSENT:
        return (0, 0, 0, 0)
    if len(word) > _LONGEST:
        raise ValueError("too long for a colour")
    call = _CALL.fullmatch(word)
    if call is not None:
        return _called(call.group(1).lower(), _SEPARATOR.split(call.group(2).strip()))
    if "(" in word:
        raise ValueError("no known function")
    channels = ImageColor.getrgb(word)
    return (*channels[:3], channels[3] if len(channels) == 4 else 255)


def known_colour(text: str) -> str:
    """The same colour, each stretch of white space in it one space; empty if the text is none.

    Examples
    --------
    >>> known_colour(" rgb(1,  2 3)"), known_colour("url(#g)")
    ('rgb(1, 2 3)', '')
    """
    word = " ".join(text.split())
    try:
        css_colour(word)
    except ValueError:
        return ""
    return word


def parse_colour(key: str, text: str) -> Colour:
    """Colour that an option names, as :func:`css_colour` reads it.

    Raises ``RecipeError`` about the option ``key``, if the text is no colour.

    Examples
    --------
    >>> parse_colour("background", "rgba(255, 0, 0, 1)")
    (255, 0, 0, 255)
    """
    try:
        return css_colour(text)
    except ValueError:
        raise RecipeError(
            key, f"{text[:40]!r} is no colour; use one such as ivory or #102030"
        ) from None


def hex_colour(channels: tuple[int, ...]) -> str:
    """``#rrggbb`` of the first three channels, 0 to 255.

    Examples
    --------
    >>> hex_colour((255, 99, 71, 128))
    '#ff6347'
    """
    return "#{:02x}{:02x}{:02x}".format(*channels[:3])


def _called(name: str, words: list[str]) -> Colour:
    if len(words) not in (3, 4):
        raise ValueError("three channels and an opacity are needed")
    values = [_value(w, units) for w, units in zip(words, (*_UNITS[name], {"", "%"}), strict=False)]
    opacity = _byte(_share(*values[3], 1.0)) if len(values) == 4 else 255
    if name == "rgb":
        red, green, blue = (_byte(_share(*value, 255.0)) for value in values[:3])
        return (red, green, blue, opacity)
    hue, saturation, light = values[0][0] / 360.0, *(_share(v, "%", 1.0) for v, _ in values[1:3])
    red, green, blue = (_byte(c) for c in colorsys.hls_to_rgb(hue % 1.0, light, saturation))
    return (red, green, blue, opacity)


def _value(word: str, units: set[str]) -> tuple[float, str]:
    match = _VALUE.fullmatch(word)
    if match is None or (match.group(2) or "") not in units or math.isinf(float(match.group(1))):
        raise ValueError(f"{word!r} is no channel")
    return float(match.group(1)), match.group(2) or ""


def _share(value: float, unit: str, whole: float) -> float:
    return min(max(value / (100.0 if unit == "%" else whole), 0.0), 1.0)


def _byte(share: float) -> int:
    return math.floor(share * 255 + 0.5)
