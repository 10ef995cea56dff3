"""One run: a job along the road, or where its use leads it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely.errors import GEOSException

from packwork.arrays import IntArray
from packwork.errors import ReadError, UnresolvedError
from packwork.pipeline.earlier import new_items
from packwork.pipeline.film.leaving import left_behind
from packwork.pipeline.film.recorder import Recorder
from packwork.pipeline.gaps import fill_gaps
from packwork.pipeline.job import Job
from packwork.pipeline.measure import Unmeasured, measured
from packwork.pipeline.placed import Placed
from packwork.pipeline.placing import placed_as_asked
from packwork.pipeline.progress import BEFORE_VOIDS, onward, stretch
from packwork.pipeline.result import Run
from packwork.pipeline.shortfalls import shortfalls
from packwork.progress import Observer, Stop, never, together
from packwork.scene.leaving import grown_in


def run(
    job: Job, observer: Observer | None = None, stop: Stop = never, record: bool = False
) -> Run:
    """Solve and measure what was read.

    Parameters
    ----------
    observer
        Told of progress.
    stop
        Asked before every epoch; True ends the run with what it has.
    record
        Keep the way of the items, in the layout's ``track``.

    Raises
    ------
    ReadError
        Naming the container, if outlines lie too close for any set operation.
    RecipeError
        If an option has no meaning for these files.
    """
    try:
        return job.use.run(job, onward(observer), stop, record)
    except (UnresolvedError, GEOSException) as error:
        why = error if isinstance(error, UnresolvedError) else f"cannot be resolved: {error}"
        raise ReadError(job.container.source, str(why)) from error


def run_along(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Run:
    """The common road: start, levels, exact finish, voids, measuring."""
    placed = placed_and_filled(job, observer, stop, record)
    done = measured(placed.job, unmeasured(placed))
    return with_track(done, placed.recorder, placed.numbers, placed.asked_for)


def placed_and_filled(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """Items in their places, and copies in the voids between them if that was asked."""
    placed = placed_as_asked(job, observer, stop, record)
    if placed.exact is None or job.plan.voids is None:
        return placed
    rest = together(stretch(observer, BEFORE_VOIDS, 1.0), placed.recorder)
    with job.clock.time("gaps"):
        return fill_gaps(placed, placed.exact, rest, stop)


def unmeasured(placed: Placed) -> Unmeasured:
    """What was placed, to be measured and compared with what was asked."""
    exact = placed.exact
    return Unmeasured(
        placed.poses,
        placed.start.method,
        placed.start.limits,
        placed.outcome,
        None if exact is None else (),
        placed.filling,
        faults=() if exact is None else shortfalls(placed.job, placed.start.nominal, exact),
    )


def with_track(done: Run, recorder: Recorder | None, ids: IntArray | None, job: Job) -> Run:
    """The run with the way of its items, which ``ids`` number as ``job`` does."""
    if recorder is None:
        return done
    layout = done.layout
    if done.kept is not None:
        ids = done.kept if ids is None else ids[done.kept]
    track = recorder.track(layout.poses, ids, layout.items)
    called = np.arange(len(layout.items)) if ids is None else ids
    if job.plan.stays:
        track = grown_in(track, np.flatnonzero(np.isin(called, new_items(job))))
    placed = called[called < len(job.items)]
    return replace(done, layout=replace(layout, track=track, leaving=left_behind(job, placed)))
