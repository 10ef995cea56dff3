"""Role of a use: the list of steps of its runs, and what steps have to know of its items."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.recipe import Recipe
from packwork.recipe.arrangement import unknown_measure

if TYPE_CHECKING:
    from packwork.pipeline.job import Job
    from packwork.pipeline.step import RunStep
    from packwork.scene.item import Item
    from packwork.scene.layout import Layout


class Use(ABC):
    """Use of the program: its way with a job, and what it has besides items and weights."""

    palette_tints: bool = True
    """Whether drawings of several colours take on shades of the palette's."""

    has_nearest: bool = True
    """Whether drawings of several colours may take on the palette's nearest colours."""

    goes_on: bool = False
    """Whether a run that begins from an earlier layout tells its items by their names."""

    @abstractmethod
    def steps(self, job: Job) -> Sequence[RunStep]:
        """All steps of a run, in their order.

        Raises
        ------
        RecipeError
            If an option has no meaning for this job.
        """

    @abstractmethod
    def report(self, job: Job) -> Sequence[RunStep]:
        """The last of them: what measures, dresses and describes items in their places."""

    @property
    def inner(self) -> Use:
        """The use that read the items: itself, but for a pile of what another one read."""
        return self

    @property
    def words(self) -> Sequence[Item]:
        """Those of the items that are read as words."""
        return ()

    def subset(self, kept: IntArray) -> Use:
        """The same of some of the items, by their indices ``(m,)``."""
        del kept
        return self

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

    def remedy(self, job: Job) -> str | None:
        """Remedy for a shape that does not show, in words of the options; None if as for icons."""
        del job
        return None

    def vectors(self, recipe: Recipe) -> ItemVectors:
        """Vectors that say which items are alike, made by the use itself."""
        del recipe
        raise RecipeError("embeddings", "auto is of words of a text; give a file of vectors")

    def redrawn(self, job: Job, gone: Sequence[Item]) -> tuple[Item, ...]:
        """Drawings of items of an earlier layout that are no more, as this run would have them."""
        del job, gone
        return ()
