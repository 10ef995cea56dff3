"""A run of a job: its steps taken one after another, its progress, its result."""

from __future__ import annotations

from dataclasses import replace

from shapely.errors import GEOSException

from packwork import threads
from packwork.errors import ReadError, UnresolvedError
from packwork.pipeline.job import Job
from packwork.pipeline.result import Run
from packwork.pipeline.state import RunContext, RunState, run_steps
from packwork.progress import NOBODY, Observer, Step, Stop, never

NEARLY = 0.999
"""How far a run is at most before it is measured and done. Chosen."""


class MonotonicProgress:
    """Passes steps of all stages on as those of one run, whose progress never goes back."""

    def __init__(self, observer: Observer) -> None:
        self.every = observer.every
        self._observer, self._most = observer, 0.0

    def on_step(self, step: Step) -> None:
        """Tell of a step, as far on as any before it."""
        self._most = max(self._most, min(step.progress, NEARLY))
        self._observer.on_step(replace(step, progress=self._most))

    def end(self, run: Run) -> None:
        """Tell that the run is over, once, with the poses that its layout has."""
        shares = run.metrics.exact
        is_exact = run.layout.manifest.get("promised") is not None
        self._observer.on_step(
            Step(
                0, 1, 0, 0, 1.0, run.layout.poses,
                lambda: (shares.coverage, shares.overlap, shares.exceeding),
                is_finish=is_exact, is_last=True, ids=run.kept, stage="done",
            )
        )  # fmt: skip


def run(job: Job, observer: Observer = NOBODY, stop: Stop = never, record: bool = False) -> Run:
    """Solve and measure what was read."""
    onward, job = MonotonicProgress(observer), replace(job, is_recorded=record)
    # Runs without levels took no time for them.
    job.clock.seconds.setdefault("levels", 0.0)
    try:
        with threads.using(job.recipe.threads):
            state = run_steps(job.use.steps(job), RunState.of(job), RunContext(onward, stop))
    except (UnresolvedError, GEOSException) as error:
        why = error if isinstance(error, UnresolvedError) else f"cannot be resolved: {error}"
        raise ReadError(job.container.source, str(why)) from error
    done = Run.of(state)
    onward.end(done)
    return done
