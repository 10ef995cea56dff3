"""A chart in groups: a container each or a bar each, all marks at one scale, one layout."""

from __future__ import annotations

from dataclasses import replace

from packwork.errors import RecipeError
from packwork.pipeline.job import Job
from packwork.pipeline.measure import Unmeasured, measured
from packwork.pipeline.result import Run
from packwork.pipeline.watch import Watch
from packwork.scene.limits import Limits
from packwork.solve.solver import Ending, Outcome
from packwork.uses.charts.bars import fill_bars
from packwork.uses.charts.chart import Chart
from packwork.uses.charts.copies import fill_copies


def run_groups(job: Job, chart: Chart, watch: Watch) -> Run:
    """Fill all groups, and the way of their marks.

    Raises
    ------
    RecipeError
        If what is asked has no meaning for groups.
    """
    _check(job, chart)
    recorder = watch.recorder()
    watch = watch.heard_by(recorder)
    if chart.single is None:
        with job.clock.time("finish"):
            done = fill_bars(job, chart, watch)
    else:
        done = fill_copies(job, chart, chart.single, watch)
    kept, total = done.kept, len(job.items)
    smaller = replace(job.some(kept), container=done.container)
    faults: tuple[str, ...] = ()
    if len(kept) < total:
        faults = (f"{len(kept)} of {total} marks have a place",)
    poses = done.poses.some(kept)
    ending = Ending.STOPPED if watch.stop() else Ending.DONE
    return measured(
        Unmeasured(
            job=smaller,
            poses=poses,
            method=done.method,
            outcome=Outcome(poses, ending, done.levels),
            numbers=kept,
            asked_for=job,
            recorder=recorder,
            limits=Limits.free(len(kept)),
            unplaced=done.unplaced,
            left_out=total - len(kept),
            faults=faults,
        )
    )


def _check(job: Job, chart: Chart) -> None:
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
