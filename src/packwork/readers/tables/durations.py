"""Lengths of time, as people and spreadsheets write them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from datetime import timedelta

from packwork.errors import ReadError

_DURATION = re.compile(r"(\d{1,6}):([0-5]\d)(?::([0-5]\d(?:[.,]\d{1,6})?))?")


def durations(cells: Iterable[object]) -> dict[object, float]:
    """Hours of lengths of time, by their texts; none where one of the cells is no such text.

    All have as many figures: ``57:00`` beside ``1:02:00`` would be minutes, but alone hours.

    Examples
    --------
    >>> durations(["8:00", "0:45"]), durations(["1:30:36"]), durations(["1:02:00", "57:00"])
    ({'8:00': 8.0, '0:45': 0.75}, {'1:30:36': 1.51}, {})
    """
    hours = dict[object, float]()
    colons = 0
    for cell in cells:
        found = _DURATION.fullmatch(cell.strip()) if isinstance(cell, str) else None
        if found is None or found[0].count(":") != (colons or found[0].count(":")):
            return {}
        colons = found[0].count(":")
        hour, minute, second = found.groups("0")
        hours[cell] = int(hour) + int(minute) / 60 + float(second.replace(",", ".")) / 3600
    return hours


def check_durations(cells: Sequence[object], file: str, column: str) -> None:
    """Refuse lengths of time beside other cells, of a column whose numbers are needed.

    Examples
    --------
    >>> check_durations(["1:30", 90], "t.csv", "took")
    Traceback (most recent call last):
    packwork.errors.ReadError: t.csv: column 'took' holds 90 beside lengths of time such as \
'1:30'; write all as 1:30, all as 1:30:00 or all as numbers
    """
    first = next((cell for cell in cells if durations([cell])), None)
    odd = next((cell for cell in cells if first is not None and not durations([first, cell])), None)
    if odd is not None:
        raise ReadError(
            file,
            f"column {column[:40]!r} holds {odd!r:.40} beside lengths of time such as "
            f"{first!r:.30}; write all as 1:30, all as 1:30:00 or all as numbers",
        )


def written_duration(length: timedelta) -> str:
    """A length of time as its text.

    Examples
    --------
    >>> from datetime import timedelta
    >>> written_duration(timedelta(days=1, hours=2)), written_duration(timedelta(seconds=-0.5))
    ('26:00:00', '-0:00:00.5')
    """
    seconds, part = divmod(abs(length // timedelta(microseconds=1)), 1_000_000)
    fraction = f".{part:06}".rstrip("0") if part else ""
    sign = "-" if length < timedelta() else ""
    return f"{sign}{seconds // 3600}:{seconds // 60 % 60:02}:{seconds % 60:02}{fraction}"
