"""One run, and the road that uses share: start, levels, exact finish, voids, measuring."""

from __future__ import annotations

from shapely.errors import GEOSException

from packwork import threads
from packwork.errors import ReadError, UnresolvedError
from packwork.pipeline.attempts import Attempts, most_promising
from packwork.pipeline.beginning import begin
from packwork.pipeline.exact import finish_exactly, tell_of_small
from packwork.pipeline.gaps import fill_gaps
from packwork.pipeline.job import Job
from packwork.pipeline.levels import run_levels
from packwork.pipeline.placed import Placed
from packwork.pipeline.result import Run
from packwork.pipeline.seating import seated
from packwork.pipeline.watch import BEFORE_VOIDS, Onward, Watch
from packwork.progress import NOBODY, Observer, Stop, never


def run(job: Job, observer: Observer = NOBODY, stop: Stop = never, record: bool = False) -> Run:
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
        onward = Onward(observer)
        with threads.using(job.recipe.threads):
            done = job.use.run(job, Watch(onward, stop, record))
    except (UnresolvedError, GEOSException) as error:
        why = error if isinstance(error, UnresolvedError) else f"cannot be resolved: {error}"
        raise ReadError(job.container.source, str(why)) from error
    onward.end(done)
    return done


def along(job: Job, watch: Watch) -> Placed:
    """Items in their places: the road that uses share, in the order in which data travels it.

    A use goes on to :func:`packwork.pipeline.measure.measured`. What is tried again, and how one
    of several is chosen, stands in ``pipeline.attempts``.
    """
    attempts = Attempts(job, watch.part(0.0, BEFORE_VOIDS if job.plan.voids.fills else 1.0))
    for attempt in attempts:
        solved = []
        for turn, one in attempt.starts():
            begun = begin(one, turn.stop)
            solved.append(run_levels(begun, turn))
        best = seated(most_promising(solved, watch.stop))
        attempts.take(finish_exactly(best, attempt.finishing, may_fail=attempt.is_spare))
    tell_of_small(attempts.placed.exact)
    return fill_gaps(attempts.placed, watch.part(BEFORE_VOIDS, 1.0, "gaps"))
