"""Cells of a column as numbers or as categories."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

from packwork.phrasing import number_of
from packwork.readers.tables.table import Row, Table
from packwork.readers.tables.written import Written

FARTHEST = 1e60
"""Largest number that is shown, and one over the smallest: squares of their ratios are still
numbers. Chosen."""

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
