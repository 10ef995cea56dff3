"""Icons and drawings: the plain use, which adds nothing to the road."""

from __future__ import annotations

from collections.abc import Sequence
from typing import final

from packwork.pipeline.job import Job
from packwork.pipeline.plan.cast import cast
from packwork.pipeline.read import Material, read_named
from packwork.pipeline.result import Run
from packwork.pipeline.run import run_along
from packwork.pipeline.use import Use
from packwork.progress import Observer, Stop
from packwork.recipe import Recipe
from packwork.scene.item import Item
from packwork.uses.room import Room


@final
class Icons(Use):
    """Items whose files say all about them."""

    def run(self, job: Job, observer: Observer | None, stop: Stop, record: bool) -> Run:
        """The common road."""
        return run_along(job, observer, stop, record)


def read_icons(recipe: Recipe, room: Room, given: Sequence[Item] | None) -> Material:
    """Items of a recipe, as often as it says."""
    return material_of(Icons(), recipe, room, given)


def material_of(use: Use, recipe: Recipe, room: Room, given: Sequence[Item] | None) -> Material:
    """Items and photographs that a recipe names, for a use that reads nothing else."""
    named = read_named(recipe, given)
    chosen = cast(recipe, named.items, room.counted(recipe, named.items))
    return Material(
        use=use,
        container=room.of(chosen),
        cast=chosen,
        fillers=named.items,
        skipped=named.skipped,
    )
