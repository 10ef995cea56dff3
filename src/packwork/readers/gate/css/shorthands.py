"""CSS shorthand properties to longhands, and CSS notations to those of SVG."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TypeAlias

Longhands: TypeAlias = dict[str, str]

_WIDE = frozenset({"inherit", "initial", "unset", "revert", "revert-layer"})
_STYLES = frozenset({"italic", "oblique"})
_VARIANTS = frozenset({"small-caps"})
_WEIGHTS = re.compile(r"bold|bolder|lighter|[1-9]\d{0,3}")
_STRETCHES = re.compile(r"(?:ultra-|extra-|semi-)?(?:condensed|expanded)")
_SYSTEM = frozenset({"caption", "icon", "menu", "message-box", "small-caption", "status-bar"})
_SIZE = re.compile(r"[\d.+-].*|(?:x{1,3}-|xx-)?(?:small|large)|medium|smaller|larger|calc\(.*")
_PATH = re.compile(r"path\(\s*(?:(?:nonzero|evenodd)\s*,)?\s*(['\"])(.*)\1\s*\)", re.DOTALL)
_URL = re.compile(r"url\([^()]*\)")
_OPACITY = re.compile(r"opacity\(\s*([\d.]+%?)\s*\)")
_COLOURING = re.compile(
    r"(?:grayscale|sepia|saturate|hue-rotate|invert|brightness|contrast)\([^()]*\)", re.IGNORECASE
)


class UnknownValueError(Exception):
    """What a value asks for that is not known here."""


def _font(value: str) -> Longhands:
    if value.lower() in _WIDE | _SYSTEM or "var(" in value:
        return {}
    found = {"font-style": "normal", "font-variant": "normal", "font-weight": "normal"}
    found["font-stretch"] = "normal"
    words = value.replace(" /", "/").replace("/ ", "/").split()
    while words:
        word = words.pop(0).lower()
        if word in _STYLES:
            found["font-style"] = word
        elif word in _VARIANTS:
            found["font-variant"] = word
        elif _WEIGHTS.fullmatch(word):
            found["font-weight"] = word
        elif _STRETCHES.fullmatch(word):
            found["font-stretch"] = word
        elif _SIZE.fullmatch(word) and words:
            return found | {"font-size": word.split("/")[0], "font-family": " ".join(words)}
        elif word != "normal":
            break
    return {}


def _marker(value: str) -> Longhands:
    return dict.fromkeys(("marker-start", "marker-mid", "marker-end"), value)


def _path(value: str) -> Longhands:
    match = _PATH.fullmatch(value)
    if match is None:
        return {"d": "none"} if value.lower() == "none" else {}
    return {"d": match.group(2)}


def _mask(value: str) -> Longhands:
    match = _URL.match(value)
    if match is not None:
        return {"mask": match.group()}
    if value.lower() in _WIDE | {"none"}:
        return {"mask": "none"}
    raise UnknownValueError("masks that are no elements")


def _filter(value: str) -> Longhands:
    """Filters of CSS: what only changes colours leaves every outline as it is."""
    plain = value.lower()
    if plain in _WIDE | {"none"} or _URL.fullmatch(value):
        return {"filter": value}
    clear = _OPACITY.fullmatch(plain)
    if clear is not None:
        return {"opacity": clear.group(1)}
    said = "colours" if not _COLOURING.sub("", value).strip() else "shadows and blurs"
    raise UnknownValueError(f"{said} by CSS filters")


SHORTHANDS: dict[str, Callable[[str], Longhands]] = {
    "font": _font,
    "marker": _marker,
    "d": _path,
    "mask": _mask,
    "-webkit-mask": _mask,
    "mask-image": _mask,
    "-webkit-mask-image": _mask,
    "filter": _filter,
}
"""Properties by name, each to what it stands for."""
