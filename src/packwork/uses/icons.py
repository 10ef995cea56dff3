"""Icons and drawings: the plain use, whose items' files say all about them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from packwork.pipeline.job import Job
from packwork.pipeline.plan.cast import expand_copies
from packwork.pipeline.read import Material, drawn_first, read_named
from packwork.pipeline.step import RunStep
from packwork.pipeline.use import Use
from packwork.recipe import Recipe
from packwork.scene.item import Item
from packwork.steps.starts import fits_first
from packwork.uses.collage import filling, placing, reporting
from packwork.uses.room import KnownContainer


@final
class IconsUse(Use):
    """Items whose files say all about them."""

    def steps(self, job: Job) -> Sequence[RunStep]:
        """Places, levels, finish; voids if asked; measures and looks."""
        placed = placing(job, suits_first_fit=fits_first(job))
        return [*placed, *filling(job), *self.report(job)]

    def report(self, job: Job) -> Sequence[RunStep]:
        """Measures and looks."""
        return reporting(job, is_dressed=False)


def read_icons(recipe: Recipe, room: KnownContainer, given: Sequence[Item] | None) -> Material:
    """Items of a recipe, as often as it says."""
    return material_of(IconsUse(), recipe, room, given)


def material_of(
    use: Use, recipe: Recipe, room: KnownContainer, given: Sequence[Item] | None
) -> Material:
    """Items and photographs that a recipe names, for a use that reads nothing else."""
    named = read_named(recipe, given)
    items = named.items
    if recipe.picture is not None:
        # Only what is asked for loads the picture library.
        from packwork.uses.suited import suited_first

        items = suited_first(recipe, room.known, items)
    if given is None and items is named.items:
        items = drawn_first(recipe, items)
    chosen = expand_copies(recipe, items, room.counted(recipe, items))
    return Material(
        use=use,
        container=room.of(chosen),
        cast=chosen,
        fillers=named.items,
        # Words of a layout come by weight: what a user means by their order is not known.
        given=None if any(item.text is not None for item in given or ()) else named.keys,
        skipped=named.skipped,
    )
