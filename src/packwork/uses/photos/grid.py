"""Photographs as tiles of a mosaic on a grid."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from packwork.errors import RecipeError
from packwork.pipeline.job import Job, Use
from packwork.pipeline.plan.copies import expand_copies
from packwork.pipeline.read import Material, read_named
from packwork.pipeline.run import RunStep
from packwork.recipe import Recipe
from packwork.scene.item import Item
from packwork.steps.lay_grid import TILES, LayGrid, hardly_shown
from packwork.uses.collage import reporting
from packwork.uses.icons import KnownContainer

SQUARE = "square"
"""Shape of photos where none is asked for: the largest square in the middle of each."""


@final
class GridUse(Use):
    """Photographs in the cells of a grid."""

    def steps(self, job: Job) -> Sequence[RunStep]:
        """A choice of photos for the cells; measures and looks."""
        recipe, target = job.recipe, job.target
        assert target is not None  # noqa: S101
        most = recipe.count if isinstance(recipe.count, int) else TILES
        return [LayGrid(target, most, recipe.repeats), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks."""
        return reporting(job, is_dressed=False, shows_shape=False, judge=hardly_shown)


def read_grid(recipe: Recipe, room: KnownContainer, given: Sequence[Item] | None) -> Material:
    """Photographs of a recipe, each once, whatever the number of tiles."""
    photos = recipe.photos
    if photos is None:
        raise RecipeError("grid", "is of photos; use packwork photos")
    if photos.edge == "crop":
        raise RecipeError("edge", "crop is of photos that lie freely; leave out --grid")
    if photos.shape is None:
        photos = photos.model_copy(update={"shape": SQUARE})
    named = read_named(recipe.model_copy(update={"photos": photos}), given)
    once = recipe.model_copy(update={"count": None})
    return Material(
        use=GridUse(),
        container=room.known,
        cast=expand_copies(once, named.items),
        fillers=named.items,
        skipped=named.skipped,
    )
