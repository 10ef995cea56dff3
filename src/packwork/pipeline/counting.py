"""How many items it takes for a container's shape to show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.fields.thickness import Thickness, thickness
from packwork.geometry.outline import Outline
from packwork.metrics.shape import REACH
from packwork.pipeline.given import given_scales
from packwork.raster.membership import centre_count
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

WORDS_COVER = 0.5
"""Share of a container that words come to cover. Larger takes words for larger than they are,
and finds more of them. Measured: 0.45 to 0.6."""

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


def words_needed(container: Container, outlines: Sequence[Outline], areas: FloatArray) -> Needed:
    """Words, the largest first, of which enough are small enough for all parts.

    For every radius the words that are no larger must cover what larger ones cannot reach
    (Hall's condition, of areas).

    Parameters
    ----------
    outlines, areas
        Of all words that there are, in item units, and their shares of area.
    """
    told = _told(container)[1]
    scales = np.sqrt(areas / np.array([outline.area for outline in outlines]))
    boxes = np.array([np.subtract(o.bounds[2:], o.bounds[:2]).prod() for o in outlines])
    radii = np.sqrt(boxes / np.pi) * scales
    px = np.sqrt(WORDS_COVER * container.outline.area) * _px_per_cu(container)
    wanted = WORDS_COVER * (told.missing - MOST_MISSING)
    for count in range(min(LEAST, len(areas)), len(areas)):
        whole = float(areas[:count].sum())
        order = np.argsort(radii[:count])
        held = np.concatenate([[0.0], np.cumsum(areas[:count][order])]) / whole
        of_size = radii[:count][order] * px / np.sqrt(whole)
        small = held[np.searchsorted(of_size, told.radii_px, side="right")]
        if (small * WORDS_COVER >= wanted).all():
            return Needed(count, 2 * float(of_size[0]) / _px_per_cu(container))
    return Needed(len(areas), 0.0)


def heap_needed(
    container: Container, recipe: Recipe, items: Sequence[Item], weights: FloatArray
) -> Needed:
    """Items of given sizes that heap up about two thirds high."""
    scales = given_scales(recipe, items, weights, container.unit, container.side)
    own = np.array([item.outline.area for item in items]) * scales**2
    count = int(np.clip(HEAP * container.outline.area / own.mean(), 1, MOST))
    return Needed(count, 0.0)


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
        raise RecipeError("count", "auto needs a container to fill; give a number such as 100")
    if recipe.pile is not None:
        needed = heap_needed(container, recipe, items, np.ones(len(items)))
    else:
        needed = items_needed(container, recipe)
    return recipe.model_copy(update={"count": max(needed.count, len(items))})


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
