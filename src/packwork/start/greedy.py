"""Greedy placement of discs: those that are bound to a place first, then the largest."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.fields.clearance import Clearance
from packwork.start.allowed_pixels import AllowedPixels

Spot: TypeAlias = tuple[float, float, float]
"""Pixel coordinates ``(x, y)`` and the radius of the free disc there."""

JITTER = 0.11
"""Random shift of each disc, in its radius: it makes seeds differ and breaks the ties of
symmetric containers. Larger undoes the even spread. Tried."""


def place_discs(
    room: Clearance,
    radii_px: FloatArray,
    spot_for: Callable[[float], Spot],
    rng: np.random.Generator,
    homes: AllowedPixels | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Centres ``(x, y)``, pixels, in the order of the radii.

    Parameters
    ----------
    room
        Where there is room; every disc is taken away from it.
    radii_px
        ``(n,)``.
    spot_for
        Chooses the place for a disc of a given radius from the room that is left.
    rng
        Shifts the discs a little.
    homes
        Pixels for discs that may not lie anywhere: they choose before the others.

    Examples
    --------
    >>> room = Clearance(np.ones((10, 30), dtype=bool))
    >>> radii = np.array([2.0, 4.0])
    >>> rng = np.random.default_rng(0)
    >>> x, y = place_discs(room, radii, lambda radius: room.largest(), rng)
    >>> bool(abs(x[0] - x[1]) > 6)
    True
    """
    x, y = np.empty(len(radii_px)), np.empty(len(radii_px))
    bound = [home is not None for home in homes or [None] * len(radii_px)]
    for k in np.lexsort((-radii_px, np.logical_not(bound))):
        radius = float(radii_px[k])
        home = None if homes is None else homes[k]
        at_x, at_y, free = spot_for(radius) if home is None else room.largest_among(home)
        shift = min(radius, max(free, 0.0)) * JITTER * rng.uniform(-1, 1, size=2)
        room.occupy(at_x, at_y, radius)
        x[k], y[k] = at_x + shift[0], at_y + shift[1]
    return x, y
