"""Uses of one road: icons, words, photographs, charts, piles and tiles; here runs begin.

Each use reads what it places, and answers the questions of ``pipeline.job.Use`` in which it
differs from the others. What one use alone needs is loaded when it is asked for.
"""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from packwork import threads
from packwork.pipeline.job import Clock, Job
from packwork.pipeline.read import Material, job_of, read_room
from packwork.pipeline.result import Run
from packwork.pipeline.run import run
from packwork.precompile import warm_up_once
from packwork.progress import NOBODY, Observer, Stop, never
from packwork.recipe import Recipe
from packwork.scene.container import Container, tiled
from packwork.scene.item import Item
from packwork.steps.assign_in_order import with_order
from packwork.uses.icons import NO_CONTAINER, IconsUse, KnownContainer, material_of

if TYPE_CHECKING:
    from packwork.uses.charts.recipe import chart_recipe
    from packwork.uses.photos.recipe import photos_recipe
    from packwork.uses.piles.recipe import pile_recipe
    from packwork.uses.words.recipe import words_recipe

__all__ = [
    "chart_recipe",
    "fill",
    "photos_recipe",
    "pile_recipe",
    "read",
    "words_recipe",
]

_HOMES = {
    "chart_recipe": "charts",
    "photos_recipe": "photos",
    "pile_recipe": "piles",
    "words_recipe": "words",
}


def __getattr__(name: str) -> Any:
    """Load how a use's recipe is made when that is first used."""
    if name in _HOMES:
        return getattr(importlib.import_module(f"packwork.uses.{_HOMES[name]}.recipe"), name)
    raise AttributeError(f"module 'packwork.uses' has no attribute {name!r}")


def fill(
    recipe: Recipe,
    items: Sequence[Item] | None = None,
    container: Container | None = None,
    observer: Observer = NOBODY,
    stop: Stop = never,
    record: bool = False,
) -> Run:
    """Fill a container with items.

    Parameters
    ----------
    items, container
        Already read, in place of the recipe's names of files.
    """
    job = read(recipe, items, container)
    with threads.using(recipe.threads):
        warm_up_once()
    return run(job, observer, stop, record)


def read(
    recipe: Recipe, items: Sequence[Item] | None = None, container: Container | None = None
) -> Job:
    """Read what a recipe names; the first half of :func:`fill`."""
    clock = Clock()
    with clock.time("read"), threads.using(recipe.threads):
        job = job_of(recipe, _material(recipe, items, container), clock)
        return job if recipe.arrange is None else with_order(job)


def _material(
    recipe: Recipe, items: Sequence[Item] | None, container: Container | None
) -> Material:
    if recipe.pile is not None:
        from packwork.uses.piles.room import PileRoom
        from packwork.uses.piles.use import Heap, PileUse

        room = PileRoom.of_recipe(recipe, recipe.pile, container)
        material = _content(recipe, room, items)
        heap = Heap(recipe.pile, room.mouths)
        return replace(material, use=PileUse(material.use, heap))
    if recipe.tile is not None:
        from packwork.uses.tiles import TileUse

        tile = tiled(read_room(recipe, container), recipe.tile)
        material = _content(recipe, KnownContainer(tile), items)
        return replace(material, use=TileUse(material.use))
    is_open = container is None and recipe.container == NO_CONTAINER and recipe.chart is not None
    return _content(
        recipe, KnownContainer(None if is_open else read_room(recipe, container)), items
    )


def _content(recipe: Recipe, room: KnownContainer, items: Sequence[Item] | None) -> Material:
    if recipe.chart is not None:
        from packwork.uses.charts.use import read_marks

        return read_marks(recipe, recipe.chart, room.container)
    if recipe.words is not None:
        from packwork.uses.words.use import read_cloud

        return read_cloud(recipe, recipe.words, room, items)
    if recipe.photos is not None:
        from packwork.uses.photos.use import read_collage

        return read_collage(recipe, room, items)
    return material_of(IconsUse(), recipe, room, items)
