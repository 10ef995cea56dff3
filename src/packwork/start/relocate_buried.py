"""Relocation of buried items to free places, before a run begins."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from packwork.arrays import IntArray
from packwork.fields.clearance import Clearance
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.limits import NO_LIMITS, Limits
from packwork.scene.pose import Poses
from packwork.start.allowed_pixels import allowed_pixels
from packwork.start.distance_field import elbow_room
from packwork.start.first_poses import container_image, disc_radii, start_resolution
from packwork.start.greedy import place_discs


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

    Parameters
    ----------
    outlines
        One per item, item units.
    poses
        Where the items are; angles, scales and stretches are kept.
    buried
        ``(m,)`` indices of items to move: those of which most is overlapped or outside.

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
