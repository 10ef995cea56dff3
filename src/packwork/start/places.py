"""First places: discs put greedily into the largest room, along the middle line, or at random.

Wang and Lu 2025, section 3.4 (doi:10.1145/3721238.3730690): each item, largest first, at the centre
of the largest empty circle (distance field), or along the medial axis, larger ones where the
container is wider.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import FloatArray, Image, IntArray
from packwork.fields.distance_transform import distance_inside
from packwork.fields.morphology import medial_axis as axis_of
from packwork.fields.voids import Clearance, largest_voids
from packwork.start.allowed_pixels import AllowedPixels
from packwork.start.options import Placing

JITTER = 0.11
"""Random shift of each disc, in its radius: it makes seeds differ and breaks the ties of
symmetric containers. Larger undoes the even spread. Tried."""


def place_discs(
    room: Clearance,
    radii_px: FloatArray,
    rng: np.random.Generator,
    homes: AllowedPixels | None = None,
    preferred: IntArray | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Centres ``(x, y)``, pixels, in the order of the radii.

    ``room``: where there is room; every disc is taken away from it.
    ``radii_px``: ``(n,)``.
    ``homes``: pixels for discs that may not lie anywhere: they choose before the others.
    ``preferred``: pixels ``(m,)`` that the others take as long as their discs fit there.

    Examples
    --------
    >>> room = Clearance(np.ones((10, 30), dtype=bool))
    >>> radii = np.array([2.0, 4.0])
    >>> rng = np.random.default_rng(0)
    >>> x, y = place_discs(room, radii, rng)
    >>> bool(abs(x[0] - x[1]) > 6)
    True
    """
    x, y = np.empty(len(radii_px)), np.empty(len(radii_px))
    bound = [home is not None for home in homes or [None] * len(radii_px)]
    order = np.lexsort((-radii_px, np.logical_not(bound)))
    among = None if homes is None else homes.__getitem__
    radius_of = [float(radius) for radius in radii_px]
    for void in largest_voids(
        room, order, lambda item, _: radius_of[item], among=among, preferred=preferred
    ):
        k = void.item
        shift = min(radius_of[k], max(void.radius, 0.0)) * JITTER * rng.uniform(-1, 1, size=2)
        x[k], y[k] = void.x + shift[0], void.y + shift[1]
    return x, y


FEW, MANY = 20, 100
"""Counts of items up to which, and from which, elbow room does not change. Tried."""

ROOM_OF_FEW, ROOM_OF_MANY = 1.5, 2.0
"""Radius of the disc kept free for an item over that of a disc of its size. Larger puts
the large items further apart, with more small ones between them; few items then leave
their neighbours no place but the edge. Tried."""


def elbow_room(count: int) -> float:
    """Radius to keep free for each of ``count`` items, in radii of a disc of its size.

    Examples
    --------
    >>> elbow_room(5), elbow_room(1_000)
    (1.5, 2.0)
    """
    grown = math.log(min(max(count, FEW), MANY) / FEW) / math.log(MANY / FEW)
    return ROOM_OF_FEW + (ROOM_OF_MANY - ROOM_OF_FEW) * grown


def distance_field(
    container: Image,
    px_per_cu: float,
    radii_cu: FloatArray,
    rng: np.random.Generator,
    homes: AllowedPixels | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Centres ``(x, y)``, canvas units, of discs placed largest first.

    Wang and Lu 2025, section 3.4; the field is updated round each disc only, so that n
    items cost n small windows and not n full transforms. When there is no room left,
    items go where they overlap least.

    ``radii_cu``: ``(n,)`` radius of the disc to keep free for each item.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> x, _ = distance_field(np.ones((20, 60)), 1.0, np.array([4.0, 4.0, 4.0]), rng)
    >>> bool(np.diff(np.sort(x)).min() > 8)
    True
    """
    room = Clearance(container > 0.5)
    x, y = place_discs(room, radii_cu * px_per_cu, rng, homes)
    return x / px_per_cu, y / px_per_cu


AXIS_ELBOW_ROOM = 1.5
"""As for the distance field; closer, as items on a line have two neighbours only. Tried."""


def medial_axis(
    container: Image,
    px_per_cu: float,
    radii_cu: FloatArray,
    rng: np.random.Generator,
    homes: AllowedPixels | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Centres ``(x, y)``, canvas units: along the axis first, beside it when that is full.

    Wang and Lu 2025, section 3.4, put all items on the axis, however short: in a round
    container on one point. Here an item goes to the roomiest pixel of the axis as long
    as its disc fits there (so the largest sit where the container is widest, and none on
    another), and else where there is most room in the container.

    ``container``: coverage of the container, not 0 everywhere.
    ``radii_cu``: ``(n,)`` radius of the disc to keep free for each item.

    Examples
    --------
    >>> rng = np.random.default_rng(0)
    >>> x, y = medial_axis(np.ones((20, 60)), 1.0, np.full(3, 8.0), rng)
    >>> bool(abs(y - 10).max() < 2 and np.diff(np.sort(x)).min() > 14)
    True
    """
    mask = container > 0.5
    room = Clearance(mask)
    axis = np.flatnonzero(axis_of(mask))
    x, y = place_discs(room, radii_cu * px_per_cu, rng, homes, axis)
    return x / px_per_cu, y / px_per_cu


def scatter(
    container: Image,
    px_per_cu: float,
    count: int,
    rng: np.random.Generator,
    homes: AllowedPixels | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Centres ``(x, y)``, canvas units, uniform over the container's pixels.

    Examples
    --------
    >>> x, y = scatter(np.array([[0.0, 1.0]]), 1.0, 3, np.random.default_rng(0))
    >>> bool((x >= 1).all() and (x <= 2).all())
    True
    """
    inside = np.flatnonzero(container > 0.5)
    picks = inside[rng.integers(len(inside), size=count)]
    for k, home in enumerate(homes or ()):
        if home is not None:
            picks[k] = rng.choice(home)
    rows, columns = np.divmod(picks, container.shape[1])
    return (
        (columns + rng.uniform(0, 1, count)) / px_per_cu,
        (rows + rng.uniform(0, 1, count)) / px_per_cu,
    )


NARROW = 1.6
"""Half the container's mean width, in radii of the items' mean disc, below which items
start along its middle line. Larger lines up items that have room side by side. Tried."""


def suitable(container: Image, px_per_cu: float, radii_cu: FloatArray) -> Placing:
    """Choose the medial axis where few items fit side by side, else the distance field.

    ``container``: coverage of the container, not 0 everywhere.
    ``radii_cu``: ``(n,)`` radius of a disc of each item's size.

    Examples
    --------
    >>> suitable(np.ones((10, 90)), 1.0, np.full(9, 4.0))
    'medial-axis'
    >>> suitable(np.ones((10, 90)), 1.0, np.full(99, 1.0))
    'distance-field'
    """
    mask = container > 0.5
    width_px = distance_inside(mask)[axis_of(mask)]
    is_narrow = np.mean(width_px) < NARROW * np.mean(radii_cu) * px_per_cu
    return "medial-axis" if is_narrow else "distance-field"
