"""Context of a run: progress of all stages as one, from 0 to 1, and whether to stop."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from packwork.pipeline.recorder import Recorder
from packwork.pipeline.result import Run
from packwork.progress import NOBODY, Observer, Stage, Step, Stop, never, together

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
    records: bool = False

    def part(self, begin: float, end: float, stage: Stage | None = None) -> RunContext:
        """Watch of one stage of several, which goes from ``begin`` to ``end``."""
        return replace(self, observer=_Subrange(self.observer, begin, end, stage))

    def turns(self, tried: Sequence[Tried]) -> Iterator[tuple[RunContext, Tried]]:
        """A part for each of several that are tried in turn; the first alone after a stop."""
        count = len(tried)
        for number, one in enumerate(tried):
            if number and self.stop():
                return
            yield self.part(number / count, (number + 1) / count), one

    def recorder(self) -> Recorder:
        """Recorder of the way that begins now; one that keeps nothing unless that is asked."""
        return Recorder() if self.records else Recorder.off()

    def heard_by(self, recorder: Recorder) -> RunContext:
        """The same, told to a recorder, too."""
        if not recorder.is_on:
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


class _Subrange:
    """Passes steps of a stage on, whose progress is a part of that of another."""

    def __init__(self, observer: Observer, begin: float, end: float, stage: Stage | None) -> None:
        self.every = observer.every
        self._observer, self._begin, self._end, self._stage = observer, begin, end, stage

    def on_step(self, step: Step) -> None:
        """Tell of a step."""
        progress = self._begin + (self._end - self._begin) * min(step.progress, 1.0)
        stage = self._stage or step.stage
        self._observer.on_step(replace(step, progress=progress, stage=stage))
