"""A gap narrower than usual, where there are so many items that the usual one wastes room."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import final

from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.recipe import AUTO


def close_gap(job: Job, share: float, each: float | None = None) -> float:
    """Gap, canvas units, no wider than suits so many items, if none was asked for.

    The usual one is a share of the canvas: thousands of items would be specks between gaps.

    Parameters
    ----------
    share
        The widest, over the side of an item's share of the container.
    each
        That share, canvas units squared, where items do not share the whole.
    """
    if job.recipe.padding != AUTO:
        return job.plan.gap
    if each is None:
        each = job.container.outline.area / len(job.items)
    return min(job.plan.gap, share * math.sqrt(each))


@final
@dataclass(frozen=True)
class RemarkGap(RunStep):
    """A sentence about a gap that is narrower than usual, for there are so many items.

    Parameters
    ----------
    what
        What they are called.
    """

    what: str

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the remark."""
        container = state.job.container
        return state.with_finding(
            Sentence.CLOSER,
            what=self.what,
            gap=state.job.plan.gap,
            usual=state.job.recipe.padding_cu(container),
            unit=container.unit,
        )


@final
class RemarkApart(RunStep):
    """A sentence about a gap that was not asked for, between drawings of one colour."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with the remark."""
        job = state.job
        return state.with_finding(Sentence.APART, gap=job.plan.gap, unit=job.container.unit)
