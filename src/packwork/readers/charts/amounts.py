"""Amounts that rows of a chart stand for, and the numbers of marks that they make."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.readers.charts.columns import LARGE, Sizes, round_up, shown, sizes
from packwork.readers.charts.groups import Groups
from packwork.readers.charts.options import ChartOptions
from packwork.readers.tables.table import Row, Table

MOST_MARKS = 5_000
"""Marks of one chart: on a canvas of 600 px each would be 5 px wide. More could not be told
apart. Derived."""

SPECK = 1e-3
"""Share of a mark below which a remainder is rounding of the numbers, not a part. Chosen."""


@dataclass(frozen=True, eq=False)
class Amounts:
    """Rows that are shown, and how much each stands for.

    Parameters
    ----------
    rows
        As in the table, or one for all that are shown alike.
    amounts
        ``(n,)`` in the unit of the size column, or numbers of rows.
    groups
        ``(n,)`` number of each one's group; zeros where there are none.
    notices
        What was left out, a sentence each.
    lost
        Those of them about rows with data.
    """

    rows: list[Row]
    amounts: FloatArray
    groups: IntArray
    notices: Sequence[str]
    lost: Sequence[str] = ()


def read_amounts(table: Table, options: ChartOptions, groups: Groups | None) -> Amounts:
    """Rows of a table that are shown; those in no group are not.

    Raises
    ------
    RecipeError
        If none can be.
    """
    member = [0] * len(table.rows) if groups is None else groups.of_row
    if options.size_by is not None:
        sized = sizes(table, options.size_by, options.label_by)
    else:
        sized = Sizes(dict.fromkeys(range(len(table.rows)), 1.0))
    found = sized.of_row
    which = [k for k in found if member[k] >= 0]
    if not which:
        raise RecipeError("by", f"no row has both a group in {options.by!r} and a size")
    if options.size_by is None and options.unit is not None:
        return _counted(table, options, groups, which)
    return Amounts(
        [table.rows[k] for k in which],
        np.array([found[k] for k in which]),
        np.array([member[k] for k in which], dtype=np.int64),
        sized.notices,
        sized.lost,
    )


def _counted(
    table: Table, options: ChartOptions, groups: Groups | None, which: Sequence[int]
) -> Amounts:
    """Rows that are shown alike as one, with their number."""
    shown_of = (options.color_by, options.mark_by, options.label_by)
    columns = list(dict.fromkeys(column for column in shown_of if column is not None))
    counts: dict[tuple[int, tuple[str, ...]], int] = {}
    for k in which:
        group = 0 if groups is None else groups.of_row[k]
        key = (group, tuple(shown(table.rows[k].get(column)) for column in columns))
        counts[key] = counts.get(key, 0) + 1
    rows = [
        dict(zip(columns, cells, strict=True)) | {"rows": n} for (_, cells), n in counts.items()
    ]
    if groups is not None and options.by is not None and options.by not in columns:
        for row, (group, _) in zip(rows, counts, strict=True):
            row[options.by] = groups.names[group]
    amounts = np.array(list(counts.values()), dtype=np.float64)
    return Amounts(rows, amounts, np.array([group for group, _ in counts]), ())


def marks_of(amounts: FloatArray, options: ChartOptions) -> tuple[list[int], FloatArray]:
    """Row of each mark, and its share of a whole one, of amounts ``(n,)`` of rows.

    Raises
    ------
    RecipeError
        If there are too many to be told apart.
    """
    unit = options.unit
    if unit is None:
        total = float(len(amounts))
    else:
        with np.errstate(over="ignore"):  # of a tiny unit: too many in any case
            total = float(np.ceil(amounts / unit - SPECK).sum())
    if total > MOST_MARKS:
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
