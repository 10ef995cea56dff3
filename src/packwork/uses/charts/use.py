"""Unit charts: a mark for each row of a table, its size as the data say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, final

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.geometry.polygon import polygon_parts
from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job, Use
from packwork.pipeline.plan.copies import Cast, expand_copies
from packwork.pipeline.plan.counts import LEAST, items_needed
from packwork.pipeline.read import Material
from packwork.pipeline.recorder import Recorder
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.readers.charts import ChartOptions
from packwork.recipe import Recipe
from packwork.scene.container import Container, with_margin
from packwork.scene.layout import Layout
from packwork.scene.pose import Limits
from packwork.solve.solver import Ending
from packwork.steps.close_gap import RemarkGap, close_gap
from packwork.steps.control import Replan
from packwork.steps.jam_discs import jams_discs
from packwork.steps.starts import fits_first
from packwork.uses.charts.bars import fill_bars
from packwork.uses.charts.colours import chart_colours
from packwork.uses.charts.copies import fill_copies
from packwork.uses.charts.layout import Chart, spread_out
from packwork.uses.charts.legend import legend_notes
from packwork.uses.charts.mark_labels import mark_labels
from packwork.uses.charts.marks import ChartRead, read_chart
from packwork.uses.charts.regions import NamedRegion, in_regions
from packwork.uses.charts.rows import MOST_MARKS
from packwork.uses.collage import filling, jamming, placing, reporting

CLOSE = 0.03
"""Gap between discs at most where none was asked for, over the side of a mark's share of the
container. Larger wastes room, smaller is not seen as a gap: some 200 marks keep the usual one.
Chosen by eye."""


TIGHT = 1.3
"""How much wider all marks could be without the fullest part of a map that it is told. Chosen."""

EDGE = 0.006
"""Free edge about a map, over its longer side: lines along its borders are not cut. Chosen."""


@final
@dataclass(frozen=True, eq=False)
class ChartUse(Use):
    """Marks of a chart."""

    chart: Chart

    # The palette gives marks their colours by data.
    has_nearest = False

    def steps(self, job: Job) -> Sequence[RunStep]:
        """As icons, or groups one after another; discs closer together where there are so many."""
        gap = close_gap(job, CLOSE, self.chart.least_share)
        jams = jams_discs(job) and not self.chart.has_bars
        if len(job.items) > MOST_MARKS and not jams:
            raise RecipeError(
                "unit",
                f"there are {len(job.items):,} marks; more than {MOST_MARKS:,} have to be circles "
                "without bars, rules, forces, levels or an earlier layout: leave these out, or use "
                "a larger unit",
            )
        if gap >= job.plan.gap or not (jams or self.chart.regions):
            return self._listed(job)
        return [Replan(gap=gap), *self._listed(job.replanned(gap=gap)), RemarkGap("marks")]

    def _listed(self, job: Job) -> list[RunStep]:
        if self.chart.cells:
            check_groups(job, self.chart)
            return [FillGroups(self.chart), *self.report(job)]
        placed = jamming(job) or placing(job, suits_first_fit=fits_first(job))
        return [*placed, *filling(job), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures, colours by data, titles, keys and labels.

        A container that is there repeatedly is not to be told by its shape.
        """
        shows_shape = not self.chart.cells
        return [*reporting(job, is_dressed=True, shows_shape=shows_shape), Annotate()]

    @property
    def stated(self) -> Mapping[str, Any]:
        """Groups by their names, and numbers of parts of the container that follow each other."""
        cells = self.chart.cells
        if not cells:
            return {}
        parts = [len(polygon_parts(cell.room.region)) for cell in cells]
        return {"groups": [cell.name for cell in cells], "group_parts": parts}

    def subset(self, kept: IntArray) -> ChartUse:
        """The same of some of the marks."""
        return ChartUse(self.chart.subset(kept))

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours that stand for data; None if marks keep their own."""
        del job, layout
        colours = self.chart.colours.marks
        return list(colours) if any(colours) else None

    def remedy(self, job: Job) -> str:
        """Another container, if so many marks would show a plain one; else more marks."""
        if items_needed(job.container).count > len(job.items) >= LEAST:
            return "a container without thin parts, such as circle, would show"
        return "more marks, of more rows or of a smaller --unit, would show more of it"


@final
class Annotate(RunStep):
    """Labels on marks, title, names of groups and legend."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State whose layout has these notes."""
        use, (layout, _) = state.job.use.inner, state.measured
        assert isinstance(use, ChartUse)  # noqa: S101 - it is on lists of charts alone
        legend = legend_notes(use.chart, layout)
        notes = (*mark_labels(use.chart, layout), *legend)
        return replace(state, layout=replace(layout, notes=notes))


@final
class FillGroups(RunStep):
    """All groups of a chart, one after another, then at one scale."""

    share = 1.0

    def __init__(self, chart: Chart) -> None:
        self._chart = chart

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of the marks that have a place."""
        job, chart = state.job, self._chart
        recorder = Recorder() if state.job.is_recorded else None
        context = context.heard_by(recorder)
        if chart.single is None:
            with job.clock.time("finish"):
                done = fill_bars(job, chart, context)
        else:
            done = fill_copies(job, chart, chart.single, context)
        kept, total = done.kept, len(job.items)
        if chart.regions and done.larger >= TIGHT:
            fullest = chart.cells[done.fullest].name
            state = state.with_finding(Sentence.FULLEST_PART, part=fullest, factor=done.larger)
        if len(kept) < total:
            state = state.with_finding(Sentence.MARKS_LEFT, placed=len(kept), count=total)
        return replace(
            state,
            job=replace(job.subset(kept), container=done.container),
            poses=done.poses.subset(kept),
            method=done.method,
            ending=Ending.STOPPED if context.stop() else Ending.DONE,
            levels=tuple(done.levels),
            numbers=kept,
            recorder=recorder,
            limits=Limits.free(len(kept)),
            unplaced=done.unplaced,
            left_out=total - len(kept),
        )


def check_groups(job: Job, chart: Chart) -> None:
    """Refuse what groups cannot keep."""
    if job.earlier is not None:
        raise RecipeError("start", "groups of --by begin anew; leave the layout out")
    if job.plan.forces:
        raise RecipeError("force", "groups of --by have their own; leave it out")
    if chart.has_bars and job.plan.losses:
        raise RecipeError("losses", "bars are heaps, which are made by no losses; leave them out")
    if chart.has_bars and not job.plan.is_exact:
        raise RecipeError("finish", "bars are settled in exact geometry; use exact")
    if job.plan.voids.fills:
        raise RecipeError("filler", "has no meaning in groups of --by; leave it out")
    for one in job.asked:
        one.refuse(("pin", "region"), "groups of --by")


def read_marks(recipe: Recipe, asked: ChartOptions, room: Container | None) -> Material:
    """Marks of a recipe's chart, in a container or, without one, in bars."""
    if recipe.stroke_width == "even":
        raise RecipeError(
            "stroke_width", "even changes the areas of marks, which stand for numbers; leave it out"
        )
    has_names = isinstance(recipe.palette, Mapping)
    read = read_chart(asked, recipe.holes, recipe, recipe.read_options, has_names=has_names)
    regions = list[NamedRegion]()
    if asked.in_regions:
        if room is None:
            raise RecipeError("in_regions", "needs a container with named parts, not none")
        room = with_margin(room, (EDGE * room.side,) * 4)
        read, regions = in_regions(read, room)
    # Refuses too few colours before anything is run.
    colours = chart_colours(recipe, read)
    chosen = cast_chart(recipe, read)
    chart, container = spread_out(recipe, read, colours, room, regions)
    return Material(
        use=ChartUse(chart),
        container=container,
        cast=chosen,
        fillers=(),
        skipped=read.told,
    )


def cast_chart(recipe: Recipe, chart: ChartRead) -> Cast:
    """Marks of a chart, each once, as large as its data say."""
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
