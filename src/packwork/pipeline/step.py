"""Role of a step, and the loop that takes a state through a list of them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

from packwork.pipeline.state import RunState
from packwork.pipeline.watch import RunContext


class RunStep(ABC):
    """One step of a run: takes a state, gives a state.

    What was not asked is not on a run's list, so no step asks whether a feature is on.
    """

    share: float = 0.0
    """Part of the progress that it takes, beside those of the other steps of its list."""

    @abstractmethod
    def run(self, state: RunState, watch: RunContext) -> RunState:
        """Next state; items, recipe and plan of the one before stay as they are."""


def share_of(steps: Sequence[RunStep]) -> float:
    """Part of the progress that a list takes."""
    return sum(step.share for step in steps)


def run_steps(steps: Sequence[RunStep], state: RunState, watch: RunContext) -> RunState:
    """State after all steps, one after another; each tells of its part of the progress."""
    whole, done = share_of(steps) or 1.0, 0.0
    for step in steps:
        part = watch.part(done / whole, (done + step.share) / whole) if step.share else watch
        state = step.run(state, part)
        done += step.share
    return state
