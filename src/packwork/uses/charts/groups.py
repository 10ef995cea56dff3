"""A chart in groups: a container each or a bar each, all marks at one scale, one layout."""

from __future__ import annotations

from dataclasses import replace
from typing import final

from packwork.errors import RecipeError
from packwork.pipeline.job import Job
from packwork.pipeline.run import RunContext, RunStep
from packwork.pipeline.state import RunState
from packwork.scene.limits import Limits
from packwork.solve.solver import Ending
from packwork.uses.charts.bars import fill_bars
from packwork.uses.charts.chart import Chart
from packwork.uses.charts.copies import fill_copies


@final
class FillGroups(RunStep):
    """All groups of a chart, one after another, then at one scale."""

    share = 1.0

    def __init__(self, chart: Chart) -> None:
        self._chart = chart

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State of the marks that have a place."""
        job, chart = state.job, self._chart
        recorder = watch.recorder()
        watch = watch.heard_by(recorder)
        if chart.single is None:
            with job.clock.time("finish"):
                done = fill_bars(job, chart, watch)
        else:
            done = fill_copies(job, chart, chart.single, watch)
        kept, total = done.kept, len(job.items)
        faults: tuple[str, ...] = ()
        if len(kept) < total:
            faults = (f"{len(kept)} of {total} marks have a place",)
        return replace(
            state,
            job=replace(job.subset(kept), container=done.container),
            poses=done.poses.subset(kept),
            method=done.method,
            ending=Ending.STOPPED if watch.stop() else Ending.DONE,
            levels=tuple(done.levels),
            numbers=kept,
            recorder=recorder,
            limits=Limits.free(len(kept)),
            unplaced=done.unplaced,
            left_out=total - len(kept),
            faults=faults,
        )


def check_groups(job: Job, chart: Chart) -> None:
    """Refuse what groups cannot keep.

    Raises
    ------
    RecipeError
        If something asked has no meaning for groups.
    """
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
