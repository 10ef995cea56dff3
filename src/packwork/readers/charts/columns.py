"""Cells of a column as numbers or as categories."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from packwork.errors import RecipeError
from packwork.phrasing import enumerated, number_of
from packwork.readers.tables.table import Row, Table
from packwork.readers.tables.written import Written, is_date

MOST_NAMED = 6
"""Rows that a notice names. Chosen."""

FARTHEST = 1e60
"""Largest number that is shown, and one over the smallest: squares of their ratios are still
numbers. Chosen."""

LARGE = 10**9
"""Counts from which on only about how many is said. Chosen."""

MISSING = "no value"
"""Category of cells that hold nothing."""


def is_missing(cell: Any) -> bool:
    """Whether a cell holds nothing.

    Examples
    --------
    >>> [is_missing(cell) for cell in (None, "", " NA ", float("nan"), 0, "0")]
    [True, True, True, True, False, False]
    """
    if isinstance(cell, float):
        return math.isnan(cell)
    return cell is None or (isinstance(cell, str) and cell.strip() in {"", "NA", "N/A", "NaN"})


def as_number(cell: Any) -> float:
    """Number in a cell; NaN if it is none, or further from 0 than :data:`FARTHEST`.

    Examples
    --------
    >>> as_number("3.5"), as_number("many"), as_number(True), as_number("1e300")
    (3.5, nan, nan, nan)
    """
    value = _float(cell)
    return value if abs(value) <= FARTHEST else math.nan


def _float(cell: Any) -> float:
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


def is_numeric(rows: Sequence[Row], column: str) -> bool:
    """Whether all cells of a column that hold something are numbers.

    Examples
    --------
    >>> is_numeric([{"a": "1"}, {"a": ""}], "a"), is_numeric([{"a": "x"}], "a")
    (True, False)
    """
    cells = [row.get(column) for row in rows]
    held = [cell for cell in cells if not is_missing(cell)]
    return bool(held) and not any(math.isnan(as_number(cell)) for cell in held)


def shown(cell: Any) -> str:
    """Text of a cell, in one line.

    Examples
    --------
    >>> shown("a  b"), shown(2.0), shown(None)
    ('a b', '2', 'no value')
    """
    if is_missing(cell):
        return MISSING
    if isinstance(cell, float) and cell.is_integer():
        return str(int(cell))
    return " ".join(str(cell).split())


def categories(rows: Sequence[Row], column: str) -> tuple[list[str], list[str]]:
    """Category of each row; those that differ in case alone are one, and told.

    Returns
    -------
    tuple
        One per row, and a sentence about each spelling that counts as another.

    Examples
    --------
    >>> categories([{"k": "Red"}, {"k": "red"}, {"k": "Red"}], "k")
    (['Red', 'Red', 'Red'], ["k: 'red' (1 row) counts as 'Red'"])
    """
    written = Counter(shown(row.get(column)) for row in rows)
    common: dict[str, str] = {}
    told = []
    for text, count in written.most_common():
        first = common.setdefault(text.casefold(), text)
        if first != text:
            rows_said = number_of(count, "row")
            told.append(f"{column}: {text[:40]!r} ({rows_said}) counts as {first[:40]!r}")
    return [common[shown(row.get(column)).casefold()] for row in rows], told


def names_of_all(table: Table, column: str, shown_names: Iterable[str]) -> tuple[str, ...]:
    """Names of all categories of a column by the alphabet, of rows that are not shown too.

    Parameters
    ----------
    shown_names
        Categories of the rows that are shown, as those write them.

    Examples
    --------
    >>> rows = ({"k": "pear"}, {"k": "fig"}, {"k": None}, {"k": "Fig"})
    >>> names_of_all(Table("data", ("k",), rows), "k", ["Fig"])
    ('Fig', 'pear')
    """
    known = {name.casefold(): name for name in shown_names}
    for text in map(shown, (row.get(column) for row in table.rows)):
        known.setdefault(text.casefold(), text)
    known.pop(MISSING, None)
    return tuple(known[key] for key in sorted(known))


@dataclass(frozen=True, eq=False)
class Sizes:
    """Positive numbers of a column.

    Parameters
    ----------
    notices
        A sentence about each sort of rows that have none.
    lost
        Those of them about rows that hold something else.
    """

    of_row: dict[int, float]
    notices: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()


def sizes(table: Table, column: str, label_by: str | None) -> Sizes:
    """Positive number of each row that has one, and what has to be told of the others.

    Raises
    ------
    RecipeError
        If no row has one.

    Examples
    --------
    >>> rows = ({"a": 2}, {"a": 0}, {"a": -1}, {"a": "n"})
    >>> found = sizes(Table("data", ("a",), rows), "a", None)
    >>> found.notices[0], found.lost[0]
    ('left out 1 row of 4 whose a is 0: row 2', 'left out 1 row of 4 whose a is negative: row 3')
    """
    found: dict[int, float] = {}
    odd: dict[str, list[int]] = {}
    for k, row in enumerate(table.rows):
        why, value = _size(row.get(column))
        if why:
            odd.setdefault(why, []).append(k)
        else:
            found[k] = value
    if not found:
        raise RecipeError("size_by", _why_none(table, column, odd))
    said = {why: left_out(table, column, why, which, label_by) for why, which in odd.items()}
    return Sizes(
        found,
        tuple(said.values()),
        tuple(text for why, text in said.items() if why not in _EMPTY),
    )


_EMPTY = frozenset({"is missing", "is 0"})
"""What of a size leaves nothing to be shown."""


def left_out(
    table: Table, column: str, why: str, which: Sequence[int], label_by: str | None
) -> str:
    """Sentence about rows that are not shown.

    Examples
    --------
    >>> rows = ({"land": "Peru"}, {"land": ""})
    >>> left_out(Table("data", ("land",), rows), "land", "is missing", [1], None)
    'left out 1 row of 2 whose land is missing: row 2'
    """
    count = f"{number_of(len(which), 'row')} of {len(table.rows)}"
    return f"left out {count} whose {column} {why}: " + _names(table, which, label_by)


def round_up(value: float) -> float:
    """The next of 1, 2, 5, 10, 20 ...

    Examples
    --------
    >>> round_up(21.0), round_up(0.7)
    (50.0, 1.0)
    """
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= value * 0.999999)


def _size(cell: Any) -> tuple[str, float]:
    """Why a cell gives no size, empty if it does; and the size."""
    if is_missing(cell):
        return "is missing", math.nan
    value = _float(cell)
    if math.isnan(value):
        return "is a date" if is_date(str(cell)) else "is no number", value
    if value == 0:
        return "is 0", value
    if not 1 / FARTHEST <= abs(value) <= FARTHEST:
        return f"is beyond {FARTHEST:g}", value
    return ("is negative", value) if value < 0 else ("", value)


def _why_none(table: Table, column: str, odd: Mapping[str, Sequence[int]]) -> str:
    if set(odd) <= {"is no number", "is missing", "is a date"} and "is no number" in odd:
        met = shown(table.rows[odd["is no number"][0]].get(column))[:30]
        numeric = [name for name in table.columns if is_numeric(table.rows, name)]
        hint = f"those of numbers are {', '.join(numeric[:12])}" if numeric else "none has numbers"
        return f"column {column!r} holds text such as {met!r}, no numbers; {hint}"
    return f"no row can be shown: {column!r} " + ", ".join(
        f"{why} in {number_of(len(which), 'row')}" for why, which in odd.items()
    )


def _names(table: Table, which: Sequence[int], label_by: str | None) -> str:
    def name(k: int) -> str:
        return f"row {k + 1}" if label_by is None else shown(table.rows[k].get(label_by))[:40]

    return enumerated([name(k) for k in which], MOST_NAMED)
