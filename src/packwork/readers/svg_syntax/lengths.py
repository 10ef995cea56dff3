"""Numbers, lengths and lists of numbers as SVG writes them."""

from __future__ import annotations

import re

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

    Raises
    ------
    UnfitError
        If the number is not finite or absurdly large.

    Examples
    --------
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

    Raises
    ------
    UnfitError
        If one of them is not finite or absurdly large.

    Examples
    --------
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
    """The number itself, if a drawing can be made with it.

    Raises
    ------
    UnfitError
        If it is not finite or its size is beyond ``MAX_COORDINATE``.

    Examples
    --------
    >>> checked(2.5)
    2.5
    """
    if not -MAX_COORDINATE <= number <= MAX_COORDINATE:
        raise UnfitError(
            f"holds the coordinate {number:g}; numbers up to {MAX_COORDINATE:g} can be used"
        )
    return number


def refuse_not_finite(text: str) -> None:
    """Refuse a text that spells NaN or infinity where a number should stand.

    Examples
    --------
    >>> refuse_not_finite("M 0 NaN")
    Traceback (most recent call last):
    packwork.readers.reading.UnfitError: holds the coordinate NaN; give finite numbers
    """
    match = _NOT_FINITE.search(text)
    if match is not None:
        raise UnfitError(f"holds the coordinate {match.group()}; give finite numbers")
