"""One run: read, begin, solve, dress, measure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from shapely.errors import GEOSException

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ReadError, UnresolvedError
from packwork.piles import PileOptions
from packwork.pipeline.beginning import new_items
from packwork.pipeline.cropping import (
    DEPTHS,
    Back,
    cropped,
    crops,
    followed,
    lost,
    refilled,
    with_room,
)
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
    if crops(job.recipe):
        return _cropped(job, observer, stop, record)
    solved = _solved(job, observer, stop, record)
    return _with_track(judged(solved.job, solved.found), solved.recorder, solved.ids, solved.first)


@dataclass(frozen=True, eq=False)
class _Solved:
    """Items in their places, voids filled; ``first`` is the job before that.

    ``largest`` are scales that none may exceed.
    """

    job: Job
    found: Judged
    recorder: Recorder | None
    ids: IntArray | None
    first: Job
    largest: FloatArray


def _solved(job: Job, observer: Observer | None, stop: Stop, record: bool) -> _Solved:
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
    if start.limits is not None and len(start.limits.largest) == len(poses):
        largest = start.limits.largest
    elif job.recipe.sizes == "free" and len(start.nominal) == len(poses):
        largest = start.nominal * job.recipe.size_ratio
    else:
        largest = poses.scale
    return _Solved(job, found, recorder, ids, placed.job, largest)


def _cropped(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Run:
    """Items that cover the container's edge, cut at its line; none is lost if that can be."""
    tries = []
    for share in DEPTHS:
        room, depth = with_room(job, share)
        solved = _solved(room, observer and Back(observer, depth), stop, record)
        placed, given = solved.job, len(solved.first.items)
        # Photos were placed at more even sizes than they may have: the rest is for the edge.
        may_grow = solved.found.limits is None
        spare = job.recipe.size_ratio / room.recipe.size_ratio if may_grow else 1.0
        ids = np.arange(len(placed.items)) if solved.ids is None else solved.ids
        found = cropped(job, placed, solved.found.poses, solved.largest * spare, depth)
        tries.append((lost(found, placed, ids, given), solved, found, ids, depth))
        if not tries[-1][0] or stop() or job.recipe.time is not None:
            break
    gone, solved, found, ids, depth = min(tries, key=lambda one: len(one[0]))
    limits, kept = solved.found.limits, found.kept
    if limits is not None and limits.kinds is not None:
        limits = replace(limits, kinds=limits.kinds[kept])
    filling = refilled(solved.found.filling, found, len(solved.first.items), ids)
    done = judged(
        found.job,
        replace(
            solved.found, poses=found.poses, limits=limits, unplaced=gone, filling=filling,
            left_out=len(gone), numbers=ids[kept],
        ),
    )  # fmt: skip
    if solved.recorder is None:
        return done
    which = np.arange(len(kept)) if done.kept is None else done.kept
    whole = found.whole.some(kept[which])
    track = solved.recorder.track(whole, ids[kept[which]], done.layout.items)
    return replace(done, layout=replace(done.layout, track=followed(track, found, which, depth)))


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
