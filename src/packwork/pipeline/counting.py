"""How many items it takes for a container's shape to show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from packwork.errors import RecipeError
from packwork.fields.thickness import Thickness, thickness
from packwork.metrics.shape import REACH
from packwork.pipeline.given import given_scales
from packwork.raster.membership import centre_count
from packwork.readers.words.options import WordOptions
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.scene.item import Item

AUTO = "auto"
"""What people write for a number that is found."""

RESOLUTION = 300
"""Pixels on the container's longer side where its thickness is told. Larger is slower and
changes the number of items by a few hundredths. Tried."""

MOST_MISSING = 0.02
"""Share of the container that may stay out of reach: its finest tips. Smaller wants hundreds of
items for a whisker, larger leaves a tail out. Tried."""

CROWD, TYPICAL_RATIO = 1.2, 2.0
"""Items over the discs of the thinnest parts that the container has room for, at a size ratio of
2; at another one in inverse proportion, since smaller items among large ones reach as far. Half
as many just reach a cat's tail, and leave islands empty. Tried."""

LEAST, MOST = 20, 1_000
"""Fewest items that look like a fill, and most that are chosen without being asked: as many as
voids are filled with. Chosen."""

FEWEST_WORDS = 60
"""Words that a cloud has at least: fewer look like a list. Chosen by eye."""

HEAP = 0.4
"""Area of a pile's items over the container's: it stands about two thirds high. Chosen."""


@dataclass(frozen=True)
class Needed:
    """How many items a container takes.

    Parameters
    ----------
    count
        Items in all.
    width_cu
        Of the thinnest parts that they reach, canvas units.
    """

    count: int
    width_cu: float


def items_needed(container: Container, recipe: Recipe) -> Needed:
    """Items of one nominal size for which the container's shape shows.

    Examples
    --------
    >>> from packwork.readers.container import read_container
    >>> from packwork.recipe import make_recipe
    >>> cat, heart = (items_needed(read_container(name), make_recipe(container=name))
    ...     for name in ("cat", "heart"))
    >>> cat.count > 3 * heart.count
    True
    """
    radius = _told(container)[1].radius_for(MOST_MISSING) / _px_per_cu(container)
    ratio = recipe.size_ratio if recipe.sizes == "free" else 1.0
    discs = container.outline.area / (np.pi * radius**2)
    count = CROWD * discs * TYPICAL_RATIO / min(ratio, 2 * TYPICAL_RATIO)
    return Needed(int(np.clip(np.ceil(count), LEAST, MOST)), 2 * radius)


def words_needed(container: Container, recipe: Recipe) -> int:
    """Words for which the container's shape shows."""
    # Words are larger and smaller ones as they come, whether all keep their shares or not.
    as_items = recipe.model_copy(update={"sizes": "free", "size_ratio": TYPICAL_RATIO})
    return max(items_needed(container, as_items).count, FEWEST_WORDS)


def words_counted(recipe: Recipe, asked: WordOptions, container: Container | None) -> WordOptions:
    """Options of a recipe's words, with a number in place of ``auto``."""
    if asked.count != AUTO:
        return asked
    if container is None:
        raise _no_container()
    return asked.model_copy(update={"count": words_needed(container, recipe)})


def heap_needed(container: Container, recipe: Recipe, items: Sequence[Item]) -> int:
    """Items of given sizes that heap up about two thirds high."""
    scales = given_scales(recipe, items, np.ones(len(items)), container.unit, container.side)
    own = np.array([item.outline.area for item in items]) * scales**2
    return int(np.clip(HEAP * container.outline.area / own.mean(), 1, MOST))


def counted(recipe: Recipe, container: Container | None, items: Sequence[Item]) -> Recipe:
    """The recipe with a number of items in place of ``auto``; the same if it has one.

    Raises
    ------
    RecipeError
        If there is no container that could tell.
    """
    if recipe.count != AUTO:
        return recipe
    if container is None:
        raise _no_container()
    if recipe.pile is not None:
        count = heap_needed(container, recipe, items)
    else:
        count = max(items_needed(container, recipe).count, len(items))
    return recipe.model_copy(update={"count": count})


def _no_container() -> RecipeError:
    return RecipeError("count", "auto needs a container to fill; give a number such as 100")


@lru_cache(maxsize=4)
def _told(container: Container) -> tuple[Container, Thickness]:
    left, top, _, _ = container.outline.bounds
    scale = _px_per_cu(container)
    outline = container.outline
    shape = tuple(int(np.ceil(v)) + 2 for v in (outline.points.max(axis=0) - [left, top]) * scale)
    placed = (outline.points - [left, top]) * scale + 1.0
    mask = centre_count(placed, outline.starts, (shape[1], shape[0])) > 0
    if not mask.any():
        return container, Thickness(np.array([0.5]), np.array([0.0]))
    return container, thickness(mask, REACH * RESOLUTION)


def _px_per_cu(container: Container) -> float:
    return RESOLUTION / container.outline.extent
