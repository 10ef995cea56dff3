"""Number of items at which a container's shape shows."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from packwork.errors import RecipeError
from packwork.fields.thickness import Thickness, thickness
from packwork.metrics.shape import REACH
from packwork.raster.membership import centre_count
from packwork.recipe import Sizes
from packwork.scene.container import Container

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

SLIM, LIMB = 1.5, 0.1
"""Width of parts that show as one column of items, over that which the count goes by, and share of
the container from which there are so many of them that it needs more. Larger shares leave the neck
of a guitar ragged, smaller ones fill hearts with crumbs. By eye, of the bundled containers."""

COLUMNS, CLEAR = 2, 100
"""How many times as many items then, up to so many in all: of these a column shows clearly enough.
By eye: the same."""

LEAST, MOST = 20, 1_000
"""Fewest items that look like a fill, and most that are chosen without being asked: as many as
voids are filled with. Chosen."""


@dataclass(frozen=True)
class Needed:
    """Number of items that a container takes.

    Parameters
    ----------
    width_cu
        Of the thinnest parts that they reach, canvas units.
    """

    count: int
    width_cu: float


def items_needed(
    container: Container, sizes: Sizes = "free", size_ratio: float = TYPICAL_RATIO
) -> Needed:
    """Items of one nominal size for which the container's shape shows.

    Examples
    --------
    >>> from packwork.readers.container import read_container
    >>> cat, heart = (items_needed(read_container(name)) for name in ("cat", "heart"))
    >>> cat.count > 3 * heart.count
    True
    """
    thick = _told(container)[1]
    radius_px = thick.radius_for(MOST_MISSING)
    radius = radius_px / _px_per_cu(container)
    ratio = size_ratio if sizes == "free" else 1.0
    discs = container.outline.area / (np.pi * radius**2)
    count = CROWD * discs * TYPICAL_RATIO / min(ratio, 2 * TYPICAL_RATIO)
    if thick.missing_for(SLIM * radius_px) >= LIMB:
        count = max(count, min(COLUMNS * count, CLEAR))
    return Needed(int(np.clip(np.ceil(count), LEAST, MOST)), 2 * radius)


def no_container() -> RecipeError:
    """Error of a number that only a container could tell."""
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
