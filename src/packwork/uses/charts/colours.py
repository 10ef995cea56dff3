"""Colours of marks: by category, or by number along a ramp."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from packwork.errors import RecipeError
from packwork.phrasing import number_of
from packwork.readers.charts.chart import ChartRead
from packwork.readers.charts.columns import MISSING, as_number, is_missing
from packwork.recipe import Recipe
from packwork.scene.contrast import between, contrast, readable
from packwork.scene.palette import palette_colours

CATEGORIES = "okabe-ito"
"""Colours of categories that are given none. Its black goes last: it reads as ink."""

RAMP = "viridis"
"""Colours from small to large, where none are given."""

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
        Colour of each category, the most frequent first; empty for a ramp.
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
        return _ramp(recipe, chart, column, paper)
    if chart.colour_of is None:
        first = None if recipe.palette is None else palette_colours(recipe.palette)[0]
        return ChartColours((first,) * len(chart.items))
    return _by_category(recipe, chart.colour_of, chart.keys.order, paper)


def _by_category(
    recipe: Recipe, names: Sequence[str], all_of_them: Sequence[str], paper: str
) -> ChartColours:
    order = [name for name in all_of_them if name != MISSING]
    palette = _palette(recipe, CATEGORIES)
    if recipe.palette is None:
        palette = tuple(readable(colour, paper, LEAST_CONTRAST) for colour in palette)
    if len(order) > len(palette):
        raise RecipeError(
            "color_by",
            f"has {len(order)} values, the palette {number_of(len(palette), 'colour')}; "
            "colour by a column of fewer, or give a --palette of as many",
        )
    keys = dict(zip(order, palette, strict=False))
    if MISSING in all_of_them:
        keys[MISSING] = UNKNOWN
    return ChartColours(tuple(keys[name] for name in names), tuple(keys.items()))


def _ramp(recipe: Recipe, chart: ChartRead, column: str, paper: str) -> ChartColours:
    cells = [row.get(column) for row in chart.rows]
    numbers = [as_number(cell) for cell in cells]
    low, high = chart.keys.ends
    ramp = _palette(recipe, RAMP)
    if recipe.palette is None and contrast(ramp[0], paper) > contrast(ramp[-1], paper):
        # The end that is more like the paper stands for little.
        ramp = ramp[::-1]
    span = high - low or 1.0
    marks = tuple(
        UNKNOWN if is_missing(cell) else between(ramp, (number - low) / span)
        for cell, number in zip(cells, numbers, strict=True)
    )
    return ChartColours(marks, ramp=ramp, ends=(low, high))


def _palette(recipe: Recipe, default: str) -> tuple[str, ...]:
    return palette_colours(default if recipe.palette is None else recipe.palette)
