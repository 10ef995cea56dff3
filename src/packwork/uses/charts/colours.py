"""Colours of marks: by category, or by number along a ramp."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.phrasing import number_of
from packwork.readers.tables.categories import all_categories
from packwork.readers.tables.cells import MISSING, as_number, is_missing
from packwork.recipe import Recipe
from packwork.scene.contrast import between, readable
from packwork.scene.palette import check_named, own_colours, palette_colours
from packwork.uses.charts.marks import ChartRead

CATEGORIES = "okabe-ito"
"""Colours of categories that are given none. Its black goes last: it reads as ink."""

RAMP = "viridis"
"""Colours from small to large, where none are given, in the direction of other programs."""

UNKNOWN = "#9aa0a6"
"""Colour of what holds nothing: grey is in no palette of ours."""

LEAST_CONTRAST = 1.3
"""Of a mark and what is behind it, so that its form is seen. Larger darkens yellows until they
look brown. Chosen by eye."""


@dataclass(frozen=True)
class ChartColours:
    """Colour of each mark, None for its own, and what colours mean.

    ``keys`` are categories by the alphabet, that of no value last; ``ramp`` the colours from
    the smaller to the larger of ``ends``, empty for categories.
    """

    marks: tuple[str | None, ...]
    keys: tuple[tuple[str, str], ...] = ()
    ramp: tuple[str, ...] = ()
    ends: tuple[float, float] = (0.0, 0.0)

    def subset(self, marks: IntArray) -> ChartColours:
        """The same of some of the marks, by their indices ``(m,)``."""
        return replace(self, marks=tuple(self.marks[k] for k in marks))


def chart_colours(recipe: Recipe, chart: ChartRead) -> ChartColours:
    """Colours of all marks; names to which the palette gives some in vain are told."""
    column, known = chart.options.color_by, tuple[str, ...]()
    if column is not None and chart.is_ramp:
        colours = _ramp(recipe, chart, column)
    elif column is not None and chart.colour_of is not None:
        known = all_categories(chart.table.rows, column, chart.colour_of)
        colours = _by_category(recipe, chart.colour_of, known, chart.options.paper)
    else:
        first = None if recipe.palette is None else palette_colours(recipe.palette)[0]
        colours = ChartColours((first,) * len(chart.items))
    if isinstance(recipe.palette, Mapping):
        named = (*known, *(chart.colour_of or ()))
        if not named:
            raise RecipeError("palette", "gives colours to names: which column's? --color-by")
        check_named(recipe.palette, column or "", named)
    return colours


def _by_category(
    recipe: Recipe, categories: tuple[str, ...], known: tuple[str, ...], paper: str
) -> ChartColours:
    own, there = own_colours(recipe.palette), set(categories)
    shown = [name for name in known if name in there]
    # Of the whole column, so that a value keeps its colour where others are left out.
    for order in (known, shown):
        others = [name for name in order if name.casefold() not in own]
        palette = palette_colours(CATEGORIES) if own else _palette(recipe, CATEGORIES)
        if recipe.palette is None or own:
            palette = tuple(readable(colour, paper, LEAST_CONTRAST) for colour in palette)
        palette = tuple(colour for colour in palette if colour not in own.values())
        if len(others) <= len(palette):
            break
    else:
        raise RecipeError(
            "color_by",
            f"has {len(others)} values, the palette {number_of(len(palette), 'colour')}; "
            "colour by a column of fewer, or give a --palette of as many",
        )
    colours = {**dict(zip(others, palette, strict=False)), MISSING: UNKNOWN}
    colours |= {name: own[name.casefold()] for name in there if name.casefold() in own}
    keys = {name: colours[name] for name in (*shown, MISSING) if name in there}
    return ChartColours(tuple(keys[name] for name in categories), tuple(keys.items()))


def _ramp(recipe: Recipe, chart: ChartRead, column: str) -> ChartColours:
    cells = [row.get(column) for row in chart.rows]
    numbers = [as_number(cell) for cell in cells]
    low, high = float(np.nanmin(numbers)), float(np.nanmax(numbers))
    ramp = _palette(recipe, RAMP)
    span = high - low or 1.0
    marks = tuple(
        UNKNOWN if is_missing(cell) else between(ramp, (number - low) / span)
        for cell, number in zip(cells, numbers, strict=True)
    )
    keys = ((MISSING, UNKNOWN),) if any(map(is_missing, cells)) else ()
    return ChartColours(marks, keys, ramp, (low, high))


def _palette(recipe: Recipe, default: str) -> tuple[str, ...]:
    return palette_colours(default if recipe.palette is None else recipe.palette)
