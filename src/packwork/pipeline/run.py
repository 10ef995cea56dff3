"""A run: the role of its steps, what is told and asked on the way, and the loop over one state."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from shapely.errors import GEOSException

from packwork import threads
from packwork.errors import ReadError, UnresolvedError
from packwork.pipeline.job import Job
from packwork.pipeline.recorder import Recorder
from packwork.pipeline.result import Run
from packwork.pipeline.state import RunState
from packwork.progress import NOBODY, Observer, Stage, Step, Stop, never, together


class RunStep(ABC):
    """One step of a run: takes a state, gives a state.

    What was not asked is not on a run's list, so no step asks whether a feature is on.
    """

    share: float = 0.0
    """Part of the progress that it takes, beside those of the other steps of its list."""

    @abstractmethod
    def run(self, state: RunState, context: RunContext) -> RunState:
        """Next state; items, recipe and plan of the one before stay as they are."""


def share_of(steps: Sequence[RunStep]) -> float:
    """Part of the progress that a list takes."""
    return sum(step.share for step in steps)


def run_steps(steps: Sequence[RunStep], state: RunState, context: RunContext) -> RunState:
    """State after all steps, one after another; each tells of its part of the progress."""
    whole, done = sum(step.share for step in steps) or 1.0, 0.0
    for step in steps:
        part = context.part(done / whole, (done + step.share) / whole) if step.share else context
        state = step.run(state, part)
        done += step.share
    return state


LEVELS = 0.4
"""How far a run is when its levels are done, where an exact finish follows. Tried."""

NEARLY = 0.999
"""How far a run is at most before it is measured and done. Chosen."""

Tried = TypeVar("Tried")


@dataclass(frozen=True, eq=False)
class RunContext:
    """Observer and stop of a run, or of a part of it.

    Examples
    --------
    >>> [part.observer.every for part, _ in RunContext().turns("ab")] == [NOBODY.every] * 2
    True
    """

    observer: Observer = NOBODY
    stop: Stop = never

    def part(self, begin: float, end: float, stage: Stage | None = None) -> RunContext:
        """Watch of one stage of several, which goes from ``begin`` to ``end``."""
        return replace(
            self, observer=_Subrange(self.observer, begin, end, stage, self.observer.every)
        )

    def turns(self, tried: Sequence[Tried]) -> Iterator[tuple[RunContext, Tried]]:
        """A part for each of several that are tried in turn; the first alone after a stop."""
        count = len(tried)
        for number, one in enumerate(tried):
            if number and self.stop():
                return
            yield self.part(number / count, (number + 1) / count), one

    def heard_by(self, recorder: Recorder | None) -> RunContext:
        """The same, told to a recorder, too, if there is one."""
        if recorder is None:
            return self
        return replace(self, observer=together(self.observer, recorder))


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


@dataclass(eq=False)
class _Subrange:
    """Passes steps of a stage on, whose progress is a part of that of another."""

    observer: Observer
    begin: float
    end: float
    stage: Stage | None
    every: int

    def on_step(self, step: Step) -> None:
        """Tell of a step."""
        progress = self.begin + (self.end - self.begin) * min(step.progress, 1.0)
        stage = self.stage or step.stage
        self.observer.on_step(replace(step, progress=progress, stage=stage))


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
