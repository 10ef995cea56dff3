"""Items of given sizes that forces heap up: icons, or whatever another use reads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

from packwork.arrays import IntArray
from packwork.phrasing import number_of
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunState
from packwork.pipeline.step import RunStep
from packwork.pipeline.use import Use
from packwork.pipeline.watch import RunContext
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.steps.advice import Advise
from packwork.steps.looks import RemarkCount
from packwork.uses.piles.pile import Heap, HeapUp, check_pile


@final
@dataclass(frozen=True, eq=False)
class PileUse(Use):
    """A heap of what another use reads."""

    heap: Heap
    content: Use
    goes_on = True

    def steps(self, job: Job) -> Sequence[RunStep]:
        """Items fall and settle; the content dresses them."""
        check_pile(job)
        return [HeapUp(self.heap), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """As of the content, but for the shape, which a heap does not show."""
        own = [step for step in self.content.report(job) if not isinstance(step, NOT_OF_PILES)]
        return [*own, RemarkPile()] if job.is_counted and not self.words else own

    @property
    def inner(self) -> Use:
        """The use that read the items."""
        return self.content

    @property
    def words(self) -> Sequence[Item]:
        """Words among the items."""
        return self.content.words

    def subset(self, kept: IntArray) -> PileUse:
        """The same of some of the items."""
        return replace(self, content=self.content.subset(kept))

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours that the content's data give."""
        return self.content.colours(job, layout)

    @property
    def palette_tints(self) -> bool:  # type: ignore[override]
        """As the content has it."""
        return self.content.palette_tints

    @property
    def has_nearest(self) -> bool:  # type: ignore[override]
        """As the content has it."""
        return self.content.has_nearest

    def redrawn(self, job: Job, gone: Sequence[Item]) -> tuple[Item, ...]:
        """As the content draws them."""
        return self.content.redrawn(job, gone)


@final
class RemarkPile(RunStep):
    """A sentence about the number of items that the run chose."""

    def run(self, state: RunState, watch: RunContext) -> RunState:
        """State with the remark."""
        said = f"auto chose {number_of(len(state.job.items), 'item')}"
        return replace(state, remarks=(*state.remarks, said))


NOT_OF_PILES = (Advise, RemarkCount)
"""Steps of other uses' reports that speak of filling a container."""
