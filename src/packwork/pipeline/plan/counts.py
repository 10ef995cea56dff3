"""Width of a container, and the number of items at which its shape shows."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import shapely

from packwork.errors import RecipeError
from packwork.fields.distance_transform import distance_inside
from packwork.fields.morphology import Thickness, thickness
from packwork.geometry.outline import Outline
from packwork.metrics.pixel import REACH
from packwork.raster.membership import centre_count
from packwork.recipe import Sizes
from packwork.scene.container import Container

THIN = 5e-4
"""Mean half width of a region (area over perimeter), as a share of its extent, below which a
picture tells how wide it is: of hairs and spirals the exact search looks at thousands of places
that are about equally wide. Larger tells plain maps by pixels, smaller takes longer. Measured:
17.6 s of the processor for 5,000 hairs (4e-5), 0.01 s for the coasts of a country (over 0.01)."""

WIDTH_PX = 1_000
"""Pixels on the longer side of that picture. Larger takes longer. Chosen: what is wider than
a pixel is seen, and the exact search is no finer."""

_WIDE = 1.5

LINES = 0.005
"""Mean width of a container, as a share of the canvas's side, below which it is but lines: what
fits is hardly to be seen. Larger blames wrought letters, smaller passes spirals. Chosen."""


def lines_width(container: Container) -> float | None:
    """Mean width of a container that is but lines, canvas units; None of one that is more.

    Examples
    --------
    >>> hair = Outline.from_rings([np.array([[0.0, 0], [90, 0], [90, 0.1], [0, 0.1]])])
    >>> round(lines_width(Container("hair", "", hair, 100.0, 100.0)), 3)
    0.1
    """
    width = 2 * container.outline.area / container.outline.region.length
    return float(width) if width <= LINES * container.side else None


def widest_cu(outline: Outline, tolerance: float = 0.0) -> float:
    """Diameter of the largest disc inside, canvas units, to a thousandth of the extent.

    Parameters
    ----------
    tolerance
        Canvas units that the radius may be off; 0: a thousandth of the extent.

    Examples
    --------
    >>> from packwork.readers.container import read_container
    >>> round(widest_cu(read_container("circle").outline) / 600, 2)
    1.0
    """
    region = outline.region
    mean = region.area / region.length
    if mean >= THIN * outline.extent:
        return 2 * float(shapely.maximum_inscribed_circle(region, tolerance or None).length)
    px = outline.extent / WIDTH_PX
    left, top, right, bottom = outline.bounds
    shape = int((bottom - top) / px) + 2, int((right - left) / px) + 2
    placed = (outline.points - (left, top)) / px + 0.5
    is_inside = centre_count(placed, outline.starts, shape) > 0
    radius = float(distance_inside(np.asarray(is_inside)).max())
    # Hairs that meet the centres of one or two pixels in a row are not as wide as those.
    return 2 * (radius * px if radius >= _WIDE else mean)


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
        return container, Thickness(np.array([0.5]), lambda _: 0.0)
    return container, thickness(mask, REACH * RESOLUTION)


def _px_per_cu(container: Container) -> float:
    return RESOLUTION / container.outline.extent
