"""Greedy placement of discs: those that are bound to a place first, then the largest."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.fields.clearance import Clearance
from packwork.fields.voids import largest_voids
from packwork.start.allowed_pixels import AllowedPixels

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

    Parameters
    ----------
    room
        Where there is room; every disc is taken away from it.
    radii_px
        ``(n,)``.
    homes
        Pixels for discs that may not lie anywhere: they choose before the others.
    preferred
        Pixels ``(m,)`` that the others take as long as their discs fit there.

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
