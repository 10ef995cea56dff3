"""CSS Color 4 and 5 values to sRGB, by coloraide.

Colours outside sRGB are clipped, channel by channel.
"""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from packwork.readers.gate.css.selectors import split_outside
from packwork.scene.colour import css_colour

if TYPE_CHECKING:
    from coloraide import Color

_CALL = re.compile(r"([a-z][a-z0-9-]*)\((.*)\)", re.IGNORECASE | re.DOTALL)
_OLD = frozenset({"rgb", "rgba", "hsl", "hsla"})
_NEW = frozenset({"hwb", "lab", "lch", "oklab", "oklch", "color", "color-mix", "light-dark"})
_LONGEST = 300
_MIXED_IN = {"xyz": "xyz-d65"}
"""Names of spaces, by those of CSS that differ."""


def plain_colour(value: str) -> str:
    """A colour by functions of newer CSS as ``#rrggbbaa``; anything else as it was.

    >>> plain_colour("hwb(120 0% 0%)"), plain_colour("oklch(100% 0 0 / 50%)")
    ('#00ff00', '#ffffff80')
    >>> plain_colour("color-mix(in srgb, red, blue)"), plain_colour("hsl(0.5turn 50% 50%)")
    ('#800080', '#40bfbf')
    """
    text = value.strip()
    call = _CALL.fullmatch(text)
    if call is None or len(value) > _LONGEST or call[1].lower() not in _OLD | _NEW:
        return value
    if call[1].lower() in _OLD:
        # Most are read at once; turns and radians are not.
        with contextlib.suppress(ValueError):
            return _hex([part / 255 for part in css_colour(re.sub(r"\bnone\b", "0", text))])
    try:
        found = _colour(text).convert("srgb")
        return _hex([*found.coords(nans=False), found.alpha(nans=False)])
    except (ValueError, KeyError, IndexError, ArithmeticError):
        return value


def _hex(channels: Sequence[float]) -> str:
    if not all(map(math.isfinite, channels)):
        raise ValueError("not finite")
    numbers = [min(max(channel, 0.0), 1.0) for channel in channels]
    text = "".join(f"{math.floor(255 * number + 0.5 + 1e-6):02x}" for number in numbers)
    return f"#{text.removesuffix('ff')}"


def _colour(text: str) -> Color:
    # Takes as long to load as a drawing to read, and few drawings need it.
    from coloraide import Color

    call = _CALL.fullmatch(text.strip())
    name = "" if call is None else call[1].lower()
    if call is not None and name == "color-mix":
        return _mixed(split_outside(call[2], ","))
    if call is not None and name == "light-dark":
        return _colour(split_outside(call[2], ",")[0])
    return Color(text.strip())


def _mixed(parts: Sequence[str]) -> Color:
    """Two colours mixed, weighed by opacity, as ``in oklch longer hue, red 20%, blue`` says."""
    space, *colours = parts
    words = space.lower().split()
    if len(colours) != 2 or len(words) < 2 or words[0] != "in":
        raise ValueError("two colours are mixed")
    (first, own), (second, other) = map(_weighted, colours)
    if own is None:
        own = 0.5 if other is None else 1 - other
    other = 1 - own if other is None else other
    if own + other <= 0:
        raise ValueError("nothing is mixed")
    mixed = first.mix(
        second,
        other / (own + other),
        space=_MIXED_IN.get(words[1], words[1]),
        hue=words[2] if len(words) > 2 else "shorter",
        out_space="srgb",
    )
    return mixed.set("alpha", mixed.alpha(nans=False) * min(own + other, 1.0))


def _weighted(text: str) -> tuple[Color, float | None]:
    words = text.strip()
    match = re.search(r"(?:^|\s)([\d.]+)%(?:\s|$)", re.sub(r"\([^()]*\)", "", words))
    if match is None:
        return _colour(words), None
    colour = re.sub(rf"(?:^|\s){re.escape(match[1])}%(?=\s|$)", " ", words, count=1)
    return _colour(colour), float(match[1]) / 100
