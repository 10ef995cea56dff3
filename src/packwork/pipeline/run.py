"""One run: the steps of a use over one state, and the result."""

from __future__ import annotations

from shapely.errors import GEOSException

from packwork import threads
from packwork.errors import ReadError, UnresolvedError
from packwork.pipeline.job import Job
from packwork.pipeline.result import Run
from packwork.pipeline.state import RunState
from packwork.pipeline.step import run_steps
from packwork.pipeline.watch import MonotonicProgress, RunContext
from packwork.progress import NOBODY, Observer, Stop, never


def run(job: Job, observer: Observer = NOBODY, stop: Stop = never, record: bool = False) -> Run:
    """Solve and measure what was read.

    Raises
    ------
    ReadError
        Naming the container, if outlines lie too close for any set operation.
    RecipeError
        If an option has no meaning for these files.
    """
    onward = MonotonicProgress(observer)
    # Runs without levels took no time for them.
    job.clock.seconds.setdefault("levels", 0.0)
    try:
        with threads.using(job.recipe.threads):
            state = run_steps(
                job.use.steps(job), RunState.of(job), RunContext(onward, stop, record)
            )
    except (UnresolvedError, GEOSException) as error:
        why = error if isinstance(error, UnresolvedError) else f"cannot be resolved: {error}"
        raise ReadError(job.container.source, str(why)) from error
    done = Run.of(state)
    onward.end(done)
    return done
