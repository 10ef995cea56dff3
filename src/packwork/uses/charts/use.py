"""Unit charts: a mark for each row of a table, its size as the data say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.pipeline.job import Job, Use
from packwork.pipeline.plan.counts import LEAST, items_needed
from packwork.pipeline.read import Material
from packwork.pipeline.run import RunContext, RunStep
from packwork.pipeline.state import RunState
from packwork.readers.charts.chart import read_chart
from packwork.readers.charts.options import ChartOptions
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.steps.starts import fits_first
from packwork.uses.charts.cast import cast_chart
from packwork.uses.charts.chart import Chart
from packwork.uses.charts.colours import chart_colours, check_palette
from packwork.uses.charts.groups import FillGroups, check_groups
from packwork.uses.charts.layout import spread_out
from packwork.uses.charts.legend import legend_notes
from packwork.uses.charts.mark_labels import mark_labels
from packwork.uses.collage import filling, placing, reporting


@final
@dataclass(frozen=True, eq=False)
class ChartUse(Use):
    """Marks of a chart."""

    chart: Chart

    # The palette gives marks their colours by data.
    has_nearest = False

    def steps(self, job: Job) -> Sequence[RunStep]:
        """As icons; or groups one after another."""
        if self.chart.cells:
            check_groups(job, self.chart)
            return [FillGroups(self.chart), *self.report(job)]
        placed = placing(job, suits_first_fit=fits_first(job))
        return [*placed, *filling(job), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures, colours by data, titles, keys and labels.

        A container that is there repeatedly is not to be told by its shape.
        """
        shows_shape = not self.chart.cells
        return [*reporting(job, is_dressed=True, shows_shape=shows_shape), Annotate()]

    def subset(self, kept: IntArray) -> ChartUse:
        """The same of some of the marks."""
        return ChartUse(self.chart.subset(kept))

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours that stand for data; None if marks keep their own."""
        del layout
        colours = chart_colours(job.recipe, self.chart.read).marks
        return list(colours) if any(colours) else None

    def remedy(self, job: Job) -> str:
        """Another container, if so many marks would show a plain one; else more marks."""
        if items_needed(job.container).count > len(job.items) >= LEAST:
            return "a container without thin parts, such as circle, would show"
        return "more marks, of more rows or of a smaller --unit, would show more of it"


@final
class Annotate(RunStep):
    """Labels on marks, title, names of groups and legend."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State whose layout has these notes."""
        use, (layout, _) = state.job.use.inner, state.measured
        assert isinstance(use, ChartUse)  # noqa: S101 - it is on lists of charts alone
        legend = legend_notes(state.job.recipe, use.chart, layout)
        notes = (*mark_labels(use.chart, layout), *legend)
        return replace(state, layout=replace(layout, notes=notes))


def read_marks(recipe: Recipe, asked: ChartOptions, room: Container | None) -> Material:
    """Marks of a recipe's chart, in a container or, without one, in bars.

    Raises
    ------
    ReadError
        If the table or a mark cannot be read.
    RecipeError
        If an option has no meaning for this table.
    """
    if recipe.stroke_width == "even":
        raise RecipeError(
            "stroke_width", "even changes the areas of marks, which stand for numbers; leave it out"
        )
    read = read_chart(asked, recipe.holes, recipe, recipe.read_options)
    # Refuses too few colours before anything is run.
    check_palette(recipe, read)
    chosen = cast_chart(recipe, read)
    spread = spread_out(recipe, read, room)
    return Material(
        use=ChartUse(Chart(read, spread.frame, spread.cells, spread.single)),
        container=spread.container,
        cast=chosen,
        fillers=(),
        skipped=read.told,
    )
