"""CSS lengths in relative units, and ``calc()``, to plain numbers of user units.

Programs disagree about what such units refer to; once they are numbers, nothing is left to
disagree about. A window is as large as the drawing's page.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace

from packwork.readers.budget.expansion import DASHES, curve_length
from packwork.readers.gate.css.calc import UNCOMPUTABLE, calculated
from packwork.readers.gate.css.selectors import UnknownSelectorError, inside_brackets
from packwork.readers.svg_syntax.coordinates import (
    PLAIN_VIEWPORT,
    PX_PER_UNIT,
    Page,
    parse_length,
    root_viewport,
    view_box,
)
from packwork.readers.svg_syntax.vocabulary import SHAPES
from packwork.units import NUMBER

PATH_LENGTH, OFFSET = "pathLength", "stroke-dashoffset"


def resolve_dash_lengths(root: ET.Element) -> None:
    """Scale the dashes of shapes that state a ``pathLength``, in place.

    >>> text = '<svg><path d="M0 0h8" pathLength="4" stroke-dasharray="1 .5"/></svg>'
    >>> root = ET.fromstring(text); resolve_dash_lengths(root)
    >>> root[0].get("stroke-dasharray"), root[0].get("pathLength")
    ('2 1', None)
    """
    if any(PATH_LENGTH in element.attrib for element in root.iter()):
        _settle_dashes_of(root, "none", "0")


def _settle_dashes_of(element: ET.Element, dashes: str, offset: str) -> None:
    dashes, offset = element.get(DASHES, dashes), element.get(OFFSET, offset)
    stated = parse_length(element.attrib.pop(PATH_LENGTH, None), 0.0)
    lengths = [parse_length(word, 0.0) for word in dashes.replace(",", " ").split()]
    if element.tag in SHAPES and stated is not None and stated > 0 and None not in lengths:
        factor = curve_length(element) / stated
        written = (f"{factor * (length or 0.0):.9g}" for length in lengths)
        element.set(DASHES, " ".join(written))
        element.set(OFFSET, f"{factor * (parse_length(offset, 0.0) or 0.0):.9g}")
    for child in element:
        _settle_dashes_of(child, dashes, offset)


PLAIN_FONT_PX = 16.0
"""Default size of a font, as in every browser."""

_ACROSS = frozenset({"x", "x1", "x2", "cx", "width", "rx", "dx", "refX", "markerWidth", "fx"})
_DOWN = frozenset({"y", "y1", "y2", "cy", "height", "ry", "dy", "refY", "markerHeight", "fy"})
_OTHER = frozenset(
    {"r", "fr", "stroke-width", "stroke-dasharray", "stroke-dashoffset", "letter-spacing"}
    | {"word-spacing", "textLength", "startOffset", "baseline-shift"}
)
LENGTHS = _ACROSS | _DOWN | _OTHER | {"font-size"}
"""Attributes whose values are lengths, or lists of them."""

_RELATIVE = re.compile(
    rf"(?<![\w.])({NUMBER})(rem|em|ex|ch|cap|ic|lh|rlh|[sld]?v(?:w|h|min|max|i|b)|q)\b",
    re.IGNORECASE,
)
_CALC = re.compile(r"(?:-webkit-)?(calc|min|max|clamp)\(", re.IGNORECASE)
_TERM = re.compile(rf"\s*(?:({NUMBER})([a-z%]*)|([-+*/(),]|[a-z]+))", re.IGNORECASE)
_SHARES = {"ex": 0.5, "ch": 0.5, "cap": 0.7, "lh": 1.2, "ic": 1.0}
"""Of a font's size, where the font itself is not asked. Chosen."""

_NAMED = {
    "xx-small": 0.6, "x-small": 0.75, "small": 8 / 9, "medium": 1.0, "large": 1.2,
    "x-large": 1.5, "xx-large": 2.0, "xxx-large": 3.0,
}  # fmt: skip
_STEPS = {"smaller": 1 / 1.2, "larger": 1.2}


@dataclass(frozen=True)
class Context:
    """Lengths that those of an element refer to, in user units."""

    font: float
    root_font: float
    viewport: tuple[float, float]
    window: tuple[float, float]

    def factor(self, unit: str, whole: float) -> float:
        """User units to one of ``unit``."""
        if unit == "%":
            return whole / 100
        if unit in {"em", "rem", "rlh"}:
            font = self.font if unit == "em" else self.root_font
            return font * (_SHARES["lh"] if unit == "rlh" else 1.0)
        if unit in _SHARES:
            return self.font * _SHARES[unit]
        if unit.lstrip("sld").startswith("v"):
            width, height = self.window
            sides = {"w": width, "i": width, "h": height, "b": height}
            sides |= {"min": min(self.window), "max": max(self.window)}
            return sides[unit.lstrip("sld")[1:]] / 100
        return PX_PER_UNIT[unit]


def resolve_lengths(root: ET.Element, page: Page | None) -> None:
    """Turn lengths that need a font or a window into numbers, in place.

    >>> root = ET.fromstring('<svg font-size="10"><g font-size="2em"><rect width="3em"/></g></svg>')
    >>> resolve_lengths(root, None)
    >>> root[0].attrib, root[0][0].attrib
    ({'font-size': '20'}, {'width': '60'})
    """
    window = PLAIN_VIEWPORT if page is None else (page.width, page.height)
    font = _font_size(root, Context(PLAIN_FONT_PX, PLAIN_FONT_PX, window, window))
    _settle(root, Context(font, font, root_viewport(root, page), window), is_root=True)


def resolve_page_size(root: ET.Element) -> None:
    """The same for the size of the page itself, in place; where it lies in a window is forgotten.

    >>> root = ET.Element("svg", {"width": "2em", "height": "calc(1in + 4px)"})
    >>> resolve_page_size(root); root.attrib
    {'width': '32', 'height': '100'}
    """
    plain = Context(PLAIN_FONT_PX, PLAIN_FONT_PX, (0.0, 0.0), (0.0, 0.0))
    font = _font_size(root, plain)
    for name in ("x", "y"):
        root.attrib.pop(name, None)
    for name in ("width", "height"):
        text = root.get(name, "")
        if "v" in text or "%" in text:
            # A share of a window of unknown size.
            root.attrib.pop(name, None)
        elif text:
            root.set(name, resolved(name, text, replace(plain, font=font, root_font=font)))


def resolved(name: str, text: str, context: Context) -> str:
    """Value of an attribute with its relative lengths as numbers.

    >>> resolved("x", "calc(50% - 1em) 2rem", Context(10.0, 8.0, (100.0, 40.0), (1.0, 1.0)))
    '40 16'
    """
    if "(" in text and _CALC.search(text):
        text = _calculated(text, context, _whole(name, context))
    if not any(letter.isalpha() for letter in text):
        return text
    return _RELATIVE.sub(lambda m: _written(float(m[1]) * context.factor(m[2].lower(), 0.0)), text)


def _settle(element: ET.Element, context: Context, *, is_root: bool = False) -> None:
    if not is_root and "font-size" in element.attrib:
        context = replace(context, font=_font_size(element, context))
    if "font-size" in element.attrib:
        element.set("font-size", _written(context.font))
    for name in element.attrib.keys() & LENGTHS - {"font-size"}:
        if not (is_root and name in {"width", "height"}):
            element.set(name, resolved(name, element.attrib[name], context))
    if element.tag in {"svg", "symbol"} and not is_root:
        view = view_box(element)
        if view is not None:
            context = replace(context, viewport=(view[2], view[3]))
    for child in element:
        _settle(child, context)


def _font_size(element: ET.Element, outer: Context) -> float:
    """Size of an element's font, outer sizes being known."""
    text = element.get("font-size", "").strip().lower()
    if text in _NAMED:
        return PLAIN_FONT_PX * _NAMED[text]
    if text in _STEPS:
        return outer.font * _STEPS[text]
    try:
        match = _TERM.fullmatch(resolved("font-size", text, outer))
        if match is None or match[1] is None:
            return outer.font
        size = float(match[1]) * outer.factor((match[2] or "px").lower(), outer.font)
    except KeyError:
        return outer.font
    return size if 0 <= size < 1e7 else outer.font


def _whole(name: str, context: Context) -> float:
    if name == "font-size":
        return context.font
    if name in _ACROSS:
        return context.viewport[0]
    if name in _DOWN:
        return context.viewport[1]
    return float((context.viewport[0] ** 2 + context.viewport[1] ** 2) ** 0.5 / 2**0.5)


def _written(number: float) -> str:
    return f"{number:.9g}"


def _calculated(text: str, context: Context, whole: float) -> str:
    """The text with its outermost calls calculated; as it was where they make no sense."""
    match = _CALC.search(text)
    if match is None:
        return text
    try:
        _, end = inside_brackets(text, match.end())
        value = calculated(
            text[match.start() : end], lambda unit: context.factor(unit, whole) if unit else 1.0
        )
    except (UnknownSelectorError, *UNCOMPUTABLE):
        return text
    return f"{text[: match.start()]}{_written(value)}{text[end:]}"
