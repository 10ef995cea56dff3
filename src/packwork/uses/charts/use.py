"""Unit charts: a mark for each row of a table, its size as the data say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.pipeline.job import Job
from packwork.pipeline.measure import Unmeasured, measured
from packwork.pipeline.read import Material
from packwork.pipeline.result import Run
from packwork.pipeline.run import along
from packwork.pipeline.use import Use
from packwork.pipeline.watch import Watch
from packwork.readers.charts.chart import read_chart
from packwork.readers.charts.options import ChartOptions
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.scene.note import Note
from packwork.uses.charts.cast import cast_chart
from packwork.uses.charts.chart import Chart
from packwork.uses.charts.colours import chart_colours, check_palette
from packwork.uses.charts.groups import run_groups
from packwork.uses.charts.layout import spread_out
from packwork.uses.charts.legend import legend_notes
from packwork.uses.charts.mark_labels import mark_labels


@final
@dataclass(frozen=True, eq=False)
class Marks(Use):
    """Marks of a chart."""

    chart: Chart

    def run(self, job: Job, watch: Watch) -> Run:
        """The common road, or that of groups placed one after another."""
        if self.chart.cells:
            return run_groups(job, self.chart, watch)
        return measured(Unmeasured.of(along(job, watch)))

    def some(self, kept: IntArray) -> Marks:
        """The same of some of the marks."""
        return Marks(self.chart.some(kept))

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours that stand for data; None if marks keep their own."""
        del layout
        colours = chart_colours(job.recipe, self.chart.read).marks
        return list(colours) if any(colours) else None

    @property
    def has_nearest(self) -> bool:
        """Not of marks, whose colours the palette gives by data."""
        return False

    def notes(self, job: Job, layout: Layout, worn: Layout) -> tuple[Note, ...]:
        """Labels on marks, title, names of groups and legend."""
        return (*mark_labels(self.chart, worn), *legend_notes(job.recipe, self.chart, layout))

    @property
    def shows_shape(self) -> bool:
        """Whether the marks are to show a container's shape: not where it is there repeatedly."""
        return not self.chart.cells

    def remedy(self, job: Job) -> str:
        """Another container: the data say how many marks there are, and how large."""
        del job
        return "a container without thin parts, such as circle, would show"


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
        use=Marks(Chart(read, spread.frame, spread.cells, spread.single)),
        container=spread.container,
        cast=chosen,
        fillers=(),
        skipped=read.told,
    )
