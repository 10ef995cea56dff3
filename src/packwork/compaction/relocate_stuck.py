"""Relocation of items that have no place to the largest voids, at the size that fits.

The centre of a void is that of the largest empty circle (G. Toussaint, "Computing largest empty
circles with location constraints", International Journal of Computer and Information Sciences 12
(1983), 347-358), read from a distance transform and not from a Voronoi diagram.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.fields.clearance import Clearance
from packwork.fields.voids import largest_voids
from packwork.raster.coverage import coverage

PIXELS_PER_ITEM = 24.0
"""Pixels of the image of voids along the side of an item's share of the container. More
sees smaller voids and takes longer. Tried."""

ACROSS = 4.0
"""Pixels of that image across the container's mean thickness, at least: a spiral of thin lines has
no room at all on a coarse one. Larger takes longer. Chosen."""

LEAST_SIDE, MOST_SIDE = 128, 2_048
"""Bounds of that image's longer side, px. Chosen."""

SNUG = 0.9
"""Radius of an item in a void over the void's. Larger may not fit, smaller has farther to
grow. Chosen."""

FAINT = 1e-3
"""Coverage of a pixel that counts as none. Chosen."""

SMALLEST_VOID = 0.5
"""Radius of the smallest void that takes an item, px: below it the image is not to be
believed. Chosen."""


def relocate(arrangement: Arrangement, items: IntArray, gap: float) -> None:
    """Move items ``(m,)``, the largest first, to the largest voids; smaller, never larger.

    An item for which there is no room stays where it is.
    """
    others = np.setdiff1d(np.arange(arrangement.count), items)
    room, px_per_cu, corner = free_room(arrangement, others)
    order = items[np.argsort(-arrangement.radii[items], kind="stable")]

    def fitting(radius: float) -> float:
        return max(SNUG * radius / px_per_cu - gap, SNUG * SMALLEST_VOID / px_per_cu)

    for k, x, y, radius in largest_voids(
        room, order, lambda _, radius: fitting(radius) * px_per_cu, least_px=SMALLEST_VOID
    ):
        _, _, turn, growth = arrangement.places[k]
        growth = min(growth, float(np.log(fitting(radius) / arrangement.board.arms[k])))
        place = [corner[0] + x / px_per_cu, corner[1] + y / px_per_cu, turn, growth]
        arrangement.put(np.array([k]), np.array([place]))


def free_room(
    arrangement: Arrangement, items: IntArray
) -> tuple[Clearance, float, tuple[float, float]]:
    """Free room beside ``items`` ``(m,)`` alone; px per canvas unit; the image's corner."""
    left, top, right, bottom = arrangement.container.bounds
    side = max(right - left, bottom - top)
    thickness = 2 * arrangement.container.area / arrangement.container.region.length
    wanted = max(PIXELS_PER_ITEM * np.sqrt(arrangement.count), ACROSS * side / thickness)
    px_per_cu = float(np.clip(wanted, LEAST_SIDE, MOST_SIDE)) / side
    shape = int((bottom - top) * px_per_cu) + 2, int((right - left) * px_per_cu) + 2
    corner = np.array([left, top])

    def image(points: FloatArray, starts: IntArray) -> Image:
        return coverage((points - corner) * px_per_cu, starts, shape, np.float32)

    inside = image(arrangement.container.points, arrangement.container.starts)
    taken = image(*arrangement.rings(items)) if len(items) else np.zeros(shape)
    return Clearance((inside > 1 - FAINT) & (taken < FAINT)), px_per_cu, (left, top)
