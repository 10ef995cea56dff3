"""Container of a run, as far as it is known before the items are."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from packwork.pipeline.plan.cast import Cast
from packwork.pipeline.plan.counts import items_needed, no_container
from packwork.pipeline.read import AUTO
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import Item

NO_CONTAINER = "none"
"""Name for no container at all: a pile lies anywhere, a chart's groups are bars."""


@dataclass(frozen=True, eq=False)
class KnownContainer:
    """The container of a run."""

    container: Container | None

    @property
    def known(self) -> Container:
        """The container.

        Raises
        ------
        RecipeError
            If there is none that could tell how many items it takes.
        """
        if self.container is None:
            raise no_container()
        return self.container

    def of(self, cast: Cast) -> Container:
        """Container that these items are placed in."""
        del cast
        return self.known

    def needed(self, recipe: Recipe, items: Sequence[Item]) -> int:
        """Number of items at which the container's shape shows."""
        needed = items_needed(self.known, recipe.sizes, recipe.size_ratio).count
        return max(needed, len(items))

    def counted(self, recipe: Recipe, items: Sequence[Item]) -> int | None:
        """Copies in all where the recipe has the run find that; None where it says."""
        return self.needed(recipe, items) if recipe.count == AUTO else None
