"""Rows of a chart's table: checked columns, what each row stands for, and what has to be told."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.phrasing import enumerated, number_of
from packwork.readers.charts import ChartOptions
from packwork.readers.tables.cells import (
    FARTHEST,
    any_number,
    cell_text,
    is_date,
    is_missing,
    is_numeric,
)
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import MOST_NAMED
from packwork.readers.tables.table import Row, Table, read_table
from packwork.readers.tables.totals import (
    called_total,
    is_sum_last,
    names_a_part,
    total_rows,
)
from packwork.uses.charts.groups import LARGE, Groups, left_out, left_out_named, round_up, row_name

COLUMNS = ("size_by", "color_by", "mark_by", "label_by", "by")
"""Options that name columns."""

NUMBERS = ("size_by", "color_by", "by")
"""Those of them whose columns may be numbers."""

MOST_MARKS = 5_000
"""Marks of one chart: on a canvas of 600 px each would be 5 px wide. More could not be told
apart. Derived."""

MOST_CIRCLES = 100_000
"""The same of circles, of which far more fit on a large sheet in little time. Chosen."""

MOST_COMPARED = 4 * MOST_MARKS
"""Rows at most that are compared with each other: of more, most are empty."""

SPECK = 1e-3
"""Share of a mark below which a remainder is rounding of the numbers, not a part. Chosen."""


def read_chart_table(options: ChartOptions, asked: TableFormat) -> Table:
    """Table of a chart, the texts of whose number columns know their numbers.

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
        table = table.with_numbers(column, asked.decimal, whole=column != options.size_by)
    return table


def oddities(table: Table, options: ChartOptions) -> list[str]:
    """Sentences about rows that are shown, but may not have been meant.

    Examples
    --------
    >>> rows = ({"a": "x", "n": 2}, {"a": "y", "n": 1}, {"a": "x", "n": 2})
    >>> asked = ChartOptions(data=rows, size_by="n", label_by="a")
    >>> oddities(Table("data", ("a", "n"), rows), asked)
    ['1 row says the same as another in all columns, and is shown too: x']
    """
    if options.size_by is None or options.label_by is None or len(table.rows) > MOST_COMPARED:
        return []
    names = [cell_text(row.get(options.label_by)) for row in table.rows]
    seen: Counter[tuple[str, ...]] = Counter()
    twice = []
    for row, name in zip(table.rows, names, strict=True):
        key = tuple(f"{column}\0{cell}" for column, cell in row.items())
        seen[key] += 1
        if seen[key] > 1:
            twice.append(name[:40])
    told = []
    if twice:
        rows = number_of(len(twice), "row says", "rows say")
        others, shows = ("another", "is") if len(twice) == 1 else ("others", "are")
        told.append(
            f"{rows} the same as {others} in all columns, and {shows} shown too: "
            f"{enumerated(twice, MOST_NAMED)}"
        )
    return told


def without_totals(
    table: Table, column: str, label_by: str | None, numbers: Mapping[int, float]
) -> tuple[dict[int, float], dict[str, bool]]:
    """Numbers of rows that are no totals of the others; a sentence about those that are.

    Examples
    --------
    >>> rows = ({"a": "x", "n": 2}, {"a": "y", "n": 3}, {"a": "Sum", "n": 5})
    >>> without_totals(Table("data", ("a", "n"), rows), "n", "a", {0: 2.0, 1: 3.0, 2: 5.0})[0]
    {0: 2.0, 1: 3.0}
    """
    signed = {k: any_number(row.get(column)) for k, row in enumerate(table.rows)}
    which = [k for k, number in signed.items() if abs(number) <= FARTHEST]
    texts = _names_of_rows(table, column, label_by)
    called = total_rows([texts[k] for k in which], [signed[k] for k in which])
    totals = {which[place]: text for place, text in called.items() if which[place] in numbers}
    told = {}
    if totals:
        names = [text or row_name(table, k, None) for k, text in totals.items()]
        said = left_out_named(table, column, "is the total of others", names)
        told[f"{said}; --keep-totals shows totals too"] = False
    elif is_sum_last([signed[k] for k in which]):
        name = row_name(table, which[-1], label_by)
        told[f"{name} is the sum of the others by its number, and is shown as they are"] = False
    doubtful = [called_total(texts[k])[:40] for k in numbers if k not in totals]
    if any(doubtful):
        named = enumerated([text for text in doubtful if text], MOST_NAMED)
        told[f"shown though called a total, as it is not the sum of others: {named}"] = False
    return {k: number for k, number in numbers.items() if k not in totals}, told


def _names_of_rows(table: Table, column: str, label_by: str | None) -> list[list[str]]:
    """Texts of each row that may name it: label, first text, and others' totals of parts."""
    texts = [name for name in table.columns if name != column and not is_numeric(table.rows, name)]
    naming = {label_by, *texts[:1]}
    if label_by in table.columns and label_by not in (column, *texts):
        texts.append(label_by)

    def text(row: Row, name: str) -> str:
        cell = row.get(name)
        is_name = isinstance(cell, str) and (name in naming or names_a_part(cell))
        return cell_text(cell) if is_name and not is_missing(cell) else ""

    return [[text(row, name) for name in texts] for row in table.rows]


def sizes(
    table: Table, column: str, label_by: str | None
) -> tuple[dict[int, float], dict[str, bool]]:
    """Positive number of each row that has one; sentences about the others, and which tell of data.

    Examples
    --------
    >>> rows = ({"a": 2}, {"a": 0}, {"a": -1}, {"a": "n"})
    >>> numbers, notices = sizes(Table("data", ("a",), rows), "a", None)
    >>> numbers, list(notices.items())[:2] == [
    ...     ("left out 1 row of 4 whose a is 0: row 2", False),
    ...     ("left out 1 row of 4 whose a is negative: row 3", True)]
    ({0: 2.0}, True)
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
        raise RecipeError("size_by", "; ".join((_why_none(table, column, odd), *table.notices)))
    return found, {
        left_out(table, column, why, which, label_by): why not in {"is missing", "is 0"}
        for why, which in odd.items()
    }


def _size(cell: Any) -> tuple[str, float]:
    """Why a cell gives no size, empty if it does; and the size."""
    if is_missing(cell):
        return "is missing", math.nan
    value = any_number(cell)
    if math.isnan(value):
        return "is a date" if is_date(str(cell)) else "is no number", value
    if value == 0:
        return "is 0", value
    if not 1 / FARTHEST <= abs(value) <= FARTHEST:
        return f"is beyond {FARTHEST:g}", value
    return ("is negative", value) if value < 0 else ("", value)


def _why_none(table: Table, column: str, odd: Mapping[str, Sequence[int]]) -> str:
    if set(odd) <= {"is no number", "is missing", "is a date"} and "is no number" in odd:
        met = cell_text(table.rows[odd["is no number"][0]].get(column))[:30]
        numeric = [name for name in table.columns if is_numeric(table.rows, name)]
        hint = f"those of numbers are {', '.join(numeric[:12])}" if numeric else "none has numbers"
        return f"column {column!r} holds text such as {met!r}, no numbers; {hint}"
    return f"no row can be shown: {column!r} " + ", ".join(
        f"{why} in {number_of(len(which), 'row')}" for why, which in odd.items()
    )


@dataclass(frozen=True, eq=False)
class Amounts:
    """Rows that are shown, or one for all that are shown alike, and how much each stands for.

    ``amounts`` ``(n,)`` are in the unit of the size column, or numbers of rows.
    """

    rows: list[Row]
    amounts: FloatArray
    groups: IntArray


def sized_rows(
    table: Table, options: ChartOptions, *, keeps_totals: bool = False
) -> tuple[dict[int, float], dict[str, bool]]:
    """Amounts of the rows that have one and are no totals, and sentences as of :func:`sizes`."""
    if options.size_by is None:
        return dict.fromkeys(range(len(table.rows)), 1.0), {}
    found, notices = sizes(table, options.size_by, options.label_by)
    if keeps_totals:
        return found, notices
    found, told = without_totals(table, options.size_by, options.label_by, found)
    return found, notices | told


def read_amounts(
    table: Table, options: ChartOptions, groups: Groups | None, found: Mapping[int, float]
) -> Amounts:
    """Rows that are shown of those with an amount; those in no group are not."""
    member = [0] * len(table.rows) if groups is None else groups.of_row
    which = [k for k in found if member[k] >= 0]
    if not which:
        raise RecipeError("by", f"no row has both a group in {options.by!r} and a size")
    if options.unit is not None and _may_pool(options):
        return _pooled(table, options, groups, {k: found[k] for k in which})
    return Amounts(
        [table.rows[k] for k in which],
        np.array([found[k] for k in which]),
        np.array([member[k] for k in which], dtype=np.int64),
    )


def _may_pool(options: ChartOptions) -> bool:
    """Whether rows that are shown alike may be one: nothing shows of each how large it is.

    Without groups marks stand for rows each, to which they can be joined.
    """
    shown = {options.color_by, options.mark_by, options.label_by}
    return options.size_by is None or (options.by is not None and options.size_by not in shown)


def _pooled(
    table: Table, options: ChartOptions, groups: Groups | None, found: Mapping[int, float]
) -> Amounts:
    """Rows that are shown alike as one, with the sum of their sizes or their number.

    So a bar of a colour has one part of a mark, of all that is left over.
    """
    shown_of = (options.color_by, options.mark_by, options.label_by)
    columns = list(dict.fromkeys(column for column in shown_of if column is not None))
    alike: dict[tuple[int, tuple[str, ...]], list[int]] = {}
    for k in found:
        cells = tuple(cell_text(table.rows[k].get(column)) for column in columns)
        alike.setdefault((0 if groups is None else groups.of_row[k], cells), []).append(k)
    rows, amounts = list[Row](), list[float]()
    for (group, cells), own in alike.items():
        amounts.append(
            float(len(own)) if options.size_by is None else math.fsum(found[k] for k in own)
        )
        if options.size_by is not None and len(own) == 1:
            rows.append(table.rows[own[0]])
            continue
        row: Row = dict(zip(columns, cells, strict=True))
        row[options.size_by or "rows"] = amounts[-1] if options.size_by else len(own)
        if groups is not None and options.by is not None and options.by not in columns:
            row[options.by] = groups.names[group]
        rows.append(row)
    return Amounts(rows, np.array(amounts), np.array([group for group, _ in alike]))


def marks_of(amounts: FloatArray, options: ChartOptions) -> tuple[list[int], FloatArray]:
    """Row of each mark, and its share of a whole one, of amounts ``(n,)`` of rows."""
    unit = options.unit
    if unit is None:
        total = float(len(amounts))
    else:
        with np.errstate(over="ignore"):  # of a tiny unit: too many in any case
            total = float(np.ceil(amounts / unit - SPECK).sum())
    are_circles = unit is None and not options.mark and options.mark_by is None
    if total > (MOST_CIRCLES if are_circles else MOST_MARKS):
        said = f"{total:,.0f}" if total < LARGE else f"more than {LARGE:,}"
        least = round_up((total if unit is None else float(amounts.sum())) / MOST_MARKS)
        raise RecipeError(
            "unit",
            f"there would be {said} marks; at most {MOST_MARKS:,} can be told apart: "
            f"use --unit {_least_unit(amounts, least, options):.12g} or more",
        )
    if unit is None:
        return list(range(len(amounts))), np.ones(len(amounts))
    owner: list[int] = []
    shares: list[float] = []
    for k, amount in enumerate((amounts / unit).tolist()):
        whole = math.floor(amount + SPECK)
        rest = amount - whole
        parts = [1.0] * whole + ([rest] if rest > SPECK else [])
        # A row that is less than a speck of a mark is still a row.
        parts = parts or [amount]
        owner += [k] * len(parts)
        shares += parts
    return owner, np.array(shares)


def _least_unit(amounts: FloatArray, first: float, options: ChartOptions) -> float:
    """A round unit that makes few enough marks, remainders counted."""
    counted = amounts if options.size_by or options.unit else np.array([float(len(amounts))])
    unit = first
    while len(counted) <= MOST_MARKS and np.ceil(counted / unit - SPECK).sum() > MOST_MARKS:
        unit = round_up(unit * 1.5)
    return unit
