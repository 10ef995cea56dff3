"""Steps made of steps: the best of several lists, a second try, a list for what is not tight."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, TypeAlias, final

from packwork.pipeline.state import RunContext, RunState, RunStep, run_steps, share_of

Choice: TypeAlias = Callable[[Sequence[RunState], RunContext], RunState]
"""Takes what came of several lists, gives the best."""


@final
class Replan(RunStep):
    """Other numbers in the plan of the run."""

    def __init__(self, **fields: Any) -> None:
        self._fields = fields

    def run(self, state: RunState, context: RunContext) -> RunState:
        """The same state under the new plan."""
        job = state.job.replanned(**self._fields)
        return replace(state, job=job, asked_for=job)


@final
class BestOf(RunStep):
    """Several lists, each from the same state; the run goes on with the best outcome.

    After a stop no further one is begun.
    """

    def __init__(self, lists: Sequence[Sequence[RunStep]], choice: Choice) -> None:
        self._lists, self._choice = lists, choice
        self.share = share_of(lists[0])

    def run(self, state: RunState, context: RunContext) -> RunState:
        """Run the lists; the best result."""
        tried = [run_steps(steps, state, part) for part, steps in context.turns(self._lists)]
        return self._choice(tried, context)


@final
class Retry(RunStep):
    """A list, and where what came of it will not do, another one from the same state."""

    def __init__(
        self,
        first: Sequence[RunStep],
        again: Sequence[RunStep],
        will_do: Callable[[RunState], bool],
        choice: Choice,
    ) -> None:
        self._first, self._again = first, again
        self._will_do, self._choice = will_do, choice
        self.share = share_of(first)

    def run(self, state: RunState, context: RunContext) -> RunState:
        """Run the first list, and the other if need be; the better result."""
        found = run_steps(self._first, state, context)
        if context.stop() or self._will_do(found):
            return found
        return self._choice([found, run_steps(self._again, state, context)], context)


@final
class UnlessTight(RunStep):
    """Steps for first places that overlap; none where items already lie beside each other."""

    def __init__(self, *steps: RunStep) -> None:
        self._steps = steps
        self.share = share_of(steps)

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State after the steps; as it is where nothing overlaps."""
        return state if state.is_tight else run_steps(self._steps, state, context)
