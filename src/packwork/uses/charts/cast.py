"""Marks of a chart, as copies to be placed."""

from __future__ import annotations

from dataclasses import replace

from packwork.errors import RecipeError
from packwork.pipeline.plan.copies import Cast, expand_copies
from packwork.readers.charts.chart import ChartRead
from packwork.recipe import Recipe


def cast_chart(recipe: Recipe, chart: ChartRead) -> Cast:
    """Marks of a chart, each once, as large as its data say.

    Raises
    ------
    RecipeError
        As for :func:`expand_copies`, and if a rule would make sizes or numbers of marks untrue.
    """
    chosen = expand_copies(recipe, chart.items)
    for one in chosen.asked:
        untrue = [key for key in ("weight", "scale") if key in one.values]
        untrue += ["size"] if "size" in one.pin else []
        if untrue:
            key = untrue[0]
            source = one.sources.get(key) or one.sources["pin.size"]
            raise source.error(f"sets a {key}, but the data say how large marks are")
    if list(chosen.items) != list(chart.items):
        raise RecipeError("rules", "count marks, but the data say how many there are")
    return replace(chosen, weights=chart.areas)
