"""CSS declarations of a block or a ``style`` attribute: shorthands, variables, notations of SVG."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TypeAlias

from packwork.readers.gate.css.colours import is_paint
from packwork.readers.gate.css.selectors import split_outside
from packwork.readers.svg_syntax.vocabulary import COLOURS, CUSTOM, PROPERTIES

MAX_VALUE = 200
"""Letters of a variable's value; longer ones are passed over, as they multiply. Chosen."""

_USE = re.compile(r"var\(\s*+(--[\w-]++)\s*+(?:,((?:[^()]|\([^()]*+\))*+))?\)")
_ROUNDS = 4


def with_variables(
    outer: Mapping[str, str], declared: Mapping[str, str]
) -> tuple[Mapping[str, str], dict[str, str]]:
    """Variables inside an element that stands in ``outer``, and what else is declared on it.

    >>> with_variables({"--a": "1"}, {"--b": "var(--a)", "fill": "red"})
    ({'--a': '1', '--b': '1'}, {'fill': 'red'})
    """
    own = {k: v for k, v in declared.items() if k.startswith("--") and len(v) <= MAX_VALUE}
    if not own:
        return outer, dict(declared)
    inner = {**outer, **own}
    for name in own:
        inner[name] = filled_in(own[name], inner)
    return inner, {k: v for k, v in declared.items() if not k.startswith("--")}


def filled_in(value: str, variables: Mapping[str, str]) -> str:
    """The value with its variables replaced, or what stands in for those that are not set.

    >>> filled_in("var(--ink, black)", {}), filled_in("var(--ink)", {"--ink": "rgb(1,2,3)"})
    ('black', 'rgb(1,2,3)')
    """
    for _ in range(_ROUNDS):
        if "var(" not in value:
            break
        value = _USE.sub(lambda use: variables.get(use[1], use[2] or "").strip(), value)
        if len(value) > _ROUNDS * MAX_VALUE:
            return ""
    return value


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
    """A part of a value that is not known here."""


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


LOST_PROPERTIES = {
    "animation": "its animation",
    "animation-name": "its animation",
    "offset-path": "motion along a path",
    "mask-border": "masks that are no elements",
    "perspective": "perspective",
    "zoom": "zoom",
    "content": "content of style sheets",
}
"""What is said of properties that browsers know and this reading does not."""

COMMENT = re.compile(r"/\*.*?(?:\*/|\Z)|<!--|-->", re.DOTALL)
"""Comments, which may lack their end, and the brackets of old ones."""

_IMPORTANT = re.compile(r"!\s*important\s*$", re.IGNORECASE)
_HARMLESS = frozenset({"none", "auto", "normal", "initial", "0s", "1"})


@dataclass(frozen=True)
class Declarations:
    """Values that a block sets, by property, each with whether it is marked important."""

    values: Mapping[str, tuple[str, bool]]
    lost: frozenset[str] = field(default=frozenset())


@lru_cache(maxsize=4096)
def parse_declarations(text: str) -> Declarations:
    """Values by known property, each with whether it is marked important.

    >>> parse_declarations("fill: red; stroke:none !important; oops").values
    {'fill': ('red', False), 'stroke': ('none', True)}
    >>> parse_declarations("animation: turn 2s").lost
    frozenset({'its animation'})
    """
    found: dict[str, tuple[str, bool]] = {}
    lost: set[str] = set()
    for declaration in _declarations(COMMENT.sub(" ", text)):
        name, _, raw = (part.strip() for part in declaration.partition(":"))
        name = name if name.startswith(CUSTOM) else name.lower()
        is_important = "!" in raw and _IMPORTANT.search(raw) is not None
        value = _IMPORTANT.sub("", raw).strip() if is_important else raw
        if not value:
            continue
        if name in SHORTHANDS:
            try:
                longhands = SHORTHANDS[name](value)
            except UnknownValueError as unknown:
                lost.add(str(unknown))
                continue
            for key, part in longhands.items():
                found[key] = (part, is_important)
        elif name in COLOURS and "var(" not in value and not is_paint(value):
            if "(" in value:
                lost.add(f"{name} as it is written")
        elif name in PROPERTIES or name.startswith(CUSTOM):
            found[name] = (value, is_important)
        elif name in LOST_PROPERTIES and value.lower() not in _HARMLESS:
            lost.add(LOST_PROPERTIES[name])
    return Declarations(found, frozenset(lost))


def _declarations(text: str) -> list[str]:
    return split_outside(text, ";") if "(" in text or '"' in text else text.split(";")
