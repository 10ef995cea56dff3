"""Numbers as the number formats of workbooks show them: shares, days, times, or all their digits.

Codes of formats are those of ECMA-376, part 1, 18.8.30 and 18.8.31.
"""

from __future__ import annotations

import math
import re
from datetime import datetime, timedelta
from typing import Literal, TypeAlias

LONGEST_FORMAT = 255
"""Letters of a number format, as Excel has it."""

Shown: TypeAlias = Literal[
    "number", "share", "date", "time", "clock", "duration", "seconds", "year"
]

BUILT_IN: dict[int, Shown] = {
    **dict.fromkeys((9, 10), "share"),
    **dict.fromkeys((*range(14, 18), 22, *range(27, 37), *range(50, 59)), "date"),
    **dict.fromkeys((18, 20), "time"),
    **dict.fromkeys((19, 21), "clock"),
    **dict.fromkeys(range(45, 48), "seconds"),
}
"""Number formats that files name by their numbers alone."""

_QUOTED = re.compile(r'"[^"]*"|\\.|_.|\*.|\[(?!(?:h+|m+|s+)\])[^\[\]]*\]', re.IGNORECASE)
_ELAPSED = re.compile(r"\[[hms]+\]")
_FRACTION = re.compile(r"s[.,]0+")
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?")
_LONG = re.compile(r"(-?[1-9][0-9]{15,})(?:\.0*)?")


def shown_by(code: str) -> Shown:
    r"""Kind of what a number format shows.

    Examples
    --------
    >>> [shown_by(code) for code in ("0.0%", "dd/mm/yyyy", "h:mm", "yyyy", '#,##0.00 "days"')]
    ['share', 'date', 'time', 'year', 'number']
    >>> [shown_by(code) for code in ("[h]:mm", "mm:ss.0", "0\\ h", '0" d;"')]
    ['duration', 'seconds', 'number', 'number']
    """
    plain = _QUOTED.sub("", code[:LONGEST_FORMAT]).partition(";")[0].casefold()
    if "%" in plain:
        return "share"
    if _ELAPSED.search(plain):
        return "seconds" if "s" in plain else "duration"
    letters = set(_FRACTION.sub("s", plain))
    if letters == {"y"}:
        return "year"
    # No day and no time has digits besides those of a second.
    if "general" in plain or letters & set("0#?") or not letters & set("ymdhs"):
        return "number"
    if letters & set("yd") or not letters & set("hs"):
        return "date"
    return ("clock" if "s" in letters else "time") if "h" in letters else "seconds"


def _plain(number: float) -> str:
    """The 15 digits that Excel counts with; a fraction of three is none that groups thousands.

    >>> _plain(0.1 + 0.2), _plain(1.234), _plain(3.0)
    ('0.3', '1.2340', '3')
    """
    digits, mark, power = f"{number:.15g}".partition("e")
    return digits + "0" * (len(digits.partition(".")[2]) == 3) + mark + power


def written(text: str, shown: Shown, *, since_1904: bool = False) -> str:
    """A cell's number as its format shows it, with all its digits.

    A day or duration that Excel does not show is its number.

    Raises
    ------
    ValueError
        If it is no number.

    Examples
    --------
    >>> written("0.125", "share"), written("45352.0", "date"), written("45352.5", "date")
    ('12.5%', '2024-03-01', '2024-03-01 12:00')
    >>> written("1.5", "duration"), written("1.5", "time"), written("1234567890123456789", "number")
    ('36:00', '12:00', '1234567890123456789')
    """
    text = text.strip()
    number = float(text) if _NUMBER.fullmatch(text) else math.inf
    if math.isinf(number):
        raise ValueError(f"a cell holds {text[:20]!r}, which is no number")
    if shown == "share":
        return f"{_plain(100.0 * number)}%"
    if shown == "number":
        long = _LONG.fullmatch(text)
        return long[1] if long else _plain(number)
    # Excel's days since 1900 have a 29th of February in that year, the 60th.
    is_early = number < 60.0 and not since_1904
    begin = datetime(1904, 1, 1) if since_1904 else datetime(1899, 12, 30 + is_early)
    seconds = round(86_400 * number)
    if not 0 <= seconds <= (datetime.max - begin) // timedelta(seconds=1):
        return _plain(number)
    if shown in {"duration", "seconds"}:
        minutes, second = divmod(seconds, 60)
        return f"{minutes // 60}:{minutes % 60:02}" + (
            f":{second:02}" if second or shown == "seconds" else ""
        )
    when = begin + timedelta(seconds=seconds)
    if shown == "year":
        return str(when.year)
    clock = f"{when:%H:%M:%S}"
    # Lengths of time of one column need as many figures in all its cells.
    if shown == "clock":
        return clock
    clock = clock.removesuffix(":00")
    if shown == "time":
        return clock
    return f"{when:%Y-%m-%d}" + (f" {clock}" if seconds % 86_400 else "")
