"""Numbers as the number formats of workbooks show them: shares, days, times, or all their digits.

Codes of formats are those of ECMA-376, part 1, 18.8.30 and 18.8.31.
"""

from __future__ import annotations

import re
from datetime import datetime, timedelta
from typing import Literal, TypeAlias

LONGEST_FORMAT = 255
"""Letters of a number format, as Excel has it."""

Shown: TypeAlias = Literal["number", "share", "date", "time", "year"]

BUILT_IN: dict[int, Shown] = {
    **dict.fromkeys((9, 10), "share"),
    **dict.fromkeys((*range(14, 18), 22, *range(27, 37), *range(50, 59)), "date"),
    **dict.fromkeys((*range(18, 22), *range(45, 48)), "time"),
}
"""Number formats that files name by their numbers alone."""

_QUOTED = re.compile(r'"[^"]*"|\\.|_.|\*.|\[[^\[\]]*\]')


def shown_by(code: str) -> Shown:
    """Kind of what a number format shows.

    Examples
    --------
    >>> [shown_by(code) for code in ("0.0%", "dd/mm/yyyy", "h:mm", "yyyy", '#,##0.00 "days"')]
    ['share', 'date', 'time', 'year', 'number']
    """
    plain = _QUOTED.sub("", code[:LONGEST_FORMAT].partition(";")[0]).casefold()
    if "%" in plain:
        return "share"
    if set(plain) == {"y"}:
        return "year"
    if "general" in plain or not set(plain) & set("ymdhs"):
        return "number"
    return "date" if set(plain) & set("yd") or not set(plain) & set("hs") else "time"


def _plain(number: float) -> str:
    """The 15 digits that Excel counts with; a fraction of three is none that groups thousands.

    >>> _plain(0.1 + 0.2), _plain(1.234), _plain(3.0)
    ('0.3', '1.2340', '3')
    """
    digits, mark, power = f"{number:.15g}".partition("e")
    return digits + "0" * (len(digits.partition(".")[2]) == 3) + mark + power


def written(number: float, shown: Shown, *, since_1904: bool = False) -> str:
    """A number as its format shows it, with all its digits.

    Examples
    --------
    >>> written(0.125, "share"), written(45352.0, "date"), written(45352.5, "date")
    ('12.5%', '2024-03-01', '2024-03-01 12:00')
    """
    if shown == "share":
        return f"{_plain(100.0 * number)}%"
    if shown == "number" or not 0.0 <= number < 2_958_466.0:
        return _plain(number)
    begin = datetime(1904, 1, 1) if since_1904 else datetime(1899, 12, 30)
    when = begin + timedelta(seconds=round(86_400 * number))
    if shown == "year":
        return str(when.year)
    clock = when.strftime("%H:%M:%S").removesuffix(":00")
    if shown == "time" and number < 1.0:
        return clock
    return f"{when:%Y-%m-%d}" + (f" {clock}" if number % 1.0 else "")
