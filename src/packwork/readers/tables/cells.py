"""Cells of tables: numbers as people and spreadsheets write them, categories, empty ones."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from packwork.errors import ReadError
from packwork.readers.tables.durations import durations

POINT, COMMA = ".", ","

CURRENCIES = (
    *("EUR", "USD", "GBP", "CHF", "JPY", "CNY", "SEK", "NOK", "DKK", "ISK", "PLN", "CZK", "HUF"),
    *("RON", "BGN", "RUB", "UAH", "TRY", "INR", "BRL", "MXN", "CAD", "AUD", "NZD", "ZAR", "KRW"),
    *("SGD", "HKD", "ILS", "US$", "R$", "A$", "C$", "kr.", "kr", "zł", "Kč", "Ft", "lei", "лв."),
    *("лв", "руб.", "р.", "Fr."),
)
"""Names of money beside its signs."""

MONEY = "$£¥€¢₩₪₫₹₺₽₴₦₱฿₿"
"""Signs of money."""

FARTHEST = 1e60
"""Largest number that is shown, and one over the smallest: squares of their ratios are still
numbers. Chosen."""

MISSING = "no value"
"""Category of cells that hold nothing."""

_NONE = {
    *("", "na", "n/a", "n.a.", "nan", "<na>", "#n/a", "#na", "#nv", "null", "n.v."),
    *("k.a.", "k.a", "keineangabe", "keineangaben", "n/d", "s/d"),
}
"""Cells that hold nothing, case folded and without spaces, as people and programs write them."""

_STROKES = frozenset(" \u00a0-\u2010\u2011\u2012\u2013\u2014\u2212./?\u2026")

LONGEST = 60
"""Letters of a cell that can be a number. More would only be work. Chosen."""

_MINUS = "\\-\u2212\u2012\u2013"
_GROUPS = " \u00a0\u202f\u2009'\u2019"
_UNIT = "|".join([*map(re.escape, CURRENCIES), f"[{MONEY}%\uff05\u2030]"])
_FIGURE = re.compile(
    rf"(?P<open>\()?\s*(?P<first>[+{_MINUS}])?\s*(?P<before>{_UNIT})?\s*(?P<second>[+{_MINUS}])?\s*"
    rf"(?P<body>[\d.,](?:[\d.,{_GROUPS}]*[\d.,])?(?:[eE][+-]?\d+)?)(?:(?<=[.,])[{_MINUS}]{{1,2}})?"
    rf"\s*(?P<after>{_UNIT})?\s*(?P<last>[{_MINUS}])?(?P<close>\))?"
)
_DATE = re.compile(
    r"\d{4}-\d{1,2}(-\d{1,2}([T ][\d:.,+Z-]*)?)?|\d{1,2}[./-]\d{1,2}[./-](\d{2}|\d{4})?"
    r"|\d{1,2}/\d{4}|\d{4}/\d{1,2}/\d{1,2}"
)
_MONTH = re.compile(r"(0?[1-9]|1[0-2])\.(19|20)\d\d")


class Written(str):
    """A cell as it is written, which knows the number that it means: NaN for none."""

    __slots__ = ("number",)
    number: float

    def __new__(cls, text: str, number: float) -> Written:
        """Keep both."""
        made = super().__new__(cls, text)
        made.number = number
        return made

    def __getnewargs__(self) -> tuple[str, float]:  # type: ignore[override]
        return str(self), self.number


@dataclass(frozen=True)
class Figure:
    """A written number: digits and what groups them, sign, and unit (``€``, ``%`` or none)."""

    body: str
    is_negative: bool
    unit: str


def figure(text: str) -> Figure | None:
    """Number in a text; None if there is something else in it.

    Examples
    --------
    >>> figure("(1.234,50 €)")
    Figure(body='1.234,50', is_negative=True, unit='€')
    >>> figure("CHF 1'200.-"), figure("3 kg") is None
    (Figure(body="1'200.", is_negative=False, unit='CHF'), True)
    """
    found = _FIGURE.fullmatch(text.strip()) if len(text) <= LONGEST else None
    if found is None or bool(found["open"]) != bool(found["close"]):
        return None
    signs = [sign for sign in (found["first"], found["second"], found["last"]) if sign]
    units = [unit for unit in (found["before"], found["after"]) if unit]
    if len(signs) + bool(found["open"]) > 1 or len(units) > 1:
        return None
    is_negative = bool(found["open"]) or any(sign != "+" for sign in signs)
    return Figure(found["body"], is_negative, units[0] if units else "")


def value(body: str, decimal: str) -> float:
    """Digits as a number, where one sign parts the fraction and others may group thousands.

    Examples
    --------
    >>> value("1.234,5", ","), value("1 234", "."), value("1,234", "."), value("12,34", ".")
    (1234.5, 1234.0, 1234.0, nan)
    """
    found = _WITH[decimal].fullmatch(body)
    if found is None:
        return math.nan
    whole = re.sub(r"\D", "", found["whole"] or "")
    if not whole and not found["part"]:
        return math.nan
    return float(f"{whole or 0}.{found['part'] or 0}{found['power'] or ''}")


def _pattern(decimal: str) -> re.Pattern[str]:
    other = COMMA if decimal == POINT else POINT
    group = rf"[{_GROUPS}{other}]"
    # Thousands, or as in India hundreds but for the last three digits.
    grouped = rf"[1-9]\d{{0,2}}(?P<g>{group})(?:\d{{2,3}}(?P=g))*\d{{3}}"
    return re.compile(
        rf"(?P<whole>{grouped}|\d+)?(?:[{decimal}](?P<part>\d*))?(?P<power>[eE][+-]?\d+)?"
    )


_WITH = {POINT: _pattern(POINT), COMMA: _pattern(COMMA)}


def readings(body: str) -> dict[str, float]:
    """Possible meanings of digits, by the sign that parts the fraction.

    Examples
    --------
    >>> readings("1,234"), readings("12,5"), readings("7")
    ({'.': 1234.0, ',': 1.234}, {',': 12.5}, {'.': 7.0, ',': 7.0})
    """
    both = {decimal: value(body, decimal) for decimal in (POINT, COMMA)}
    return {decimal: number for decimal, number in both.items() if not math.isnan(number)}


def is_number_like(text: str) -> bool:
    """Whether a text is a number in some way of writing, or the name of what is none.

    Examples
    --------
    >>> [is_number_like(text) for text in ("1.234,5", "12 %", "nan", "bear;2", "")]
    [True, True, True, False, False]
    """
    found = figure(text)
    if found is not None and readings(found.body):
        return True
    try:
        float(text)
    except ValueError:
        return False
    return True


def is_amount(text: str) -> bool:
    """Whether a text is a number in some way of writing, or a length of time.

    Examples
    --------
    >>> [is_amount(text) for text in ("1.234,5", "36:30", "kg")]
    [True, True, False]
    """
    return is_number_like(text) or bool(durations([text]))


def shown_decimal(cells: Iterable[object]) -> str:
    """Sign that parts fractions in cells that know their numbers; a point where none tells.

    Examples
    --------
    >>> shown_decimal([Written("1,5", 1.5), "x"]), shown_decimal([Written("7", 7.0)])
    (',', '.')
    """
    for cell in cells:
        found = figure(cell) if isinstance(cell, Written) else None
        if found is not None and set(readings(found.body)) == {COMMA}:
            return COMMA
    return POINT


def is_date(text: str) -> bool:
    """Whether a text is a date in figures.

    Examples
    --------
    >>> is_date("2024-03-01"), is_date("1.3.2024"), is_date("12.5")
    (True, True, False)
    """
    return _DATE.fullmatch(text.strip()) is not None


def written_numbers(
    cells: Sequence[object], file: str, column: str, *, usual: str = "", asked: str | None = None
) -> list[float]:
    """Number of each cell of a column; NaN for what is none. Numbers are as they are.

    Hours of a column of nothing but lengths of time.

    ``usual`` parts the fraction where nothing in the column tells, empty to refuse; ``asked``
    in any case.

    Examples
    --------
    >>> written_numbers(["1.234,5 €", "2 €", "-"], "t.csv", "price")
    [1234.5, 2.0, nan]
    """
    texts = [cell for cell in cells if isinstance(cell, str)]
    figures = {text: found for text in set(texts) if (found := figure(text)) is not None}
    if figures and all(_MONTH.fullmatch(text.strip()) for text in texts if text.strip()):
        # Months of years, as 03.2024.
        figures = {}
    if hours := durations(cell for cell in cells if not is_blank(cell)):
        return [hours.get(cell, math.nan) for cell in cells]
    _check_units(cells, figures, file, column)
    decimal = asked or _decimal(texts, figures, file, column, usual)
    numbers = {
        text: (-1 if found.is_negative else 1) * value(found.body, decimal)
        for text, found in figures.items()
    }
    return [
        numbers.get(cell, math.nan) if isinstance(cell, str) else _as_it_is(cell) for cell in cells
    ]


def _as_it_is(cell: object) -> float:
    if isinstance(cell, bool) or not isinstance(cell, int | float):
        return math.nan
    try:
        return float(cell)
    except OverflowError:
        return math.inf


def _decimal(
    texts: Iterable[str], figures: dict[str, Figure], file: str, column: str, usual: str
) -> str:
    """Sign that parts fractions, as the numbers that can be read in one way alone show."""
    told: dict[str, str] = {}
    unclear = ""
    for text in dict.fromkeys(text for text in texts if text in figures):
        found = readings(figures[text].body)
        if len(found) == 1:
            told.setdefault(next(iter(found)), text)
        elif len(set(found.values())) > 1:
            unclear = unclear or text
    if len(told) == 1:
        return next(iter(told))
    if told:
        raise ReadError(
            file,
            f"column {column[:40]!r} holds both {told[COMMA][:30]!r} and {told[POINT][:30]!r}; say "
            "what parts the fraction: --decimal , or --decimal .",
        )
    if not unclear or usual:
        return usual or POINT
    means = readings(figures[unclear].body)
    raise ReadError(
        file,
        f"{unclear[:30]!r} in column {column[:40]!r} may be {means[POINT]:,.10g} or "
        f"{means[COMMA]:,.10g}; say what parts the fraction: --decimal . or --decimal ,",
    )


def _check_units(
    cells: Sequence[object], figures: dict[str, Figure], file: str, column: str
) -> None:
    of_unit: dict[str, str] = {}
    for cell in dict.fromkeys(cell for cell in cells if isinstance(cell, str) and cell in figures):
        found = figures[cell]
        if value(found.body, POINT) != 0:
            of_unit.setdefault(found.unit, cell)
    if any(_as_it_is(cell) for cell in cells if isinstance(cell, int | float)):
        of_unit.setdefault("", "plain numbers")
    shares = {"%", "\uff05", "\u2030"} & set(of_unit)
    money = set(of_unit) - shares - {""}
    # Numbers without a sign of money are of the same money; those without % are not shares.
    if len(money) + len(shares) > 1 or (shares and "" in of_unit):
        said = [text for unit, text in of_unit.items() if unit or shares][:2]
        raise ReadError(
            file,
            f"column {column[:40]!r} holds both {said[0][:30]!r} and {said[1][:30]!r}; "
            "write all in one unit",
        )


def is_missing(cell: Any) -> bool:
    """Whether a cell holds nothing.

    Examples
    --------
    >>> [is_missing(cell) for cell in (None, "", " NA ", "k. A.", float("nan"), 0, "0", "-")]
    [True, True, True, True, True, False, False, False]
    """
    if isinstance(cell, float):
        return math.isnan(cell)
    return cell is None or (isinstance(cell, str) and "".join(cell.casefold().split()) in _NONE)


def is_blank(cell: Any) -> bool:
    """Whether a cell of a column of numbers stands for none: empty, or a dash or dots.

    Examples
    --------
    >>> [is_blank(cell) for cell in (None, "n/a", " – ", "...", "-1", "many")]
    [True, True, True, True, False, False]
    """
    return is_missing(cell) or (isinstance(cell, str) and not set(cell) - _STROKES)


def as_number(cell: Any) -> float:
    """Number in a cell; NaN if it is none, or further from 0 than :data:`FARTHEST`.

    Examples
    --------
    >>> as_number("3.5"), as_number("many"), as_number(True), as_number("1e300")
    (3.5, nan, nan, nan)
    """
    value = any_number(cell)
    return value if abs(value) <= FARTHEST else math.nan


def any_number(cell: Any) -> float:
    """Number in a cell, however large; NaN if it is none."""
    if isinstance(cell, Written):
        return cell.number
    if isinstance(cell, bool):
        return math.nan
    try:
        return float(cell)
    except OverflowError:
        return math.inf
    except (TypeError, ValueError):
        return math.nan


def is_time(cell: Any) -> bool:
    """Whether a cell that knows its number is written as a length of time."""
    return isinstance(cell, Written) and ":" in cell and not math.isnan(cell.number)


def is_numeric(rows: Sequence[Mapping[str, Any]], column: str) -> bool:
    """Whether all cells of a column that hold something are numbers: not so times, as ``8:00``.

    Examples
    --------
    >>> is_numeric([{"a": "1"}, {"a": ""}], "a"), is_numeric([{"a": "x"}], "a")
    (True, False)
    """
    cells = [row.get(column) for row in rows]
    held = [cell for cell in cells if not is_missing(cell)]
    return bool(held) and not any(math.isnan(as_number(cell)) or is_time(cell) for cell in held)


def cell_text(cell: Any) -> str:
    """Text of a cell, in one line.

    Examples
    --------
    >>> cell_text("a  b"), cell_text(2.0), cell_text(None)
    ('a b', '2', 'no value')
    """
    if is_missing(cell):
        return MISSING
    if isinstance(cell, float) and cell.is_integer():
        return str(int(cell))
    return " ".join(str(cell).split())
