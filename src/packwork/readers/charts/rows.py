"""Table of a chart: columns checked, numbers read, odd rows collected."""

from __future__ import annotations

from collections import Counter

from packwork.phrasing import enumerated, number_of
from packwork.readers.charts.columns import (
    MOST_NAMED,
    as_number,
    shown,
)
from packwork.readers.charts.options import ChartOptions
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.table import Row, Table, read_table, total_row

COLUMNS = ("size_by", "color_by", "mark_by", "label_by", "by")
"""Options that name columns."""

NUMBERS = ("size_by", "color_by", "by")
"""Those of them whose columns may be numbers."""

MOST_COMPARED = 20_000
"""Rows at most that are compared with each other: a chart shows 5,000, the others are empty.
More would only be work. Chosen."""


def read_chart_table(options: ChartOptions, asked: TableFormat) -> Table:
    """Table of a chart, the texts of whose number columns know their numbers.

    Raises
    ------
    ReadError
        If it cannot be read, or how numbers are written is not plain.
    RecipeError
        If a column is not there.

    Examples
    --------
    >>> rows = ({"land": "Peru", "t": "2,5"}, {"land": "Kenya", "t": "1"})
    >>> table = read_chart_table(ChartOptions(data=rows, size_by="t"), TableFormat())
    >>> [row["t"].number for row in table.rows]
    [2.5, 1.0]
    """
    named = {key: column for key in COLUMNS if (column := getattr(options, key)) is not None}
    table = read_table(options.data, asked, named.values())
    for key, column in named.items():
        table.check_column(key, column)
    for column in dict.fromkeys(named[key] for key in NUMBERS if key in named):
        is_whole = column != options.size_by
        table = table.with_numbers(column, asked.decimal, whole=is_whole)
    return table


def oddities(table: Table, options: ChartOptions) -> list[str]:
    """Sentences about rows that are shown, but may not have been meant.

    Examples
    --------
    >>> rows = ({"a": "x", "n": 2}, {"a": "y", "n": 1}, {"a": "x", "n": 2}, {"a": "Total", "n": 5})
    >>> for text in oddities(*(lambda o: (read_chart_table(o, TableFormat()), o))(
    ...     ChartOptions(data=rows, size_by="n", label_by="a"))):
    ...     print(text)
    1 row says the same as another in all columns, and is shown too: x
    row 4 (Total) looks like the sum of the others, and is shown as they are
    """
    if options.size_by is None or options.label_by is None or len(table.rows) > MOST_COMPARED:
        return []
    label, size = options.label_by, options.size_by
    told = []
    twice = _repeated(table.rows, label)
    if twice:
        rows = number_of(len(twice), "row says", "rows say")
        others = "another" if len(twice) == 1 else "others"
        shows = "is shown too" if len(twice) == 1 else "are shown too"
        named = enumerated(twice, MOST_NAMED)
        told.append(f"{rows} the same as {others} in all columns, and {shows}: {named}")
    names = [shown(row.get(label)) for row in table.rows]
    total = total_row(names, [as_number(row.get(size)) for row in table.rows])
    if total is not None:
        told.append(
            f"row {total + 1} ({names[total][:40]}) looks like the sum of the others, "
            "and is shown as they are"
        )
    return told


def _repeated(rows: tuple[Row, ...], label: str) -> list[str]:
    """Labels of rows that were there before, cell by cell."""
    seen: Counter[tuple[str, ...]] = Counter()
    twice = []
    for row in rows:
        key = tuple(f"{column}\0{cell}" for column, cell in row.items())
        seen[key] += 1
        if seen[key] > 1:
            twice.append(shown(row.get(label))[:40])
    return twice
