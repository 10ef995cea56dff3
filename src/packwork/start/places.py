"""First places: discs put greedily into the largest room, along the middle line, or at random.

Wang and Lu 2025, section 3.4 (doi:10.1145/3721238.3730690): each item, largest first, at the centre
of the largest empty circle (distance field), or along the medial axis, larger ones where the
container is wider.

Weighted Voronoi stippling: places that lie closely where a density is high, each with its share.

A. Secord, "Weighted Voronoi stippling", NPAR 2002, 37-43 (doi:10.1145/508530.508537): Lloyd's
method, each point going to the centroid of its Voronoi cell, weighted by the density. Ours begins
with points drawn by that density, counts pixels instead of cutting polygons, and gives the areas.

Single items may begin in the pixels of their zone, or of the line that they lie on.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from packwork.arrays import BoolArray, FloatArray, Image, IntArray
from packwork.fields.distance_transform import distance_inside
from packwork.fields.morphology import medial_axis as axis_of
from packwork.fields.voids import Clearance, largest_voids
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser, region_image
from packwork.scene.pose import Limits, Poses

if TYPE_CHECKING:
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


ROUNDS = 30
"""Rounds of Lloyd's method. Fewer leave cells uneven, more move nothing that is seen. Tried."""


@dataclass(frozen=True, eq=False)
class Stippling:
    """Points and their cells.

    ``x``, ``y``: ``(n,)``, pixels.
    ``areas``: ``(n,)`` of the cells, pixels, none below one.
    """

    x: FloatArray
    y: FloatArray
    areas: FloatArray


def stippled(
    inside: Image, density: Image, count: int, rng: np.random.Generator, rounds: int = ROUNDS
) -> Stippling:
    """Points whose cells are small where the density is high: side of a cell by its fourth root.

    ``inside``: coverage of the region; pixels of which more than half is covered belong to it.
    ``density``: positive weight of each pixel.
    ``count``: number of points, at least 1; where there are more than pixels, several share one.

    Examples
    --------
    >>> density = np.ones((40, 80)); density[:, 40:] = 16.0
    >>> found = stippled(np.ones((40, 80)), density, 60, np.random.default_rng(0))
    >>> left = found.x < 40
    >>> bool(np.median(found.areas[left]) > 2.5 * np.median(found.areas[~left]))
    True
    """
    # The tree is needed for pictures alone.
    from scipy.spatial import cKDTree

    rows, columns = np.nonzero(inside > 0.5)
    pixels = np.column_stack([columns + 0.5, rows + 0.5])
    weights = density[rows, columns].astype(np.float64)
    points = pixels[_drawn(weights, count, rng)] + rng.uniform(-0.25, 0.25, (count, 2))
    for _ in range(rounds):
        cells = cKDTree(points).query(pixels)[1]
        points = _centroids(pixels, weights, cells, points)
    cells = cKDTree(points).query(pixels)[1]
    areas = np.maximum(np.bincount(cells, minlength=count), 1.0)
    return Stippling(points[:, 0], points[:, 1], areas)


def _drawn(weights: FloatArray, count: int, rng: np.random.Generator) -> IntArray:
    """Pixels drawn one from each equal part of the summed weight: spread better than by chance.

    At one place of all parts they would stand in columns where rows hold a whole number of parts.
    """
    sums = np.cumsum(weights)
    at = (np.arange(count) + rng.uniform(size=count)) / count * sums[-1]
    return np.asarray(np.minimum(np.searchsorted(sums, at), len(sums) - 1))


def _centroids(
    pixels: FloatArray, weights: FloatArray, cells: IntArray, points: FloatArray
) -> FloatArray:
    """Weighted centroids of the cells; a point without a cell stays."""
    count = len(points)
    whole = np.bincount(cells, weights, count)
    sums = [np.bincount(cells, weights * pixels[:, k], count) for k in range(2)]
    held = whole > 0
    moved = points.copy()
    moved[held] = np.column_stack(sums)[held] / whole[held, None]
    return moved


AllowedPixels: TypeAlias = Sequence[IntArray | None]
"""Per item the pixels to choose from, ``row * columns + column``; None for any."""


def allowed_pixels(limits: Limits, container: Image, px_per_cu: float) -> AllowedPixels:
    """Pixels of the container for each item that may not lie anywhere in it.

    A line is the row or column of pixels that is nearest to it. Where no pixel shows an
    item's zone, it may begin anywhere.

    ``container``: ``(rows, columns)`` coverage of the container.

    Examples
    --------
    >>> from dataclasses import replace
    >>> limits = replace(Limits.free(2), x=np.array([np.nan, 1.2]))
    >>> [None if h is None else h.tolist() for h in allowed_pixels(limits, np.ones((2, 3)), 1.0)]
    [None, [1, 4]]
    """
    free = container > 0.5
    masks: dict[int, BoolArray] = {}
    for zone in limits.zones:
        inside = free & (_coverage(zone.outline, container, px_per_cu) > 0.5)
        masks |= {int(k): inside for k in zone.items}
    on_column, on_row = limits.held[:, 0], limits.held[:, 1]
    for k in np.flatnonzero(on_column & ~on_row):
        away = np.abs(np.arange(free.shape[1]) + 0.5 - limits.x[k] * px_per_cu)
        masks[int(k)] = _nearest(masks.get(int(k), free), away[None, :])
    for k in np.flatnonzero(on_row & ~on_column):
        away = np.abs(np.arange(free.shape[0]) + 0.5 - limits.y[k] * px_per_cu)
        masks[int(k)] = _nearest(masks.get(int(k), free), away[:, None])
    pixels = {k: np.flatnonzero(mask) for k, mask in masks.items()}
    return [pixels[k] if k in pixels and len(pixels[k]) else None for k in range(len(limits.x))]


def around(
    container: Image, px_per_cu: float, outlines: Sequence[Outline], poses: Poses, items: IntArray
) -> Image:
    """Coverage ``(rows, columns)`` that items ``(m,)`` leave; all of it, should they leave nothing.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> one = np.ones(1)
    >>> around(np.ones((2, 3)), 1.0, [tile], Poses(one, one, 0 * one, one), np.arange(1)).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    """
    left = container
    for k in items:
        left = left * (1 - _coverage(outlines[k].mapped(poses.matrix(int(k))), left, px_per_cu))
    return left if (left > 0.5).any() else container


def _nearest(mask: BoolArray, away: FloatArray) -> BoolArray:
    least = np.where(mask, away, np.inf).min(initial=np.inf)
    return np.asarray(mask & (away <= least))


def _coverage(outline: Outline, like: Image, px_per_cu: float) -> Image:
    return region_image(outline, Rasteriser((like.shape[0], like.shape[1])), px_per_cu)
