"""Role of a use: the hooks in which icons, words, photographs, charts and piles differ."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.phrasing import number_of
from packwork.pipeline.plan.counts import items_needed
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.recipe import Recipe
from packwork.recipe.arrangement import unknown_measure

if TYPE_CHECKING:
    from packwork.finish.finished import Finished
    from packwork.pipeline.beginning import Beginning
    from packwork.pipeline.job import Job
    from packwork.pipeline.result import Run, Unplaced, WordsFound
    from packwork.pipeline.watch import Watch
    from packwork.progress import Stop
    from packwork.scene.item import Item
    from packwork.scene.layout import Layout
    from packwork.scene.limits import Limits
    from packwork.scene.note import Note
    from packwork.scene.pose import Poses

MOST_FIRST_FIT = 1_500
"""Items at most that are put one after another unless asked: 100 upright icons take 0.7 s of
processor time, 400 take 5 s, 1,000 take 10 s, 1,500 take 14 s. Measured."""

MOST_TURNING = 150
"""The same of items that may turn any way, and are no words: 100 of them take 3 s, 400 take 40 s,
where the levels take 0.6 s and 2.5 s. Measured."""


@dataclass(frozen=True, eq=False)
class OwnPlaces:
    """First places that a use has found by itself, where nothing overlaps.

    Parameters
    ----------
    poses
        Of the job's items.
    limits
        What sizes they may have in the finish.
    """

    poses: Poses
    limits: Limits


class Use(ABC):
    """What one use has besides items and weights, and where it leaves the common road.

    Every hook but ``run`` has an answer that changes nothing.
    """

    @abstractmethod
    def run(self, job: Job, watch: Watch) -> Run:
        """The whole run of a job that was read."""

    @property
    def words(self) -> Sequence[Item]:
        """Those of the items that are read as words."""
        return ()

    def some(self, kept: IntArray) -> Use:
        """The same of some of the items, by their indices ``(m,)``."""
        del kept
        return self

    def suits_first_fit(self, count: int, is_turning: bool) -> bool:
        """Whether putting so many items one after another is better than levels, and fast."""
        return count <= (MOST_TURNING if is_turning else MOST_FIRST_FIT)

    def before(self, job: Job, stop: Stop) -> Job:
        """The job without what could not be placed as asked in any run."""
        del stop
        return job

    @property
    def own_places(self) -> OwnPlaces | None:
        """First places of all items, found before the road; None where the start finds them."""
        return None

    def fewer(self, job: Job, poses: Poses, attempt: int) -> Job:
        """A job to place anew, of fewer items; the job itself if all came out as asked."""
        del poses, attempt
        return job

    def starts(self, job: Job) -> Sequence[Job]:
        """Jobs that differ in their starts, of which the best is gone on with."""
        return [job]

    def bounded(self, job: Job, start: Beginning, exact: Finished, watch: Watch) -> Finished:
        """Exact poses at which sizes are as the use bounds them."""
        del job, start, watch
        return exact

    def filler_scales(
        self, job: Job, exact: Finished, smallest: FloatArray, largest: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Smallest and largest scale of each sort of filler, ``(m,)`` each."""
        del job, exact
        return smallest, largest

    def missing(self, start: int) -> tuple[Unplaced, ...]:
        """What was asked for and is no item, numbered from ``start``."""
        del start
        return ()

    def words_found(self, layout: Layout) -> WordsFound | None:
        """How many words the source holds and how many were to be set; None for no words."""
        del layout
        return None

    def colours(self, job: Job, layout: Layout) -> Sequence[str | None] | None:
        """Colours that data give to items; None if palette and rules give them."""
        del job, layout
        return None

    def column(self, job: Job, name: str) -> FloatArray:
        """``(n,)`` numbers of the items in a column of the data that the use reads.

        Raises
        ------
        RecipeError
            If there is no such column.
        """
        del job
        raise unknown_measure(name)

    @property
    def palette_tints(self) -> bool:
        """Whether drawings of several colours take on shades of the palette's."""
        return True

    @property
    def has_nearest(self) -> bool:
        """Whether drawings of several colours may take on the palette's nearest colours."""
        return True

    def vectors(self, recipe: Recipe) -> ItemVectors:
        """Vectors that say which items are alike, made by the use itself."""
        del recipe
        raise RecipeError("embeddings", "auto is of words of a text; give a file of vectors")

    def notes(self, job: Job, layout: Layout, worn: Layout) -> tuple[Note, ...]:
        """What is drawn beside items and on them: titles, keys, labels; ``worn`` has colours."""
        del job, layout, worn
        return ()

    def remarks(self, job: Job) -> tuple[str, ...]:
        """What the use chose by itself, a sentence each."""
        if not job.is_counted:
            return ()
        width = items_needed(job.container, job.plan.sizes, job.plan.size_ratio).width_cu
        unit = job.container.unit
        chosen = f"auto chose {number_of(len(job.items), 'item')}"
        return (f"{chosen}, to reach into parts {width:.3g} {unit} wide",)

    @property
    def goes_on(self) -> bool:
        """Whether a run that begins from an earlier layout tells its items by their names."""
        return False

    def redrawn(self, job: Job, gone: Sequence[Item]) -> tuple[Item, ...]:
        """Drawings of items of an earlier layout that are no more, as this run would have them."""
        del job, gone
        return ()

    @property
    def shows_shape(self) -> bool:
        """Whether the layout is to show the container's shape."""
        return True

    def remedy(self, job: Job) -> str | None:
        """What would show the shape, in the words of the options; None for what does for icons."""
        del job
        return None
