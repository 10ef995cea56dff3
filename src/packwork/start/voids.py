"""Voids between the items of a layout, and copies that fit into them.

Voids are maxima of a distance transform (largest empty circles); what is free in each direction
is found by sphere tracing (J. Hart, "Sphere tracing: a geometric method for the antialiased ray
tracing of implicit surfaces", The Visual Computer 12 (1996), 527-545, doi:10.1007/s003710050084).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.fields.distance_transform import distance_inside
from packwork.geometry.outline import Outline, joined
from packwork.raster.coverage import image_shape
from packwork.raster.membership import centre_count
from packwork.scene.container import Container
from packwork.scene.pose import Poses

RESOLUTION = 1_600
"""Pixels on the longer side of the image in which voids are found. More find smaller ones
and take longer. Tried."""

BLUR_PX = 0.7
"""How far an edge may be from where the image shows it, pixels: half a pixel's diagonal."""

NEAREST_PX = 5
"""Side of the neighbourhood in which one void's centre is looked for. Smaller looks at the
same void twice. Chosen."""

OFFERED = 2
"""Voids that are looked at for each copy asked for: many hold none, or share it. Chosen."""

MOST_STEPS = 48
"""Steps along a ray at most; what is farther than that counts as not free. Chosen."""

NEARLY_BEST = 0.95
"""Share of the largest area that any item would cover in a void from which an item may be
chosen for it. Larger fills a little better with less variety. Chosen."""

CROWDING = 0.9
"""Distance between two copies put in at one time, shares of the sum of their radii as discs,
so that they do not meet in one void. Chosen."""


@dataclass(frozen=True, eq=False)
class Fillers:
    """Copies for voids.

    ``sort``: ``(m,)`` which of the outlines that were offered.
    ``poses``: where they fit, nearly: the voids are seen in an image.
    """

    sort: IntArray
    poses: Poses


def copies_for_voids(
    container: Container,
    placed: Sequence[Outline],
    sorts: Sequence[Outline],
    turns: BoolArray,
    *,
    most: int,
    smallest: FloatArray,
    largest: FloatArray,
    gap: float,
    rng: np.random.Generator,
) -> Fillers:
    """Copies that fit into the voids of a layout, in the largest first.

    ``placed``: what lies in it, canvas units.
    ``sorts``: outlines that copies may have, item units, origin at their centroids.
    ``turns``: ``(SECTORS,)`` which turns they may have, in steps of a sector.
    ``smallest``, ``largest``: ``(k,)`` scales of each sort.
    ``gap``: what is to stay free round each copy, canvas units.

    Examples
    --------
    >>> from packwork.geometry.affine import similarity
    >>> unit = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> box = Container("box", "", unit.mapped(similarity(50, 50, 0.0, 50)), 100, 100)
    >>> wall = unit.mapped(similarity(30, 50, 0.0, 20))
    >>> found = copies_for_voids(
    ...     box, [wall], [unit], np.ones(SECTORS, dtype=bool), most=1,
    ...     smallest=np.ones(1), largest=np.full(1, 99.0), gap=1.0, rng=np.random.default_rng(0),
    ... )
    >>> bool(found.poses.x[0] > 60), bool(18 < found.poses.scale[0] < 25)
    (True, True)
    """
    px_per_cu = RESOLUTION / container.side
    distance = distance_inside(_free_pixels(container, placed, px_per_cu))
    centres = void_centres(distance, OFFERED * most)
    rays = free_rays(distance, centres)
    middles = _mid_chord(centres, rays)
    centres = np.concatenate([centres, middles])
    rays = np.concatenate([rays, free_rays(distance, middles)])
    rays = (rays - BLUR_PX) / px_per_cu - gap
    scales, best_turns = fitted(np.maximum(rays, 0.0), sorts, turns)
    scales = np.minimum(scales, largest)
    areas = np.array([outline.area for outline in sorts])
    worth = np.where(scales >= smallest, scales**2 * areas, 0.0)
    places = np.asarray((centres + 0.5) / px_per_cu, dtype=np.float64)
    voids, chosen = _chosen(worth, places, most, rng)
    x, y = places[voids, 1], places[voids, 0]
    angle = np.asarray(best_turns[voids, chosen] * (2 * np.pi / SECTORS), dtype=np.float64)
    return Fillers(chosen, Poses(x, y, angle, scales[voids, chosen]))


def _free_pixels(container: Container, placed: Sequence[Outline], px_per_cu: float) -> BoolArray:
    shape = image_shape(container.width, container.height, RESOLUTION)
    region, starts = joined([container.outline])
    free = centre_count(region * px_per_cu, starts, shape) > 0
    if placed:
        points, starts = joined(placed)
        free &= centre_count(points * px_per_cu, starts, shape) == 0
    return np.asarray(free)


def _chosen(
    worth: FloatArray, centres: FloatArray, most: int, rng: np.random.Generator
) -> tuple[IntArray, IntArray]:
    """Voids to use and the sort for each; none so near another that both would share a void."""
    best = worth.max(axis=1, initial=0.0)
    voids: list[int] = []
    sorts: list[int] = []
    taken = np.empty((0, 3))
    for void in np.argsort(-best, kind="stable"):
        if best[void] <= 0 or len(voids) == most:
            break
        sort = int(rng.choice(np.flatnonzero(worth[void] >= NEARLY_BEST * best[void])))
        radius = np.sqrt(worth[void, sort] / np.pi)
        apart = np.hypot(taken[:, 0] - centres[void, 0], taken[:, 1] - centres[void, 1])
        if (apart < CROWDING * (taken[:, 2] + radius)).any():
            continue
        taken = np.vstack([taken, [*centres[void], radius]])
        voids.append(int(void))
        sorts.append(sort)
    return np.array(voids, dtype=np.int64), np.array(sorts, dtype=np.int64)


def void_centres(distance: FloatArray, most: int) -> IntArray:
    """``(m, 2)`` row and column of the points farthest from everything, the roomiest first.

    ``distance``: from each free pixel to what is not free, pixels; 0 where it is not.

    Examples
    --------
    >>> mask = np.zeros((9, 20), dtype=bool)
    >>> mask[2:7, 2:7] = mask[3:6, 12:15] = True
    >>> void_centres(distance_inside(mask), 5).tolist()
    [[4, 4], [4, 13]]
    """
    # Takes half a second to load.
    from scipy import ndimage

    peaks = (distance == ndimage.maximum_filter(distance, NEAREST_PX)) & (distance > 0)
    found = np.argwhere(peaks)
    order = np.argsort(-distance[peaks], kind="stable")
    return np.asarray(found[order[:most]])


def free_rays(distance: FloatArray, centres: IntArray) -> FloatArray:
    """``(m, SECTORS)`` pixels from each centre to the first that is not free, by direction.

    Walks as far at a time as nothing can be in the way.

    Examples
    --------
    >>> mask = np.zeros((9, 30), dtype=bool)
    >>> mask[2:7, 2:25] = True
    >>> rays = free_rays(distance_inside(mask), np.array([[4, 10]]))[0]
    >>> bool(14 <= rays[0] <= 15), bool(2 <= rays[SECTORS // 4] <= 3)
    (True, True)
    """
    turns = 2 * np.pi * np.arange(SECTORS) / SECTORS
    across, down = np.cos(turns), np.sin(turns)
    reach = np.zeros((len(centres), SECTORS))
    going = np.ones(reach.shape, dtype=bool)
    height, width = distance.shape
    for _ in range(MOST_STEPS):
        row = np.rint(centres[:, :1] + reach * down).astype(np.int64)
        column = np.rint(centres[:, 1:] + reach * across).astype(np.int64)
        inside = (row >= 0) & (row < height) & (column >= 0) & (column < width)
        room = np.where(inside, distance[row.clip(0, height - 1), column.clip(0, width - 1)], 0.0)
        going &= room > 0
        if not going.any():
            break
        reach += np.where(going, room, 0.0)
    return reach


def _mid_chord(centres: IntArray, rays: FloatArray) -> IntArray:
    """Each centre moved to the middle of the longest chord through it.

    In a corridor all points of the middle line are as far from everything; long items fit
    best half-way along it.
    """
    half = SECTORS // 2
    longest = np.argmax(rays[:, :half] + rays[:, half:], axis=1)
    each = np.arange(len(centres))
    shift = (rays[each, longest] - rays[each, longest + half]) / 2
    angle = 2 * np.pi * longest / SECTORS
    moved = centres + np.column_stack([shift * np.sin(angle), shift * np.cos(angle)])
    return np.asarray(np.rint(moved), dtype=np.int64)


SECTORS = 72
"""Directions in which a void and an item are compared. More fit tighter and take longer, by
the square. Tried."""


def fitted(
    rays: FloatArray, sorts: Sequence[Outline], turns: BoolArray
) -> tuple[FloatArray, IntArray]:
    """Largest scale at which each outline fits into each void, and the turn at which it does.

    As far as :data:`SECTORS` directions tell, with the outline's origin on the void's centre.

    ``rays``: ``(m, SECTORS)``, canvas units.
    ``sorts``: ``k`` outlines, item units.
    ``turns``: ``(SECTORS,)`` which turns, in steps of a sector, are allowed.

    Returns scales ``(m, k)``, and turns in sectors ``(m, k)``.

    Examples
    --------
    >>> bar = Outline.from_rings([np.array([[-4.0, -1], [4, -1], [4, 1], [-4, 1]])])
    >>> upright = np.where(np.abs(np.sin(2 * np.pi * np.arange(SECTORS) / SECTORS)) > 0.9, 9.0, 2.0)
    >>> scales, turn = fitted(upright[None], [bar], np.ones(SECTORS, dtype=bool))
    >>> bool(0.8 < scales[0, 0] < 2.2), int(turn[0, 0]) % (SECTORS // 2) == SECTORS // 4
    (True, True)
    """
    allowed, sector = np.flatnonzero(turns), np.arange(SECTORS)
    scales = np.zeros((len(rays), len(sorts)))
    best = np.zeros(scales.shape, dtype=np.int64)
    for k, outline in enumerate(sorts):
        reach = np.maximum(_profile(outline), 1e-9 * outline.extent)
        turned = 1 / reach[(sector[None, :] - allowed[:, None]) % SECTORS]
        for void, ray in enumerate(rays):
            by_turn = (ray * turned).min(axis=1)
            pick = int(np.argmax(by_turn))
            scales[void, k], best[void, k] = by_turn[pick], allowed[pick]
    return scales, best


def _profile(outline: Outline) -> FloatArray:
    """``(SECTORS,)`` how far an outline reaches from its origin, by direction."""
    points = np.concatenate([_dense(ring) for ring in outline.rings])
    sector = np.rint(np.arctan2(points[:, 1], points[:, 0]) * (SECTORS / (2 * np.pi)))
    reach = np.zeros(SECTORS)
    np.maximum.at(reach, sector.astype(np.int64) % SECTORS, np.hypot(points[:, 0], points[:, 1]))
    return reach


def _dense(ring: FloatArray) -> FloatArray:
    """Points on a closed ring, so near each other that few sectors are left out."""
    closed = shapely.LinearRing(ring)
    spacing = float(np.ptp(ring, axis=0).max()) / SECTORS / 2
    return np.asarray(shapely.get_coordinates(shapely.segmentize(closed, max(spacing, 1e-12))))
