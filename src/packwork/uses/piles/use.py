"""Items of given sizes that forces heap up: icons, or whatever another use reads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

from packwork.arrays import IntArray
from packwork.phrasing import number_of
from packwork.pipeline.job import Job
from packwork.pipeline.result import Run, Unplaced, WordsFound
from packwork.pipeline.use import Use
from packwork.pipeline.watch import Watch
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.note import Note
from packwork.uses.piles.pile import Heap, run_pile


@final
@dataclass(frozen=True, eq=False)
class Pile(Use):
    """A heap of what another use reads.

    Parameters
    ----------
    heap
        What is asked of it.
    content
        The use that read the items.
    """

    heap: Heap
    content: Use

    def run(self, job: Job, watch: Watch) -> Run:
        """Items fall and settle; there are no levels."""
        return run_pile(job, self.heap, watch)

    @property
    def words(self) -> Sequence[Item]:
        """Words among the items."""
        return self.content.words

    def some(self, kept: IntArray) -> Pile:
        """The same of some of the items."""
        return replace(self, content=self.content.some(kept))

    def missing(self, start: int) -> tuple[Unplaced, ...]:
        """What the content could not draw."""
        return self.content.missing(start)

    def words_found(self, layout: Layout) -> WordsFound | None:
        """How many words the content found."""
        return self.content.words_found(layout)

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours that the content's data give."""
        return self.content.colours(job, layout)

    @property
    def palette_tints(self) -> bool:
        """As the content has it."""
        return self.content.palette_tints

    @property
    def has_nearest(self) -> bool:
        """As the content has it."""
        return self.content.has_nearest

    def notes(self, job: Job, layout: Layout, worn: Layout) -> tuple[Note, ...]:
        """What the content writes."""
        return self.content.notes(job, layout, worn)

    def redrawn(self, job: Job, gone: Sequence[Item]) -> tuple[Item, ...]:
        """As the content draws them."""
        return self.content.redrawn(job, gone)

    @property
    def goes_on(self) -> bool:
        """A pile goes on from an earlier one."""
        return True

    @property
    def shows_shape(self) -> bool:
        """A heap shows no shape."""
        return False

    def remarks(self, job: Job) -> tuple[str, ...]:
        """How many items the run chose."""
        return (f"auto chose {number_of(len(job.items), 'item')}",) if job.is_counted else ()
