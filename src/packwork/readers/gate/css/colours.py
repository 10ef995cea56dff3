"""CSS Color 4 and 5 values to sRGB.

Colours outside sRGB are clipped, channel by channel. Spaces: Björn Ottosson, "A perceptual
color space for image processing" (2020), for Oklab; CSS Color 4 for the others.
"""

from __future__ import annotations

import colorsys
import math
import re
from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.gate.css.selectors import split_outside
from packwork.scene.colour import css_colour

Linear: TypeAlias = tuple[FloatArray, float]
"""Linear-light sRGB, in which 1 is white, and opacity."""

_CALL = re.compile(r"([a-z][a-z0-9-]*)\((.*)\)", re.IGNORECASE | re.DOTALL)
_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)(%|deg|grad|rad|turn)?")
_TURNS = {"deg": 1.0, "grad": 0.9, "rad": 180 / math.pi, "turn": 360.0}
_LONGEST = 300

_OKLAB_TO_LMS = np.array(
    [
        [1, 0.3963377774, 0.2158037573],
        [1, -0.1055613458, -0.0638541728],
        [1, -0.0894841775, -1.2914855480],
    ]
)
_LMS_TO_RGB = np.array(
    [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.7076147010],
    ]
)
_XYZ_TO_RGB = np.array(
    [
        [3.2409699419, -1.5373831776, -0.4986107603],
        [-0.9692436363, 1.8759675015, 0.0415550574],
        [0.0556300797, -0.2039769589, 1.0569715142],
    ]
)
_D50_TO_D65 = np.array(
    [
        [0.9554734528, -0.0230985368, 0.0632593087],
        [-0.0283697069, 1.0099954580, 0.0210413990],
        [0.0123140016, -0.0205076964, 1.3303659366],
    ]
)
_P3_TO_RGB = np.array(
    [
        [1.2249401763, -0.2249401763, 0.0],
        [-0.0420569547, 1.0420569547, 0.0],
        [-0.0196375546, -0.0786360456, 1.0982736001],
    ]
)
_D50 = np.array([0.9642956764, 1.0, 0.8251046025])


def plain_colour(value: str) -> str:
    """A colour by functions of newer CSS as ``#rrggbbaa``; anything else as it was.

    >>> plain_colour("hwb(120 0% 0%)"), plain_colour("oklch(100% 0 0 / 50%)")
    ('#00ff00', '#ffffff80')
    >>> plain_colour("color-mix(in srgb, red, blue)"), plain_colour("red")
    ('#800080', 'red')
    """
    call = _CALL.fullmatch(value.strip())
    if call is None or len(value) > _LONGEST or call[1].lower() in {"url", "var"}:
        return value
    try:
        linear, opacity = _linear(value.strip())
    except (ValueError, KeyError, IndexError, OverflowError):
        return value
    return _hex(_companded(np.clip(linear, 0.0, 1.0)), opacity)


def _hex(channels: FloatArray, opacity: float) -> str:
    numbers = [*channels.tolist(), min(max(opacity, 0.0), 1.0)]
    text = "".join(f"{math.floor(255 * number + 0.5 + 1e-6):02x}" for number in numbers)
    return f"#{text.removesuffix('ff') if text.endswith('ff') else text}"


def _linear(text: str) -> Linear:
    """Any colour."""
    text = text.strip()
    call = _CALL.fullmatch(text)
    name = call[1].lower() if call is not None else ""
    if call is None or name in {"rgb", "rgba", "hsl", "hsla"}:
        *known, clear = css_colour(re.sub(r"\bnone\b", "0", text) if "(" in text else text)
        return _expanded(np.array(known) / 255), clear / 255
    if name == "color-mix":
        return _mixed(split_outside(call[2], ","))
    if name == "light-dark":
        return _linear(split_outside(call[2], ",")[0])
    words, _, share = call[2].partition("/")
    parts = words.split()
    opacity = _number(share, 1.0) if share.strip() else 1.0
    space = parts.pop(0).lower() if name == "color" else name
    channels = _SPACES[space](parts)
    if not np.isfinite(channels).all():
        raise ValueError("not finite")
    return channels, opacity


def _number(word: str, whole: float) -> float:
    """Number, or share of ``whole`` in percent."""
    match = _NUMBER.fullmatch(word.strip().lower())
    if match is None:
        if word.strip().lower() == "none":
            return 0.0
        raise ValueError(word)
    number = float(match[1])
    return number / 100 * whole if match[2] == "%" else number * _TURNS.get(match[2] or "", 1.0)


def _numbers(words: Sequence[str], wholes: Sequence[float]) -> list[float]:
    return [_number(word, whole) for word, whole in zip(words, wholes, strict=True)]


def _hwb(words: Sequence[str]) -> FloatArray:
    hue, white, black = _numbers(words, (360.0, 100.0, 100.0))
    white, black = white / 100, black / 100
    if white + black >= 1:
        return _expanded(np.full(3, white / (white + black)))
    pure = np.array(colorsys.hls_to_rgb(hue / 360 % 1.0, 0.5, 1.0))
    return _expanded(pure * (1 - white - black) + white)


def _oklab(words: Sequence[str]) -> FloatArray:
    return _of_oklab(np.array(_numbers(words, (1.0, 0.4, 0.4))))


def _oklch(words: Sequence[str]) -> FloatArray:
    light, chroma, hue = _numbers(words, (1.0, 0.4, 360.0))
    return _of_oklab(_polar(light, chroma, hue))


def _lab(words: Sequence[str]) -> FloatArray:
    return _of_lab(np.array(_numbers(words, (100.0, 125.0, 125.0))))


def _lch(words: Sequence[str]) -> FloatArray:
    light, chroma, hue = _numbers(words, (100.0, 150.0, 360.0))
    return _of_lab(_polar(light, chroma, hue))


def _polar(light: float, chroma: float, hue: float) -> FloatArray:
    turn = math.radians(hue)
    return np.array([light, chroma * math.cos(turn), chroma * math.sin(turn)])


def _of_oklab(lab: FloatArray) -> FloatArray:
    return np.asarray(_LMS_TO_RGB @ (_OKLAB_TO_LMS @ lab) ** 3)


def _of_lab(lab: FloatArray) -> FloatArray:
    middle = (lab[0] + 16) / 116
    cubes = np.array([middle + lab[1] / 500, middle, middle - lab[2] / 200])
    small = cubes <= 6 / 29
    xyz = np.where(small, (116 * cubes - 16) / (24389 / 27), cubes**3) * _D50
    return np.asarray(_XYZ_TO_RGB @ (_D50_TO_D65 @ xyz))


def _expanded(channels: FloatArray) -> FloatArray:
    """Gamma-coded sRGB to linear light."""
    size = np.abs(channels)
    return np.sign(channels) * np.where(
        size <= 0.04045, size / 12.92, ((size + 0.055) / 1.055) ** 2.4
    )


def _companded(linear: FloatArray) -> FloatArray:
    return np.asarray(
        np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
    )


def _plain(words: Sequence[str]) -> FloatArray:
    return np.array(_numbers(words, (1.0, 1.0, 1.0)))


_SPACES: dict[str, Callable[[Sequence[str]], FloatArray]] = {
    "hwb": _hwb,
    "lab": _lab,
    "lch": _lch,
    "oklab": _oklab,
    "oklch": _oklch,
    "srgb": lambda words: _expanded(_plain(words)),
    "srgb-linear": _plain,
    "display-p3": lambda words: _P3_TO_RGB @ _expanded(_plain(words)),
    "xyz": lambda words: _XYZ_TO_RGB @ _plain(words),
    "xyz-d65": lambda words: _XYZ_TO_RGB @ _plain(words),
    "xyz-d50": lambda words: _XYZ_TO_RGB @ (_D50_TO_D65 @ _plain(words)),
}


def _mixed(parts: Sequence[str]) -> Linear:
    """Two colours mixed, by opacity weighed: in sRGB, in linear light or else in Oklab."""
    space, *colours = parts
    if len(colours) != 2 or not space.strip().lower().startswith("in "):
        raise ValueError("two colours are mixed")
    found = [_weighted(colour) for colour in colours]
    first, second = found[0][1], found[1][1]
    if first is None:
        first = 0.5 if second is None else 1 - second
    second = 1 - first if second is None else second
    total = first + second
    if total <= 0:
        raise ValueError("nothing is mixed")
    shares = np.array([first, second]) / total
    name = space.split()[1].lower()
    there, back = _MIXING.get(name, _MIXING["oklab"])
    clear = np.array([opacity for (_, opacity), _ in found])
    opacity = float(shares @ clear)
    points = np.array([there(np.clip(linear, 0.0, 1.0)) for (linear, _), _ in found])
    weights = shares * clear / opacity if opacity > 0 else shares
    return back(weights @ points), opacity * min(total, 1.0)


def _weighted(text: str) -> tuple[Linear, float | None]:
    words = text.strip()
    match = re.search(r"(?:^|\s)([\d.]+)%(?:\s|$)", re.sub(r"\([^()]*\)", "", words))
    if match is None:
        return _linear(words), None
    colour = re.sub(rf"(?:^|\s){re.escape(match[1])}%(?=\s|$)", " ", words, count=1)
    return _linear(colour), float(match[1]) / 100


_Map: TypeAlias = Callable[[FloatArray], FloatArray]
_MIXING: dict[str, tuple[_Map, _Map]] = {
    "srgb": (_companded, _expanded),
    "srgb-linear": (np.asarray, np.asarray),
    "oklab": (
        lambda rgb: np.linalg.solve(_OKLAB_TO_LMS, np.cbrt(np.linalg.solve(_LMS_TO_RGB, rgb))),
        _of_oklab,
    ),
}
