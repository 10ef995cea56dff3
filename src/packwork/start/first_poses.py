"""First poses of a run: places for items of given sizes and angles, and for buried ones."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from packwork.arrays import FloatArray, Image, IntArray
from packwork.fields.voids import Clearance, largest_voids
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import hull_areas
from packwork.raster.coverage import Rasteriser, image_shape, region_image
from packwork.scene.container import Container
from packwork.scene.pose import NO_LIMITS, Limits, Poses
from packwork.start.places import (
    AXIS_ELBOW_ROOM,
    AllowedPixels,
    allowed_pixels,
    around,
    distance_field,
    elbow_room,
    medial_axis,
    place_discs,
    scatter,
    suitable,
)

if TYPE_CHECKING:
    from packwork.start.options import Placing, StartOptions

RESOLUTION = 200
"""Pixels on the longer side of the image that places are chosen on, for up to 1,600
items; more items need smaller pixels. Larger is slower and no better. Tried."""

HULL_SHARE = 0.85
"""How much an item's hull counts against its area for the disc that stands for it:
0 the area alone, 1 the hull alone. Tried."""

APART, MOST_SIZES = 0.8, 60
"""Factor between the sizes tried until discs about all items find room, and how many are tried at
most: a millionth of the first is nothing that anyone would see. Chosen."""


@dataclass(frozen=True, eq=False)
class FirstPoses:
    """Poses to begin with, and the method that placed them."""

    poses: Poses
    method: Placing


def start_resolution(count: int) -> int:
    """Pixels on the longer side for ``count`` items.

    Examples
    --------
    >>> start_resolution(100), start_resolution(10_000)
    (200, 500)
    """
    return int(min(max(RESOLUTION, 5 * math.sqrt(count)), 1_000))


def first_poses(
    container: Container,
    outlines: Sequence[Outline],
    scales: FloatArray,
    angles: FloatArray,
    options: StartOptions,
    rng: np.random.Generator,
    limits: Limits = NO_LIMITS,
) -> FirstPoses:
    """Poses of items of given scales and angles, by the method asked for.

    Items that have to lie at one point come first and take their room, so that the others
    find their places round them.

    ``outlines``: one per item, item units.
    ``scales``, ``angles``: ``(n,)``.
    """
    image, px_per_cu = container_image(container, start_resolution(len(outlines)))
    if limits.binds:
        return _round_given(image, px_per_cu, outlines, scales, angles, options, rng, limits)
    x, y, method = _places(image, px_per_cu, disc_radii(outlines, scales), options, rng)
    return FirstPoses(Poses(x, y, angles, scales), method)


def poses_apart(
    container: Container, outlines: Sequence[Outline], scales: FloatArray, angles: FloatArray
) -> Poses | None:
    """Poses at which nothing meets, found at once: discs about the outlines, all in proportion.

    None if there is no room for so many even then. What there is where the search for the largest
    common size was ended before it found any.

    ``outlines``: one per item, item units.
    ``scales``, ``angles``: ``(n,)``; the scales are made smaller by one factor.

    Examples
    --------
    >>> square = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = square.mapped(np.array([[50.0, 0, 50], [0, 50.0, 50]]))
    >>> container = Container("", "", wall, 100.0, 100.0)
    >>> found = poses_apart(container, [square] * 2, np.full(2, 80.0), np.zeros(2))
    >>> bool(np.hypot(*np.diff([found.x, found.y])) > 2 * np.sqrt(2) * found.scale[0])
    True
    """
    image, px_per_cu = container_image(container, start_resolution(len(outlines)))
    arms = np.array([np.hypot(*outline.points.T).max() for outline in outlines])
    for _ in range(MOST_SIZES):
        # A pixel more: so far the image's edge may be from the container's.
        centres = _centres_apart(image, arms * scales * px_per_cu + 1.0)
        if centres is not None:
            x, y = centres / px_per_cu
            return Poses(x, y, angles, scales)
        scales = scales * APART
    return None


def _centres_apart(image: Image, radii_px: FloatArray) -> FloatArray | None:
    """``(2, n)`` x and y of discs that do not meet, the largest first; None without room."""
    found = np.empty((2, len(radii_px)))
    order = np.argsort(-radii_px, kind="stable")
    for void in largest_voids(Clearance(image > 0.5), order, lambda k, _: float(radii_px[k])):
        if void.radius < radii_px[void.item]:
            return None
        found[:, void.item] = void.x, void.y
    return found


def _round_given(
    image: Image,
    px_per_cu: float,
    outlines: Sequence[Outline],
    scales: FloatArray,
    angles: FloatArray,
    options: StartOptions,
    rng: np.random.Generator,
    limits: Limits,
) -> FirstPoses:
    """Poses of items of which some have to lie at one point, on a line or in a zone."""
    poses = Poses(limits.x.copy(), limits.y.copy(), angles, scales)
    placed = limits.held[:, :2].all(axis=1)
    left = around(image, px_per_cu, outlines, poses, np.flatnonzero(placed))
    others = [int(k) for k in np.flatnonzero(~placed)]
    radii = disc_radii([outlines[k] for k in others], scales[others])
    of_all = allowed_pixels(limits, left, px_per_cu)
    x, y, method = _places(left, px_per_cu, radii, options, rng, [of_all[k] for k in others])
    for given, found in ((poses.x, x), (poses.y, y)):
        given[others] = np.where(np.isnan(given[others]), found, given[others])
    return FirstPoses(poses, method)


def _places(
    image: Image,
    px_per_cu: float,
    radii: FloatArray,
    options: StartOptions,
    rng: np.random.Generator,
    own: AllowedPixels | None = None,
) -> tuple[FloatArray, FloatArray, Placing]:
    method: Placing = "distance-field"
    if options.method in {"medial-axis", "scatter"}:
        method = options.method
    elif options.method == "auto" and len(radii):
        method = suitable(image, px_per_cu, radii)
    if method == "scatter":
        return *scatter(image, px_per_cu, len(radii), rng, own), method
    if method == "medial-axis":
        return *medial_axis(image, px_per_cu, radii * AXIS_ELBOW_ROOM, rng, own), method
    room = elbow_room(len(radii))
    return *distance_field(image, px_per_cu, radii * room, rng, own), method


def disc_radii(outlines: Sequence[Outline], scales: FloatArray) -> FloatArray:
    """``(n,)`` radius, canvas units, of the disc that stands for each item.

    Examples
    --------
    >>> square = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> (np.pi * disc_radii([square], np.array([2.0])) ** 2).round(6).tolist()
    [16.0]
    """
    own = np.array([o.area for o in outlines]) ** (1 - HULL_SHARE)
    return np.asarray(np.sqrt(own * hull_areas(outlines) ** HULL_SHARE / np.pi) * scales)


def container_image(container: Container, resolution: int) -> tuple[Image, float]:
    """Coverage of the container, more than half somewhere, and its pixels per canvas unit.

    Examples
    --------
    >>> thread = Outline.from_rings([np.array([[10.0, 50], [90, 50], [90, 50.1], [10, 50.1]])])
    >>> image, px_per_cu = container_image(Container("thread", "", thread, 100, 100), 50)
    >>> bool(image.max() > 0.5), px_per_cu
    (True, 0.5)
    """
    px_per_cu = resolution / container.side
    shape = image_shape(container.width, container.height, resolution)
    image = region_image(container.outline, Rasteriser(shape), px_per_cu)
    if not (image > 0.5).any():
        # Thinner than a pixel everywhere: any pixel it touches will do.
        image = (image >= image.max()).astype(image.dtype)
    return image, px_per_cu


def relocated(
    container: Container,
    outlines: Sequence[Outline],
    poses: Poses,
    buried: IntArray,
    rng: np.random.Generator,
    limits: Limits = NO_LIMITS,
) -> Poses:
    """Poses with buried items relocated to where the others leave most room, the largest first.

    Items in a heap see nearly the same forces and do not come apart by them; lifted out
    one by one while a run goes on, they find the room already taken. The other items
    stay where they are.

    ``outlines``: one per item, item units.
    ``poses``: where the items are; angles, scales and stretches are kept.
    ``buried``: ``(m,)`` indices of items to move: those of which most is overlapped or outside.

    Examples
    --------
    >>> from packwork.geometry.affine import similarity
    >>> unit = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> container = Container("box", "", unit.mapped(similarity(50, 50, 0.0, 50)), 100, 100)
    >>> heap = Poses(*(np.full(4, value) for value in (50.0, 50.0, 0.0, 9.0)))
    >>> apart = relocated(container, [unit] * 4, heap, np.arange(1, 4), np.random.default_rng(0))
    >>> bool(apart.x[0] == 50 and np.hypot(apart.x - 50, apart.y - 50)[1:].min() > 20)
    True
    """
    image, px_per_cu = container_image(container, start_resolution(len(outlines)))
    own = None
    if limits.binds:
        buried = buried[limits.is_movable[buried]]
        of_all = allowed_pixels(limits, image, px_per_cu)
        own = [of_all[k] for k in buried]
    radii_px = disc_radii(outlines, poses.scale) * elbow_room(len(outlines)) * px_per_cu
    room = Clearance(image > 0.5)
    for k in np.setdiff1d(np.arange(len(outlines)), buried):
        room.occupy(float(poses.x[k]) * px_per_cu, float(poses.y[k]) * px_per_cu, radii_px[k])
    found_x, found_y = place_discs(room, radii_px[buried], rng, own)
    x, y = poses.x.copy(), poses.y.copy()
    x[buried], y[buried] = found_x / px_per_cu, found_y / px_per_cu
    return replace(poses, x=x, y=y)
