"""Series of a chart: the same container and keys for each step, and the marks of its rows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.pipeline.job import Clock, Job
from packwork.pipeline.read import Material, job_of, read_room
from packwork.readers.tables.cells import MISSING
from packwork.recipe import Recipe
from packwork.steps.assign_in_order import with_order
from packwork.uses.charts.colours import chart_colours
from packwork.uses.charts.layout import Chart, spread_out
from packwork.uses.charts.marks import ChartRead, read_chart
from packwork.uses.charts.use import ChartUse, cast_chart
from packwork.uses.icons import NO_CONTAINER


@dataclass(frozen=True, eq=False)
class ChartStep:
    """Marks of one step, and ``(n,)`` names: one that two steps have is one mark."""

    label: str
    job: Job
    names: tuple[str, ...]


def read_steps(recipe: Recipe) -> list[ChartStep]:
    """Steps of a chart, one for each group of its rows that has marks.

    A title may name the step, as ``Harvest of {year}``.
    """
    asked = recipe.chart
    if asked is None or asked.by is None:
        raise RecipeError("series", "is of a chart whose rows have a column of steps")
    if recipe.container == NO_CONTAINER:
        raise RecipeError("container", "none shows groups as bars; a series needs a container")
    has_names = isinstance(recipe.palette, Mapping)
    grouped = read_chart(asked, recipe.holes, recipe, recipe.read_options, has_names=has_names)
    there = [k for k in range(len(grouped.groups)) if (grouped.group_of == k).any()]
    if len(there) < 2:
        raise RecipeError("series", f"column {asked.by!r} says one step; 2 or more go")
    # Groups are no groups of one chart here: no copies of the container, no names beside them.
    read = replace(grouped, groups=(), options=asked.model_copy(update={"by": None}))
    colours = chart_colours(recipe, read)
    chart, container = spread_out(recipe, read, colours, read_room(recipe, None))
    material = Material(
        use=ChartUse(chart),
        container=container,
        cast=cast_chart(recipe, read),
        fillers=(),
        skipped=read.told,
    )
    whole = with_order(job_of(recipe, material, Clock()))
    return [
        _step(whole, chart, grouped.groups[k], asked.by, np.flatnonzero(grouped.group_of == k))
        for k in there
    ]


def _step(whole: Job, chart: Chart, label: str, column: str, marks: IntArray) -> ChartStep:
    """One step of a job of all marks, whose recipe gives its layout alone."""
    job, chart = whole.subset(marks), chart.subset(marks)
    own = chart.read
    title = own.options.title
    if title is not None:
        title = title.replace(f"{{{column}}}", label)
    rows = tuple(map(dict, dict(zip(own.row_of.tolist(), own.rows, strict=True)).values()))
    options = own.options.model_copy(update={"title": title})
    recipe = job.recipe.model_copy(
        update={
            "chart": options.model_copy(update={"data": rows, "by_step": None}),
            "palette": _colours_of_all(job.recipe, chart),
        }
    )
    use = ChartUse(replace(chart, read=replace(own, options=options)))
    return ChartStep(label, replace(job, recipe=recipe, use=use), mark_names(own))


def _colours_of_all(recipe: Recipe, chart: Chart) -> Any:
    """Palette with the colour of each category; of a step alone it would give others."""
    keys = () if chart.read.is_ramp else chart.colours.keys
    named = {name: colour for name, colour in keys if name != MISSING}
    return named or recipe.palette


def mark_names(chart: ChartRead) -> tuple[str, ...]:
    """``(n,)`` names of marks that hold from step to step.

    Marks that a column names go by that and their number among those of that name; all others by
    what they look like.
    """
    is_named = chart.options.label_by is not None
    colours = chart.colour_of or ("",) * len(chart.items)
    seen: Counter[tuple[str, str]] = Counter()
    names = []
    for item, colour in zip(chart.items, colours, strict=True):
        look = (item.name, "" if is_named else colour)
        seen[look] += 1
        names.append("\t".join((*look, str(seen[look]))))
    return tuple(names)
