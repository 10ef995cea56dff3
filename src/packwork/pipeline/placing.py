"""Items to their places in one container: start, levels, exact finish."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import numpy as np

from packwork.errors import RecipeError
from packwork.pipeline.dress.line_weights import evened
from packwork.pipeline.exact import finished
from packwork.pipeline.job import Job
from packwork.pipeline.levels import begun_and_solved, buoyant_forces
from packwork.pipeline.placed import Placed
from packwork.pipeline.plan.padding import check_found
from packwork.pipeline.progress import BEFORE_VOIDS, LEVELS, Turn, stretch
from packwork.pipeline.upright import is_as_good, upright_job
from packwork.progress import Observer, Stop, together


def placed_as_asked(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """Poses of all items, before voids are filled.

    Where some come out otherwise than they may be, as words whose letters are too small, fewer
    are placed anew.
    """
    job = job.use.before(job)
    for attempt in count(1):
        placed = _upright_if_as_good(job, observer, stop, record)
        fewer = job if stop() else job.use.fewer(job, placed.poses, attempt)
        if fewer is job:
            break
        job = fewer
    return placed


def _upright_if_as_good(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """Poses of all items; of one by itself, its own pose if it is about as large so."""
    plain = upright_job(job)
    if plain is None:
        return _placed(job, observer, stop, record)
    first, second = (None if observer is None else Turn(observer, k, 2) for k in range(2))
    turned = _placed(job, first, stop, record)
    if stop() or turned.exact is None:
        return turned
    try:
        upright = _placed(plain, second, stop, record)
    except RecipeError:
        return turned
    if upright.exact is None or not is_as_good(upright.exact, turned.exact):
        return turned
    return replace(upright, job=job)


def _placed(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """Poses of all items, whatever their sizes."""
    # What follows the levels takes its share of the way.
    whole = BEFORE_VOIDS if job.plan.voids is not None else 1.0
    until = whole * (LEVELS if job.plan.is_exact else 1.0)
    solved = _best_solved(job, stretch(observer, 0.0, until), stop, record)
    if not job.plan.is_exact:
        return solved
    observer = together(stretch(observer, until, whole), solved.recorder)
    with job.clock.time("finish"):
        # What is to stay where it was is not pushed on.
        forces = None if job.plan.stays else buoyant_forces(job)
        exact = finished(job, solved.start, solved.poses, observer, stop, forces)
        if not (job.plan.stays or stop()):
            check_found(job.container, job.plan.gap, exact)
        thinner = job if stop() else evened(job, exact.poses, tells=False)
        if thinner is not job:
            # Thinner lines leave room to grow into.
            job = thinner
            exact = finished(job, solved.start, exact.poses, observer, stop, forces, grows=True)
        exact = job.use.bounded(job, solved.start, exact, observer, stop, forces)
    return replace(solved, job=job, exact=exact)


def _best_solved(job: Job, observer: Observer | None, stop: Stop, record: bool) -> Placed:
    """The levels' outcome; of several starts, that from which most comes to be covered."""
    tried = job.use.starts(job)
    found: list[Placed] = []
    for number, one in enumerate(tried):
        turn = None if observer is None else Turn(observer, number, len(tried))
        found.append(replace(begun_and_solved(one, turn, stop, record), job=job))
        if len(tried) == 1 or stop():
            return found[0]
    with job.clock.time("finish"):
        worths = [_worth(one, stop) for one in found]
    return found[worths.index(max(worths))]


def _worth(solved: Placed, stop: Stop) -> tuple[bool, float]:
    """Whether a finish without trials comes out clean, and the area that is covered then."""
    job = solved.job
    quick = replace(job, plan=replace(job.plan, effort="draft"))
    exact = finished(quick, solved.start, solved.poses, None, stop, buoyant_forces(job))
    own = np.array([item.outline.area for item in job.items])
    return not exact.conflicts, float(own @ exact.poses.scale**2)
