"""Lengths and sheets as people write them, and the units a canvas can have.

The grammar stands here once: recipes, containers and SVG files read lengths by it.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

from packwork.errors import RecipeError

Unit: TypeAlias = Literal["px", "mm", "cm", "in", "pt"]
"""What one canvas unit can be."""

UNITS: tuple[Unit, ...] = get_args(Unit)

PER_INCH = {"px": 96.0, "mm": 25.4, "cm": 2.54, "in": 1.0, "pt": 72.0, "pc": 6.0, "q": 101.6}
"""How many of each make an inch, as CSS says; the last two stand only in SVG files."""

NUMBER = r"(?>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)"
"""Pattern of one number. Atomic: hostile runs of digits are never tried twice."""

SHORTEST, LONGEST = 1e-9, 1e9
"""Numbers that a length or a place may state, but for 0, whatever its unit: beyond them products
of lengths overflow or vanish. Chosen."""

_LENGTH = re.compile(rf"({NUMBER})\s*(%|[a-zA-Z]*)")

DEFAULT_SIDE = 600.0
"""Longer side, in px, of a canvas for which no size is given. Chosen."""

SMALLEST_PX, LARGEST_PX = 1e-3, 1e6
"""Sides that a canvas may have, in px: 260 nm to 260 m. Chosen."""

SHEETS: dict[str, tuple[float, float, Unit]] = {
    "a0": (841.0, 1189.0, "mm"),
    "a1": (594.0, 841.0, "mm"),
    "a2": (420.0, 594.0, "mm"),
    "a3": (297.0, 420.0, "mm"),
    "a4": (210.0, 297.0, "mm"),
    "a5": (148.0, 210.0, "mm"),
    "a6": (105.0, 148.0, "mm"),
    "letter": (8.5, 11.0, "in"),
}
"""Sheets by name, upright."""

_LANDSCAPE = "-landscape"
_SIZE = re.compile(rf"({NUMBER})\s*([a-z]*)(?:\s*[x×]\s*({NUMBER})\s*([a-z]*))?")
_FORMS = "use a length such as 600, 8in or 200mm, a sheet such as 200x150mm, or a name such as A4"


def split_length(text: str) -> tuple[float, str] | None:
    """Number and unit (in lower case, perhaps empty) of a length; None if it is none.

    Examples
    --------
    >>> split_length(" 2.5 MM "), split_length("5%"), split_length("wide")
    ((2.5, 'mm'), (5.0, '%'), None)
    """
    match = _LENGTH.fullmatch(text.strip())
    return None if match is None else (float(match.group(1)), match.group(2).lower())


def is_length(text: str) -> bool:
    """Whether a text is a length, perhaps negative, that can be computed with.

    Examples
    --------
    >>> is_length("-2mm"), is_length("0%"), is_length("1e308%"), is_length("2 furlongs")
    (True, True, False, False)
    """
    number, unit = split_length(text) or (math.nan, "")
    is_known = unit in ("", "%") or unit in UNITS
    return is_known and (number == 0 or SHORTEST <= abs(number) <= LONGEST)


def as_unit(text: object) -> Unit | None:
    """The canvas unit of that name; None if there is none.

    Examples
    --------
    >>> as_unit("mm"), as_unit("furlong")
    ('mm', None)
    """
    return next((unit for unit in UNITS if unit == text), None)


def convert(value: float, unit: str, to: str) -> float:
    """The same length in another unit; in the same one, the very same number.

    Parameters
    ----------
    unit, to
        Keys of ``PER_INCH``.

    Examples
    --------
    >>> convert(1.0, "in", "mm"), convert(10.0, "mm", "cm"), convert(3.0, "pt", "px")
    (25.4, 1.0, 4.0)
    """
    return value if unit == to else value * PER_INCH[to] / PER_INCH[unit]


def parse_length(text: str, unit: str, whole: float, word: str | None = None) -> float:
    """Length in a unit, from ``2`` (that unit), ``2pt``, ``1mm`` or ``5%`` (of the whole).

    ``word`` is what else may be said, which a refusal names.

    Examples
    --------
    >>> parse_length("2", "mm", 200.0), parse_length("1in", "mm", 200.0)
    (2.0, 25.4)
    >>> parse_length("5%", "mm", 200.0)
    10.0
    """
    number, own = split_length(text) or (math.nan, "")
    if own == "%":
        length = number / 100 * whole
    elif own == "" or own in UNITS:
        length = convert(number, own or unit, unit)
    else:
        length = math.nan
    if not length >= 0:
        also = "" if word is None else f"{word} or "
        raise ValueError(f"use {also}a length such as 4, 1mm, 3pt, 0.1in or 1%, not {text[:40]!r}")
    if not is_length(text):
        raise ValueError(f"use a length of {SHORTEST:g} to {LONGEST:g}, or 0, not {text[:40]!r}")
    return length


def length_asked(
    key: str, value: str | float, unit: str, whole: float, word: str | None = None
) -> float:
    """Length in a unit; a ``RecipeError`` about ``key`` if it is none.

    Examples
    --------
    >>> length_asked("padding", "2%", "mm", 50.0)
    1.0
    """
    try:
        return parse_length(str(value), unit, whole, word)
    except ValueError as error:
        raise RecipeError(key, str(error)) from None


def parse_share(value: object) -> object:
    """Share of one of ``94%``, ``"0.94"`` or ``0.94``; anything else as it is.

    Examples
    --------
    >>> parse_share("94 %"), parse_share(".94"), parse_share(0.5), parse_share("wide")
    (0.94, 0.94, 0.5, 'wide')
    """
    met = split_length(value) if isinstance(value, str) else None
    if met is None or met[1] not in {"", "%"}:
        return value
    return round(met[0] / 100, 12) if met[1] else met[0]


@dataclass(frozen=True)
class CanvasSize:
    """Size of a canvas, as it was asked.

    Parameters
    ----------
    width, height
        The sheet, in ``unit``. Without a height, ``width`` is the longer side and the
        container's own canvas decides on the other.
    unit
        What one canvas unit is.
    """

    width: float
    height: float | None
    unit: Unit

    @property
    def side(self) -> float:
        """The longer side, in ``unit``."""
        return max(self.width, self.height or 0.0)


def canvas_size(text: str | float) -> CanvasSize:
    """Size of ``600`` (px), ``8in``, ``200x150mm``, ``A4`` or ``A4-landscape``.

    Examples
    --------
    >>> canvas_size("200x150mm")
    CanvasSize(width=200.0, height=150.0, unit='mm')
    >>> canvas_size(600), canvas_size("A4-landscape").width
    (CanvasSize(width=600.0, height=None, unit='px'), 297.0)
    """
    plain = str(text).strip().lower()
    size = _named(plain) or _written(plain)
    if size is None:
        raise RecipeError("canvas", f"{_FORMS}, not {str(text)[:40]!r}")
    for side in (size.width, size.width if size.height is None else size.height):
        check_side(side, size.unit)
    return size


def check_side(side: float, unit: Unit) -> None:
    """Refuse a side that no canvas can have.

    Examples
    --------
    >>> check_side(200.0, "mm")
    """
    side_px = convert(side, unit, "px")
    if not (math.isfinite(side_px) and SMALLEST_PX <= side_px <= LARGEST_PX):
        bounds = " to ".join(f"{convert(v, 'px', unit):.3g}" for v in (SMALLEST_PX, LARGEST_PX))
        raise RecipeError("canvas", f"a side is {bounds} {unit} long, not {side:g} {unit}")


def _named(plain: str) -> CanvasSize | None:
    sheet = SHEETS.get(plain.removesuffix(_LANDSCAPE))
    if sheet is None:
        return None
    width, height, unit = sheet
    if plain.endswith(_LANDSCAPE):
        width, height = height, width
    return CanvasSize(width, height, unit)


def _written(plain: str) -> CanvasSize | None:
    match = _SIZE.fullmatch(plain)
    if match is None:
        return None
    width, first, height, last = match.groups()
    unit = as_unit(last or first or "px")
    if unit is None or (last is not None and first not in ("", unit)):
        return None
    return CanvasSize(float(width), None if height is None else float(height), unit)
