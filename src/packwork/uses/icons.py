"""Icons and drawings: the plain use, which adds nothing to the road."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from packwork.pipeline.job import Job
from packwork.pipeline.measure import Unmeasured, measured
from packwork.pipeline.plan.cast import cast
from packwork.pipeline.read import Material, drawn_first, read_named
from packwork.pipeline.result import Run
from packwork.pipeline.run import along
from packwork.pipeline.use import Use
from packwork.pipeline.watch import Watch
from packwork.recipe import Recipe
from packwork.scene.item import Item
from packwork.uses.room import Room


@final
class Icons(Use):
    """Items whose files say all about them."""

    def run(self, job: Job, watch: Watch) -> Run:
        """The common road."""
        return measured(Unmeasured.of(along(job, watch)))


def read_icons(recipe: Recipe, room: Room, given: Sequence[Item] | None) -> Material:
    """Items of a recipe, as often as it says."""
    return material_of(Icons(), recipe, room, given)


def material_of(use: Use, recipe: Recipe, room: Room, given: Sequence[Item] | None) -> Material:
    """Items and photographs that a recipe names, for a use that reads nothing else."""
    named = read_named(recipe, given)
    items = named.items
    if recipe.picture is not None:
        # Only what is asked for loads the picture library.
        from packwork.uses.suited import suited_first

        items = suited_first(recipe, room.known, items)
    if given is None and items is named.items:
        items = drawn_first(recipe, items)
    chosen = cast(recipe, items, room.counted(recipe, items))
    return Material(
        use=use,
        container=room.of(chosen),
        cast=chosen,
        fillers=named.items,
        # Words of a layout come by weight: what a user means by their order is not known.
        given=None if any(item.text is not None for item in given or ()) else named.keys,
        skipped=named.skipped,
    )
