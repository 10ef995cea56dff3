"""Colours of marks: by category, or by number along a ramp."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from packwork.errors import RecipeError
from packwork.phrasing import number_of
from packwork.readers.charts.chart import ChartKeys, ChartRead
from packwork.readers.charts.columns import MISSING, as_number, is_missing
from packwork.recipe import Recipe
from packwork.scene.contrast import between, readable
from packwork.scene.palette import check_named, own_colours, palette_colours

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
    """Colours of marks, and what they mean.

    Parameters
    ----------
    marks
        One per mark; None for one that keeps its own.
    keys
        Colour of each category, by the alphabet, that of no value last; of a ramp that alone.
    ramp
        Its colours from small to large; empty for categories.
    ends
        Smallest and largest number of the ramp.
    """

    marks: tuple[str | None, ...]
    keys: tuple[tuple[str, str], ...] = ()
    ramp: tuple[str, ...] = ()
    ends: tuple[float, float] = (0.0, 0.0)


def chart_colours(recipe: Recipe, chart: ChartRead) -> ChartColours:
    """Colours of all marks.

    Raises
    ------
    RecipeError
        If there are more categories than the palette has colours.
    """
    paper, column = chart.options.paper, chart.options.color_by
    if chart.is_ramp and column is not None:
        return _ramp(recipe, chart, column)
    if chart.colour_of is None:
        first = None if recipe.palette is None else palette_colours(recipe.palette)[0]
        return ChartColours((first,) * len(chart.items))
    return _by_category(recipe, chart.colour_of, chart.keys, paper)


def _by_category(
    recipe: Recipe, names: Sequence[str], known: ChartKeys, paper: str
) -> ChartColours:
    own = own_colours(recipe.palette)
    there = [name for name in known.names if name in known.order]
    # Of the whole column, so that a value keeps its colour where others are left out.
    for order in (known.names, there):
        others = [name for name in order if name.casefold() not in own]
        palette = _palette(recipe, CATEGORIES) if not own else palette_colours(CATEGORIES)
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
    colours |= {name: own[name.casefold()] for name in known.order if name.casefold() in own}
    keys = {name: colours[name] for name in (*there, MISSING) if name in known.order}
    return ChartColours(tuple(keys[name] for name in names), tuple(keys.items()))


def check_palette(recipe: Recipe, chart: ChartRead) -> None:
    """Refuse a palette that does not fit the data; tell of names that it gives in vain.

    Raises
    ------
    RecipeError
        If there are too few colours, or they are given to names and the marks have none.
    """
    chart_colours(recipe, chart)
    if not isinstance(recipe.palette, Mapping):
        return
    known, column = (*chart.keys.names, *chart.keys.order), chart.options.color_by
    if not known:
        why = "its numbers run along a list of colours" if column else "which column's? --color-by"
        raise RecipeError("palette", f"gives colours to names: {why}")
    check_named(recipe.palette, column or "", known)


def _ramp(recipe: Recipe, chart: ChartRead, column: str) -> ChartColours:
    cells = [row.get(column) for row in chart.rows]
    numbers = [as_number(cell) for cell in cells]
    low, high = chart.keys.ends
    ramp = _palette(recipe, RAMP)
    span = high - low or 1.0
    marks = tuple(
        UNKNOWN if is_missing(cell) else between(ramp, (number - low) / span)
        for cell, number in zip(cells, numbers, strict=True)
    )
    keys = ((MISSING, UNKNOWN),) if chart.keys.has_gaps else ()
    return ChartColours(marks, keys, ramp, (low, high))


def _palette(recipe: Recipe, default: str) -> tuple[str, ...]:
    return palette_colours(default if recipe.palette is None else recipe.palette)
