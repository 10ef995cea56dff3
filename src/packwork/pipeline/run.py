"""One run: read, begin, solve, dress, measure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from shapely.errors import GEOSException

from packwork.arrays import IntArray
from packwork.errors import ReadError, UnresolvedError
from packwork.piles import PileOptions
from packwork.pipeline.beginning import new_items
from packwork.pipeline.gaps import fill_gaps
from packwork.pipeline.grouping import run_groups
from packwork.pipeline.job import Job, read
from packwork.pipeline.judging import Judged, judged
from packwork.pipeline.leaving import left_behind
from packwork.pipeline.onward import BEFORE_VOIDS, onward, stretch
from packwork.pipeline.outcome import Filling, Run
from packwork.pipeline.packing import placed_readably
from packwork.pipeline.piling import run_pile
from packwork.pipeline.recording import Recorder
from packwork.pipeline.shortfall import shortfalls
from packwork.progress import Observer, Stop, never, together
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.leaving import grown_in


def fill(
    recipe: Recipe,
    items: Sequence[Item] | None = None,
    container: Container | None = None,
    observer: Observer | None = None,
    stop: Stop = never,
    record: bool = False,
) -> Run:
    """Fill a container with items.

    Parameters
    ----------
    recipe
        What to do.
    items, container
        Already read, in place of the recipe's names of files.
    observer
        Told of progress.
    stop
        Asked before every epoch; True ends the run with what it has.
    record
        Keep the way of the items, in the layout's ``track``.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning for these files.
    """
    return run(read(recipe, items, container), observer, stop, record)


def run(
    job: Job, observer: Observer | None = None, stop: Stop = never, record: bool = False
) -> Run:
    """Solve and measure what was read; the second half of :func:`fill`.

    Raises
    ------
    ReadError
        Naming the container, if outlines lie too close for any set operation.
    """
    try:
        return _run(job, onward(observer), stop, record)
    except (UnresolvedError, GEOSException) as error:
        why = error if isinstance(error, UnresolvedError) else f"cannot be resolved: {error}"
        raise ReadError(job.container.source, str(why)) from error


def _run(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Run:
    if job.recipe.pile is not None:
        return _heaped(job, job.recipe.pile, observer, stop, record)
    if job.cells is not None:
        return _grouped(job, observer, stop, record)
    placed = placed_readably(job, observer, stop, record)
    job, exact, recorder = placed.job, placed.exact, placed.recorder
    start, poses = placed.start, placed.poses
    ids: IntArray | None = None
    filling: Filling | None = None
    if exact is not None and job.recipe.fills_gaps:
        rest = stretch(observer, BEFORE_VOIDS, 1.0)
        with job.clock.time("gaps"):
            filled = fill_gaps(job, start, exact, together(rest, recorder), stop)
        job, start, exact = filled.job, filled.start, filled.exact
        poses, filling, ids = exact.poses, filled.filling, filled.ids
    unplaced = None if exact is None else ()
    faults = () if exact is None else shortfalls(job, start.nominal, exact)
    found = Judged(
        poses, start.method, start.limits, placed.outcome, unplaced, filling, faults=faults
    )
    return _with_track(judged(job, found), recorder, ids, placed.job)


def _heaped(
    job: Job, asked: PileOptions, observer: Observer | None, stop: Stop, record: bool
) -> Run:
    """A pile, and the way of those that found room."""
    recorder = Recorder() if record else None
    done = run_pile(job, asked, together(observer, recorder), stop)
    left = [one.index for one in done.unplaced]
    ids = np.setdiff1d(np.arange(len(job.items)), left)
    return _with_track(replace(done, kept=None), recorder, ids, job)


def _grouped(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Run:
    """Groups of a chart, and the way of their marks."""
    recorder = Recorder() if record else None
    done, ids = run_groups(job, together(observer, recorder), stop)
    return _with_track(done, recorder, ids, job)


def _with_track(done: Run, recorder: Recorder | None, ids: IntArray | None, job: Job) -> Run:
    """The run with the way of its items, which ``ids`` number as ``job`` does."""
    if recorder is None:
        return done
    layout = done.layout
    if done.kept is not None:
        ids = done.kept if ids is None else ids[done.kept]
    track = recorder.track(layout.poses, ids, layout.items)
    called = np.arange(len(layout.items)) if ids is None else ids
    if job.recipe.stay:
        track = grown_in(track, np.flatnonzero(np.isin(called, new_items(job))))
    placed = called[called < len(job.items)]
    return replace(done, layout=replace(layout, track=track, leaving=left_behind(job, placed)))
