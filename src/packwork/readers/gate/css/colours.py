"""CSS Color 4 and 5 values to sRGB, by coloraide.

Colours outside sRGB are clipped, channel by channel, as browsers do.
"""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

from packwork.readers.gate.css.calc import UNCOMPUTABLE, calculated
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
_POLAR = frozenset({"hsl", "hwb", "lch", "oklch"})
_LIGHTEST = {"lab": 100.0, "lch": 100.0, "oklab": 1.0, "oklch": 1.0}
_WORDS = frozenset({
    "none", "currentcolor", "inherit", "initial", "unset", "revert", "context-fill",
    "context-stroke",
})  # fmt: skip
_CALC = re.compile(r"\bcalc((\((?:[^()]|\([^()]*\))*\)))", re.IGNORECASE)
_UNIT = re.compile(r"(?<=[\d.])(%|[a-z]+)", re.IGNORECASE)


@lru_cache(maxsize=4096)
def is_paint(value: str) -> bool:
    """Whether CSS takes a value for a colour, or for what stands in its place.

    >>> [is_paint(text) for text in ("red", "url(#g) red", "lab(50 0 9)", "#12", "rgb(1 2)")]
    [True, True, True, False, False]
    """
    text = plain_colour(value).strip()
    if text.lower() in _WORDS or text.lower().startswith("url("):
        return True
    try:
        css_colour(text)
    except ValueError:
        return False
    return True


def plain_colour(value: str) -> str:
    """A colour by functions of newer CSS as ``#rrggbbaa``; anything else as it was.

    >>> plain_colour("hwb(120 0% 0%)"), plain_colour("oklch(100% 0 0 / 50%)")
    ('#00ff00', '#ffffff80')
    >>> plain_colour("color-mix(in srgb, red, blue)"), plain_colour("hsl(0.5turn 50% 50%)")
    ('#800080', '#40bfbf')
    """
    text = value.partition(" icc-color(")[0].strip()
    if text.lower() == "currentcolor":
        # Not all programs know it in another case.
        return "currentColor"
    call = _CALL.fullmatch(text)
    if call is None or len(value) > _LONGEST or call[1].lower() not in _OLD | _NEW:
        return text
    with contextlib.suppress(*UNCOMPUTABLE):
        text = _CALC.sub(_computed, text)
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
    found = Color(text.strip())
    if name in _LIGHTEST:
        return found.set("lightness", min(max(found[0], 0.0), _LIGHTEST[name]))
    return found


def _computed(call: re.Match[str]) -> str:
    """Value of a sum or product of numbers, with the one unit that they have."""
    met = _UNIT.findall(call[1])
    units, numbers = set(met), re.findall(r"[\d.]+", call[1])
    if len(units) > 1 or (met and len(met) < len(numbers) and re.search(r"[+-]", call[1])):
        raise ValueError("units are mixed")
    return f"{calculated(call[0], lambda unit: 1.0):.12g}{''.join(units)}"


def _mixed(parts: Sequence[str]) -> Color:
    """Two colours mixed, weighed by opacity, as ``in oklch longer hue, red 20%, blue`` says."""
    *said, first_said, second_said = parts
    words = said[0].lower().split() if said else ["in", "oklab"]
    if len(said) > 1 or len(words) < 2 or words[0] != "in":
        raise ValueError("two colours are mixed")
    if len(words) > 2 and words[1] not in _POLAR:
        raise ValueError("hues of a space without any")
    (first, own), (second, other) = map(_weighted, (first_said, second_said))
    if own is None:
        own = 0.5 if other is None else 1 - other
    other = 1 - own if other is None else other
    if not 0 <= min(own, other) <= max(own, other) <= 1:
        raise ValueError("a share of more than all")
    if own + other == 0:
        return first.set("alpha", 0.0)
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
