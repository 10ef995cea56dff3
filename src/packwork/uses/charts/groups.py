"""Rows of a chart in groups: by the values of a column, or by steps of its numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from packwork.errors import RecipeError
from packwork.phrasing import enumerated, number_of
from packwork.readers.charts import ChartOptions
from packwork.readers.tables.categories import categories
from packwork.readers.tables.cells import (
    as_number,
    cell_text,
    is_missing,
    is_numeric,
)
from packwork.readers.tables.pairs import MOST_NAMED
from packwork.readers.tables.table import Table

MOST_GROUPS = 60
"""Groups of one chart: on a canvas of 600 px each has 10 px. More could not be told apart.
Derived."""

MOST_REGIONS = 400
"""Those in regions of a map, which tell them apart: the districts of Germany. Larger takes minutes:
99 counties 11 s of one core, 254 25 s. Tried."""

YEARS = (1000, 2999)
"""Whole numbers that count as years, whose tens are called decades: the 1990s. Chosen."""

ROUNDING = 1e-9
"""Steps by which a number may miss the edge of one: 0.3 / 0.1 is less than 3. Derived."""

MOST_STEPS = 1e12
"""Steps from 0 to a number at most: beyond, rounding decides in which one it is. Derived."""

LARGE = 10**9
"""Counts from which on only about how many is said. Chosen."""

_DATE = re.compile(r"\d{4}-\d{2}(-\d{2}([T ][\d:.,+Z-]*)?)?")


@dataclass(frozen=True, eq=False)
class Groups:
    """Rows that belong together, by the number of each row's group, -1 for those in none.

    ``names`` stand in the order in which groups are shown. ``has_steps``: they are steps of a
    scale, on which empty ones show; ``is_ordered``: they ascend. ``notices`` are sentences
    about what was left out or put together, and whether that says something of a group.
    """

    names: tuple[str, ...]
    of_row: tuple[int, ...]
    has_steps: bool
    is_ordered: bool
    notices: dict[str, bool]


def read_groups(table: Table, options: ChartOptions, shown: Collection[int]) -> Groups | None:
    """Groups that a chart asks for; None if it asks for none.

    Numbers and dates ascend, all else comes as it first stands in the table. Of those
    in no group the rows that would be ``shown`` are named: others are left out anyway.

    Examples
    --------
    >>> rows = ({"year": 1999}, {"year": 1962}, {"year": 1995}, {"year": None})
    >>> asked = ChartOptions(data=rows, by="year", by_step=10)
    >>> groups = read_groups(Table("data", ("year",), rows), asked, range(4))
    >>> groups.names, groups.of_row
    (('1960s', '1970s', '1980s', '1990s'), (3, 0, 3, -1))
    >>> groups.notices
    {'left out 1 row of 4 whose year is missing: row 4': False}
    """
    column = options.by
    if column is None:
        return None
    if options.by_step is not None:
        return _steps(table, column, options.by_step, options, shown)
    missing = [k for k, row in enumerate(table.rows) if is_missing(row.get(column))]
    has_numbers, told = is_numeric(table.rows, column), list[str]()
    if has_numbers:
        named = [f"{as_number(row.get(column)):.12g}" for row in table.rows]
    else:
        named, told = categories(table.rows, column)
    for k in missing:
        named[k] = ""
    names = tuple(dict.fromkeys(filter(None, named)))
    if not names:
        raise RecipeError("by", f"column {column!r} holds nothing; group by another")
    _check_count(len(names), table, options, column)
    is_ordered = has_numbers or all(_DATE.fullmatch(name) for name in names)
    if is_ordered:
        names = tuple(sorted(names, key=float if has_numbers else None))
    numbers = {"": -1} | {name: number for number, name in enumerate(names)}
    odd = [k for k in missing if k in shown]
    said = [left_out(table, column, "is missing", odd, options.label_by)] if odd else []
    of_row = tuple(numbers[name] for name in named)
    return Groups(names, of_row, False, is_ordered, dict.fromkeys([*said, *told], False))


def _steps(
    table: Table, column: str, step: float, options: ChartOptions, shown: Collection[int]
) -> Groups:
    """Groups of numbers from one multiple of the step up to the next."""
    numbers = [as_number(row.get(column)) for row in table.rows]
    held = [number for number in numbers if not math.isnan(number)]
    if not held:
        texts = [row.get(column) for row in table.rows if not is_missing(row.get(column))]
        if not texts:
            raise RecipeError("by", f"column {column!r} holds nothing; group by another")
        met = cell_text(texts[0])[:30]
        raise RecipeError(
            "by_step", f"needs numbers; column {column!r} holds {met!r}: leave the step out"
        )
    farthest = max(map(abs, held))
    if not farthest / step < MOST_STEPS:
        raise RecipeError(
            "by_step", f"{step:g} is too small for numbers up to {farthest:.2g}; use a larger one"
        )
    first, last = (math.floor(end / step + ROUNDING) for end in (min(held), max(held)))
    _check_count(last - first + 1, table, options, column)
    names = tuple(_step_name(k * step, step, held) for k in range(first, last + 1))
    of_row = tuple(
        -1 if math.isnan(number) else math.floor(number / step + ROUNDING) - first
        for number in numbers
    )
    said = {}
    for why, is_so in (("is missing", True), ("is no number", False)):
        which = [
            k
            for k, number in enumerate(of_row)
            if number < 0 and k in shown and is_missing(table.rows[k].get(column)) == is_so
        ]
        if which:
            said[left_out(table, column, why, which, options.label_by)] = not is_so
    return Groups(names, of_row, True, True, said)


def _step_name(begin: float, step: float, numbers: Sequence[float]) -> str:
    """Name of the numbers from one multiple of the step up to the next.

    Examples
    --------
    >>> _step_name(1990, 10, [1991, 1999]), _step_name(20, 5, [21]), _step_name(0.5, 0.5, [0.7])
    ('1990s', '20–24', '0.5–1')
    """
    if not all(number.is_integer() for number in map(float, [*numbers, step])):
        return f"{begin:.6g}–{begin + step:.6g}"
    if step == 10 and YEARS[0] <= min(numbers) and max(numbers) <= YEARS[1]:
        return f"{begin:.0f}s"
    return f"{begin:.12g}" if step == 1 else f"{begin:.12g}–{begin + step - 1:.12g}"


def _check_count(count: int, table: Table, options: ChartOptions, column: str) -> None:
    most = MOST_REGIONS if options.in_regions else MOST_GROUPS
    if count <= most:
        return
    numbers = [as_number(row.get(column)) for row in table.rows]
    held = [number for number in numbers if not math.isnan(number)]
    advice = "group by a column of fewer values"
    if count <= MOST_REGIONS:
        advice += ", or on a map of them by --in-regions"
    if is_numeric(table.rows, column) and math.isfinite(max(held) - min(held)):
        # A step more than divides it: the first need not begin at the smallest number.
        least = round_up((max(held) - min(held)) / (most - 1))
        advice = f"use --by-step {least:.12g} or more"
    said = f"{count:,}" if count < LARGE else f"{count:.2g}"
    raise RecipeError(
        "by",
        f"column {column!r} makes {said} groups; at most {most} can be told apart: " + advice,
    )


def row_name(table: Table, row: int, label_by: str | None) -> str:
    """Name of a row in messages: its label or, without one, its number."""
    label = None if label_by is None else table.rows[row].get(label_by)
    return f"row {row + 1}" if is_missing(label) else cell_text(label)[:40]


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
    return left_out_named(table, column, why, [row_name(table, k, label_by) for k in which])


def left_out_named(table: Table, column: str, why: str, names: Sequence[str]) -> str:
    """The same of rows that are called by these names."""
    count = f"{number_of(len(names), 'row')} of {len(table.rows)}"
    names = [name[:40] for name in names]
    return f"left out {count} whose {column} {why}: {enumerated(names, MOST_NAMED)}"


def round_up(value: float) -> float:
    """The next of 1, 2, 5, 10, 20 ...

    Examples
    --------
    >>> round_up(21.0), round_up(0.7)
    (50.0, 1.0)
    """
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= value * 0.999999)
