"""SVG's numbers, lengths, transform lists and view boxes, and the page that viewers show."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.reading import UnfitError
from packwork.units import NUMBER as NUMBER
from packwork.units import PER_INCH, split_length

MAX_COORDINATE = 1e7
"""Largest number a drawing may hold, in its units: beyond it, differences of
coordinates lose the digits that flattening and noding need. Chosen."""

PX_PER_UNIT = {
    "": 1.0,
    **{unit: PER_INCH["px"] / per_inch for unit, per_inch in PER_INCH.items()},
    "em": 16.0,
    "rem": 16.0,
    "ex": 8.0,
}
"""CSS pixels, 96 to the inch; font-relative units for a plain 16 px font."""

_NUMBER = re.compile(NUMBER)
_NOT_FINITE = re.compile(r"[-+]?(?:nan|inf(?:inity)?)", re.IGNORECASE)


def parse_length(text: str | None, percent_of: float) -> float | None:
    """Length in CSS pixels; None if there is none or it is not one (``auto``).

    >>> parse_length("25.4mm", 0), parse_length("50%", 30), parse_length("auto", 0)
    (96.0, 15.0, None)
    """
    if text is None:
        return None
    found = split_length(text)
    if found is None:
        refuse_not_finite(text)
        return None
    number, unit = checked(found[0]), found[1]
    if unit == "%":
        return number / 100 * percent_of
    return checked(number * PX_PER_UNIT[unit]) if unit in PX_PER_UNIT else None


def parse_numbers(text: str | None) -> list[float]:
    """Numbers of a list, parted by spaces or commas, up to the first thing that is none.

    >>> parse_numbers("0,0 10-5 1e1 oops 3")
    [0.0, 0.0, 10.0, -5.0, 10.0]
    """
    text = text or ""
    found: list[float] = []
    place = 0
    for match in _NUMBER.finditer(text):
        if text[place : match.start()].strip(" \t\r\n\f,"):
            break
        found.append(checked(float(match.group())))
        place = match.end()
    refuse_not_finite(text[place:])
    return found


def checked(number: float) -> float:
    """The number itself, if a drawing can be made with it."""
    if not -MAX_COORDINATE <= number <= MAX_COORDINATE:
        raise UnfitError(
            f"holds the coordinate {number:g}; numbers up to {MAX_COORDINATE:g} can be used"
        )
    return number


def refuse_not_finite(text: str) -> None:
    """Refuse a text that spells NaN or infinity where a number should stand.

    >>> refuse_not_finite("M 0 NaN")
    Traceback (most recent call last):
    packwork.readers.reading.UnfitError: holds the coordinate NaN; give finite numbers
    """
    match = _NOT_FINITE.search(text)
    if match is not None:
        raise UnfitError(f"holds the coordinate {match.group()}; give finite numbers")


_CALL = re.compile(r"[\s,]*([A-Za-z]+)\s*\(([^()]*)\)")
_UNIT = re.compile(rf"(?<![\d.])({NUMBER})\s*(deg|grad|rad|turn|px)", re.IGNORECASE)
_DEGREES = {"deg": 1.0, "grad": 0.9, "rad": 180 / math.pi, "turn": 360.0, "px": 1.0}


def parse_transform(text: str | None) -> FloatArray:
    """Map of a ``transform`` attribute or property; the identity if it is none.

    >>> parse_transform("translate(10) scale(2)").tolist()
    [[2.0, 0.0, 10.0], [0.0, 2.0, 0.0]]
    """
    if not text:
        return affine.identity()
    matrix, place = None, 0
    has_units = any(unit in text.lower() for unit in _DEGREES)
    plain = _UNIT.sub(_without_unit, text) if has_units else text
    while match := _CALL.match(plain, place):
        step = _call(match.group(1).lower(), parse_numbers(match.group(2)))
        if step is None:
            return affine.identity()
        matrix = step if matrix is None else affine.compose(matrix, step)
        place = match.end()
    if matrix is None:
        return affine.identity()
    for number in matrix.ravel().tolist():
        checked(number)
    return matrix if not plain[place:].strip() else affine.identity()


def view_matrix(
    view: tuple[float, float, float, float], width: float, height: float, fit: str
) -> FloatArray:
    """Map of a ``viewBox`` of positive size into a viewport at the origin.

    ``fit`` is ``preserveAspectRatio``; empty means ``xMidYMid meet``.

    >>> view_matrix((0, 0, 10, 10), 40, 20, "").tolist()
    [[2.0, 0.0, 10.0], [0.0, 2.0, 0.0]]
    """
    across, down = width / view[2], height / view[3]
    words = fit.split()
    align = words[0].lower() if words else "xmidymid"
    if align != "none":
        slices = len(words) > 1 and words[1].lower() == "slice"
        across = down = max(across, down) if slices else min(across, down)
    x = _share(align, "x") * (width - across * view[2]) - across * view[0]
    y = _share(align, "y") * (height - down * view[3]) - down * view[1]
    return np.array([[across, 0.0, x], [0.0, down, y]])


def _without_unit(match: re.Match[str]) -> str:
    return f"{float(match.group(1)) * _DEGREES[match.group(2).lower()]:.12g}"


def _share(align: str, axis: str) -> float:
    """Share of the room left over that lies before the picture."""
    if f"{axis}min" in align:
        return 0.0
    if f"{axis}max" in align:
        return 1.0
    return 0.0 if align == "none" else 0.5


def _call(name: str, args: list[float]) -> FloatArray | None:
    """Map of one function of the list, None if its arguments make no sense."""
    count = len(args)
    if name == "matrix" and count == 6:
        return np.array([[args[0], args[2], args[4]], [args[1], args[3], args[5]]])
    if name == "rotate" and count in {1, 3}:
        turn = affine.similarity(0.0, 0.0, math.radians(args[0]), 1.0)
        if count == 1:
            return turn
        x, y = args[1:]
        return affine.compose(affine.compose(_shift(x, y), turn), _shift(-x, -y))
    if name == "scale" and count in {1, 2}:
        return np.array([[args[0], 0.0, 0.0], [0.0, args[-1], 0.0]])
    if name in {"scalex", "scaley"} and count == 1:
        across, down = (args[0], 1.0) if name == "scalex" else (1.0, args[0])
        return np.array([[across, 0.0, 0.0], [0.0, down, 0.0]])
    if name == "skew" and count in {1, 2}:
        across, down = math.tan(math.radians(args[0])), math.tan(math.radians((*args, 0.0)[1]))
        return np.array([[1.0, across, 0.0], [down, 1.0, 0.0]])
    if name in {"skewx", "skewy"} and count == 1:
        slant = math.tan(math.radians(args[0]))
        across, down = (slant, 0.0) if name == "skewx" else (0.0, slant)
        return np.array([[1.0, across, 0.0], [down, 1.0, 0.0]])
    if name == "translate" and count in {1, 2}:
        return _shift(args[0], args[1] if count == 2 else 0.0)
    if name in {"translatex", "translatey"} and count == 1:
        return _shift(args[0], 0.0) if name == "translatex" else _shift(0.0, args[0])
    return None


def _shift(x: float, y: float) -> FloatArray:
    return np.array([[1.0, 0.0, x], [0.0, 1.0, y]])


Viewport: TypeAlias = tuple[float, float]
"""Width and height that percentages refer to, in user units."""

PLAIN_VIEWPORT: Viewport = (100.0, 100.0)
"""What percentages refer to in a drawing that states no size."""


@dataclass(frozen=True, eq=False)
class Page:
    """The rectangle of a drawing that viewers show, in CSS pixels from the origin.

    ``matrix`` maps (2 x 3) the root's user units to CSS pixels.
    """

    width: float
    height: float
    matrix: FloatArray


def read_page(root: ET.Element) -> Page | None:
    """Page of a clean ``<svg>``; None if it states neither its size nor a ``viewBox``.

    >>> page = read_page(ET.Element("svg", {"viewBox": "0 0 24 12", "width": "1in"}))
    >>> page.width, page.height, page.matrix[0, 0].item()
    (96.0, 48.0, 4.0)
    """
    view = view_box(root)
    width, height = (_absolute(root.get(name)) for name in ("width", "height"))
    if view is not None:
        if width is None:
            width = view[2] if height is None else height * view[2] / view[3]
        if height is None:
            height = width * view[3] / view[2]
    if width is None or height is None:
        return None
    if min(width, height) <= 0 or max(width, height) > MAX_COORDINATE:
        raise UnfitError(f"has a page of {width:g} x {height:g} px; give it a width and a height")
    fit = root.get("preserveAspectRatio", "")
    matrix = view_matrix(view, width, height, fit) if view else affine.identity()
    return Page(width, height, matrix)


def view_box(element: ET.Element) -> tuple[float, float, float, float] | None:
    """Left, top, width and height of a ``viewBox``, if the element has one.

    >>> view_box(ET.Element("svg", {"viewBox": "0,0,2,1"}))
    (0.0, 0.0, 2.0, 1.0)
    """
    numbers = parse_numbers(element.get("viewBox"))
    if len(numbers) != 4:
        return None
    left, top, width, height = numbers
    if min(width, height) <= 0:
        raise UnfitError(f"has a viewBox of {width:g} x {height:g}; give it a width and a height")
    return left, top, width, height


def root_viewport(root: ET.Element, page: Page | None) -> Viewport:
    """Width and height in user units that percentages in a clean drawing refer to.

    >>> root_viewport(ET.Element("svg", {"viewBox": "0 0 2 1"}), None)
    (2.0, 1.0)
    """
    view = view_box(root)
    if view is not None:
        return view[2], view[3]
    return PLAIN_VIEWPORT if page is None else (page.width, page.height)


def _absolute(text: str | None) -> float | None:
    """A page's side; a share of an unknown window is none."""
    return None if text is not None and "%" in text else parse_length(text, 0.0)
