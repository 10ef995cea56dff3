"""A chart in groups: a container each or a bar each, all marks at one scale, one layout."""

from __future__ import annotations

from dataclasses import replace

from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.pipeline.bars import fill_bars
from packwork.pipeline.job import Job
from packwork.pipeline.judging import Judged, judged
from packwork.pipeline.outcome import Run
from packwork.pipeline.repeating import fill_copies
from packwork.progress import Observer, Stop
from packwork.solve.solver import Ending, Outcome


def run_groups(job: Job, observer: Observer | None, stop: Stop) -> tuple[Run, IntArray]:
    """Fill all groups; the run, and which marks are in it.

    Raises
    ------
    RecipeError
        If what is asked has no meaning for groups.
    """
    assert job.chart is not None  # noqa: S101 - who asks has a chart
    _check(job)
    if job.has_bars:
        with job.clock.time("finish"):
            done = fill_bars(job, observer, stop)
    else:
        done = fill_copies(job, observer, stop)
    kept, total = done.kept, len(job.items)
    smaller = replace(
        job,
        container=done.container,
        items=tuple(job.items[k] for k in kept),
        asked=tuple(job.asked[k] for k in kept),
        weights=job.weights[kept],
        chart=job.chart.some(kept),
    )
    faults: tuple[str, ...] = ()
    if len(kept) < total:
        faults = (f"{len(kept)} of {total} marks have a place",)
    poses = done.poses.some(kept)
    ending = Ending.STOPPED if stop() else Ending.DONE
    found = Judged(
        poses, done.method, None, Outcome(poses, ending), done.unplaced,
        left_out=total - len(kept), faults=faults, numbers=kept,
    )  # fmt: skip
    return judged(smaller, found), kept


def _check(job: Job) -> None:
    """Refuse what groups cannot keep."""
    if job.earlier is not None:
        raise RecipeError("start", "groups of --by begin anew; leave the layout out")
    if job.recipe.force:
        raise RecipeError("force", "groups of --by have their own; leave it out")
    if job.has_bars and job.recipe.finish == "none":
        raise RecipeError("finish", "bars are settled in exact geometry; use exact")
    if job.recipe.fills_gaps:
        raise RecipeError("filler", "has no meaning in groups of --by; leave it out")
    for one in job.asked:
        one.refuse(("pin", "region"), "groups of --by")
