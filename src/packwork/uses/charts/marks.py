"""Marks of a unit chart, read from a table: of each, its meaning and its size."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ReadError, RecipeError, RowsLostError
from packwork.phrasing import number_of
from packwork.readers.charts import ChartOptions
from packwork.readers.items import read_items
from packwork.readers.options import ReadOptions
from packwork.readers.regions import Holes
from packwork.readers.tables.categories import all_categories, categories
from packwork.readers.tables.cells import (
    MISSING,
    cell_text,
    is_numeric,
    is_time,
    shown_decimal,
)
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.table import Row, Table
from packwork.scene.item import MAX_LENGTH, Datum, Item, Label
from packwork.uses.charts.groups import Groups, read_groups
from packwork.uses.charts.rows import (
    NUMBERS,
    marks_of,
    oddities,
    read_amounts,
    read_chart_table,
    sized_rows,
)
from packwork.uses.cutting import part_of

_LOG = logging.getLogger("packwork")

WIDEST = 1e6
"""Largest area over the smallest; the smallest could not be seen. Chosen."""

SHAPES = ("circle", "square", "triangle", "diamond", "star", "cross", "hexagon", "drop")
"""Marks of categories that were given none."""


@dataclass(frozen=True, eq=False)
class ChartRead:
    """Marks of a chart and what they stand for; ``(n,)`` of all marks, in the order of the table.

    ``areas`` are shares, ``values`` in the unit of the size column or numbers of rows. Marks of
    one row share ``rows`` and ``row_of``. ``marks`` are the drawings of categories that have
    their own, under an empty name if all have one. ``colour_of`` is None if colours are numbers
    (``is_ramp``) or not asked for. ``groups`` stand in the order in which they are shown; on a
    scale, a few names tell all (``is_ordered``). ``lost`` are those of the notices that are
    about rows with data. ``ends`` are the smallest and largest value of all, whichever are
    shown.
    """

    options: ChartOptions
    items: tuple[Item, ...]
    areas: FloatArray
    values: FloatArray
    rows: tuple[Row, ...]
    row_of: IntArray
    marks: Mapping[str, Item]
    colour_of: tuple[str, ...] | None
    is_ramp: bool
    table: Table
    groups: tuple[str, ...]
    group_of: IntArray
    is_ordered: bool
    notices: tuple[str, ...]
    lost: tuple[str, ...]
    ends: tuple[float, float]
    decimal: str = "."

    @property
    def size_decimal(self) -> str:
        """Mark before the fraction of sizes, or the colons of one that is a length of time."""
        cells = (row.get(self.options.size_by or "") for row in self.table.rows)
        time = next(filter(is_time, cells), None)
        return self.decimal if time is None else ":" * time.count(":")

    @property
    def told(self) -> tuple[ReadError, ...]:
        """The notices, those of lost rows as such."""
        name = self.table.name
        return tuple(
            (RowsLostError if text in self.lost else ReadError)(name, text) for text in self.notices
        )

    def subset(self, marks: IntArray) -> ChartRead:
        """The same chart with some of its marks, by their indices ``(m,)``."""
        colours = None if self.colour_of is None else tuple(self.colour_of[k] for k in marks)
        return replace(
            self,
            items=tuple(self.items[k] for k in marks),
            areas=self.areas[marks],
            values=self.values[marks],
            rows=tuple(self.rows[k] for k in marks),
            row_of=self.row_of[marks],
            colour_of=colours,
            group_of=self.group_of[marks],
        )


def read_chart(
    options: ChartOptions,
    holes: Holes = "fill",
    asked: TableFormat | None = None,
    reading: ReadOptions | None = None,
    *,
    has_names: bool = False,
) -> ChartRead:
    """Marks of a chart; where colours have names (``has_names``), numbers are categories too.

    So they are in a column that holds categories.

    Examples
    --------
    >>> rows = ({"land": "Peru", "t": 25}, {"land": "Kenya", "t": 10}, {"land": "Fiji", "t": 0})
    >>> chart = read_chart(ChartOptions(data=rows, size_by="t", label_by="land", unit=10))
    >>> [item.name for item in chart.items], chart.areas.tolist()
    (['Peru', 'Peru', 'Peru', 'Kenya'], [1.0, 1.0, 0.5, 1.0])
    >>> chart.notices
    ('left out 1 row of 3 whose t is 0: Fiji',)
    """
    asked = asked or TableFormat()
    table = read_chart_table(options, asked)
    sized, of_sizes = sized_rows(table, options, keeps_totals=asked.keep_totals)
    groups = read_groups(table, options, sized)
    shown_rows = read_amounts(table, options, groups, sized)
    rows, amounts = shown_rows.rows, shown_rows.amounts
    owner, shares = marks_of(amounts, options)
    kinds, more = _categories(rows, options.mark_by)
    marks = _drawings(options, table, kinds, holes, reading)
    column = None if has_names or options.color_by in options.categorical else options.color_by
    is_ramp = column is not None and is_numeric(rows, column)
    colours, told = _categories(rows, None if is_ramp else options.color_by)
    items = _items(
        rows, owner, shares, [marks[kind] for kind in kinds or [""] * len(rows)], options
    )
    colour_of = None if colours is None else tuple(colours[k] for k in owner)
    of_groups = {} if groups is None else groups.notices
    of_rows = dict.fromkeys(table.notices, False) | of_sizes | of_groups
    notices = of_rows | dict.fromkeys((*oddities(table, options), *more, *told), False)
    for notice in notices:
        _LOG.warning("%s", f"{table.name}: {notice}" if notice in table.notices else notice)
    values = amounts[owner] if options.unit is None else options.unit * shares
    columns = {column for key in NUMBERS if (column := getattr(options, key)) is not None}
    number_cells = (row.get(column) for row in table.rows for column in columns)
    names, group_of = _groups_of_marks(groups, shown_rows.groups[owner])
    in_group = [names[k] for k in group_of] if names else [""] * len(items)
    data = zip(owner, values.tolist(), colour_of or [""] * len(items), in_group, strict=True)
    return ChartRead(
        options=options,
        items=tuple(
            replace(item, datum=Datum(rows[k], value, category, group))
            for item, (k, value, category, group) in zip(items, data, strict=True)
        ),
        areas=_areas(items, values, shares, options),
        values=values,
        rows=tuple(rows[k] for k in owner),
        row_of=np.asarray(owner, dtype=np.int64),
        marks=marks,
        colour_of=colour_of,
        is_ramp=is_ramp,
        table=table,
        groups=names,
        group_of=group_of,
        is_ordered=groups is not None and groups.is_ordered,
        notices=tuple(notices),
        lost=tuple(notice for notice, is_lost in notices.items() if is_lost),
        ends=(float(values.min()), float(values.max())),
        decimal=asked.decimal or shown_decimal(number_cells),
    )


def _groups_of_marks(groups: Groups | None, member: IntArray) -> tuple[tuple[str, ...], IntArray]:
    """Names of the groups that are shown, none if there are none; and which each mark is in.

    Of values only those that have marks are shown, of steps those between as well.
    """
    if groups is None:
        return (), np.zeros(len(member), dtype=np.int64)
    there = np.unique(member)
    kept = np.arange(there[0], there[-1] + 1) if groups.has_steps else there
    return tuple(groups.names[k] for k in kept), np.searchsorted(kept, member)


def _categories(rows: Sequence[Row], column: str | None) -> tuple[list[str] | None, Sequence[str]]:
    return (None, ()) if column is None else categories(rows, column)


def _drawings(
    options: ChartOptions,
    table: Table,
    kinds: Sequence[str] | None,
    holes: Holes,
    reading: ReadOptions | None,
) -> dict[str, Item]:
    """Mark of each category: that of its name, the others in turn, by the alphabet."""
    given: tuple[Item, ...] = ()
    if kinds or options.mark:
        given = read_items(options.mark or SHAPES, holes=holes, reading=reading).items
    if kinds is None or options.mark_by is None:
        if len(given) > 1:
            raise RecipeError("mark", f"gives {len(given)} marks; say which row has which: mark_by")
        return {"": given[0] if given else read_items("circle").items[0]}
    there = dict.fromkeys(kinds)
    names = list(all_categories(table.rows, options.mark_by, there))
    if len(names) + (MISSING in there) > len(given):
        names = [name for name in names if name in there]
    names += [name for name in there if name == MISSING]
    if options.mark and len(names) > len(given):
        raise RecipeError(
            "mark_by",
            f"has {len(names)} values for {number_of(len(given), 'mark')}; give one for each",
        )
    if len(names) > len(given):
        raise RecipeError(
            "mark_by",
            f"has {len(names)} values; at most {len(SHAPES)} shapes can be told apart: "
            "give a --mark for each",
        )
    named = {item.name.casefold(): item for item in given}
    own = {name: named[name.casefold()] for name in names if name.casefold() in named}
    left = iter(item for item in given if item not in own.values())
    found = {name: own[name] if name in own else next(left) for name in names}
    return {name: mark for name, mark in found.items() if name in there}


def _items(
    rows: Sequence[Row],
    owner: Sequence[int],
    shares: FloatArray,
    drawings: Sequence[Item],
    options: ChartOptions,
) -> tuple[Item, ...]:
    """One item per mark; whole ones of one drawing share its art."""
    parts: dict[tuple[Item, float], Item] = {}
    items = []
    for k, share in zip(owner, shares.tolist(), strict=True):
        drawn = drawings[k]
        key = (drawn, share)
        if key not in parts:
            parts[key] = drawn if share == 1.0 else part_of(drawn, share)
        name, label = _said(rows[k], drawn, options)
        items.append(replace(parts[key], name=name, label=label))
    return tuple(items)


def _said(row: Row, drawn: Item, options: ChartOptions) -> tuple[str, Label]:
    """Name and label of a row's mark; its tooltip holds the row."""
    name = drawn.name if options.label_by is None else cell_text(row.get(options.label_by))
    title = "; ".join(f"{column}: {cell_text(cell)}" for column, cell in row.items())
    own = name[:MAX_LENGTH] if options.label_by is not None else ""
    return name[:MAX_LENGTH], Label(name=own, title=title[:MAX_LENGTH])


def _areas(
    items: Sequence[Item], values: FloatArray, shares: FloatArray, options: ChartOptions
) -> FloatArray:
    """``(n,)`` areas in shares, such that what sizes are meant to say is in proportion."""
    if options.unit is not None:
        wholes = shares
    elif options.size_by is None:
        wholes = np.ones(len(items))
    elif options.size_is == "area":
        wholes = values
    else:
        wholes = np.array([_area_over_side(item, options.size_is) for item in items]) * values**2
    wholes = wholes / wholes.max()
    if wholes.min() < 1 / WIDEST:
        raise ReadError(
            options.size_by or "data",
            f"the largest mark would be {1 / wholes.min():.2g} times the smallest; at most "
            f"{WIDEST:g} can be shown: leave out the smallest rows, or use --unit",
        )
    return np.asarray(wholes)


def _area_over_side(item: Item, side: str) -> float:
    left, top, right, bottom = item.outline.bounds
    length = bottom - top if side == "height" else right - left
    return item.outline.area / length**2
