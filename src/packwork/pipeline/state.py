"""State of a run, items by number, their poses, what was found; and the role of its steps."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Conflict
from packwork.forces.forces import Forces
from packwork.metrics.certificate import Promise
from packwork.metrics.measure import LayoutMetrics
from packwork.pipeline.findings import Filling, Finding, Sentence, Unplaced, WordsFound
from packwork.pipeline.job import Job
from packwork.pipeline.recorder import Recorder
from packwork.progress import NOBODY, Observer, Stage, Step, Stop, never, together
from packwork.scene.layout import Layout
from packwork.scene.pose import Limits, Poses
from packwork.solve.solver import Ending, LevelReport


@dataclass(frozen=True, eq=False, kw_only=True)
class RunState:
    """State of a run, which each step takes and gives.

    Parameters
    ----------
    job
        Its items are those that are placed.
    asked_for
        The job of those that were asked for: without what was put into voids.
    nominal
        ``(n,)`` scales that weights ask for.
    forces
        What pulls items about, with what makes room for the heavy.
    numbers
        ``(n,)`` what items are called by in progress and in ``unplaced``.
    is_tight
        Whether nothing overlaps, and the levels have nothing to add.
    is_warm_start
        Whether items keep their order, as those of an earlier layout that is no mere heap do.
    is_only_refined
        Whether nothing meets in exact geometry, gap included, but for pixels that are only grazed:
        the finish only refines.
    conflicts, undersized
        What the exact finish could not resolve, and items below the least size they may have.
    small
        Items a little smaller than free sizes go, if any are.
    has_thinner_lines
        Whether lines of drawings were made thinner, so areas are in shares no more.
    unplaced, left_out
        Items without a place, and how many of them are no longer among the job's.
    findings
        What is told: of what was asked and does not hold, of what is poor and what would do, of
        what the run chose by itself.
    placed, kept
        Number of items that were placed, and ``(n,)`` which of them are in the layout.
    layout, metrics, promise
        What is written, what it is worth and what was promised; None before it is measured.
    beside
        Pairs of one kind that lie side by side; None if they may.
    words
        How many words the source holds; None for no words.
    recorder
        Keeps the way of the items; None where it is not recorded.
    """

    job: Job
    asked_for: Job
    poses: Poses
    nominal: FloatArray
    limits: Limits
    forces: Forces
    numbers: IntArray
    method: str = ""
    is_tight: bool = False
    is_warm_start: bool = False
    is_only_refined: bool = False
    ending: Ending = Ending.DONE
    levels: tuple[LevelReport, ...] = ()
    conflicts: tuple[Conflict, ...] = ()
    undersized: tuple[int, ...] = ()
    small: Finding | None = None
    has_thinner_lines: bool = False
    filling: Filling | None = None
    unplaced: tuple[Unplaced, ...] = ()
    left_out: int = 0
    findings: tuple[Finding, ...] = ()
    pile: Mapping[str, Any] = field(default_factory=dict)
    placed: int = 0
    kept: IntArray = field(default_factory=lambda: np.arange(0))
    layout: Layout | None = None
    metrics: LayoutMetrics | None = None
    promise: Promise = field(default_factory=Promise)
    certified: bool = False
    beside: int | None = None
    words: WordsFound | None = None
    recorder: Recorder | None = None

    @classmethod
    def of(cls, job: Job) -> RunState:
        """Before the first step: no item has a place or a size yet."""
        count = len(job.items)
        nowhere = np.zeros(count)
        return cls(
            job=job,
            asked_for=job,
            poses=Poses(nowhere, nowhere, nowhere, nowhere),
            nominal=nowhere,
            limits=Limits.free(count),
            forces=job.forces.buoyant(job.weights),
            numbers=np.arange(count),
        )

    def with_finding(self, sentence: Sentence, **values: object) -> RunState:
        """The same with one more finding."""
        return replace(self, findings=(*self.findings, Finding(sentence, values)))

    @property
    def is_clean(self) -> bool:
        """Whether the exact finish has left nothing that meets or sticks out."""
        return self.job.plan.is_exact and not self.conflicts

    @property
    def largest(self) -> FloatArray:
        """``(n,)`` scales that no item may exceed."""
        limits, nominal, poses = self.limits, self.nominal, self.poses
        if limits.binds and len(limits.largest) == len(poses):
            return limits.largest
        if self.job.plan.sizes == "free" and len(nominal) == len(poses):
            return nominal * self.job.plan.size_ratio
        return poses.scale

    @property
    def measured(self) -> tuple[Layout, LayoutMetrics]:
        """Layout and metrics of a state that has been measured."""
        assert self.layout is not None and self.metrics is not None  # noqa: S101, PT018
        return self.layout, self.metrics


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
