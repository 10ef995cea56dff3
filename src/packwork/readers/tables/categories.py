"""Categories of tables: what cells say as words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from packwork.phrasing import number_of
from packwork.readers.tables.cells import MISSING, cell_text


def categories(rows: Sequence[Mapping[str, Any]], column: str) -> tuple[list[str], list[str]]:
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
    written = Counter(cell_text(row.get(column)) for row in rows)
    common: dict[str, str] = {}
    told = []
    for text, count in written.most_common():
        first = common.setdefault(text.casefold(), text)
        if first != text:
            rows_said = number_of(count, "row")
            told.append(f"{column}: {text[:40]!r} ({rows_said}) counts as {first[:40]!r}")
    return [common[cell_text(row.get(column)).casefold()] for row in rows], told


def all_categories(
    rows: Sequence[Mapping[str, Any]], column: str, shown_names: Iterable[str]
) -> tuple[str, ...]:
    """Categories of a column by the alphabet, of rows that are not shown too.

    Examples
    --------
    >>> rows = ({"k": "pear"}, {"k": "fig"}, {"k": None}, {"k": "Fig"})
    >>> all_categories(rows, "k", ["Fig"])
    ('Fig', 'pear')
    """
    known = {name.casefold(): name for name in shown_names}
    for text in map(cell_text, (row.get(column) for row in rows)):
        known.setdefault(text.casefold(), text)
    known.pop(MISSING, None)
    return tuple(known[key] for key in sorted(known))
