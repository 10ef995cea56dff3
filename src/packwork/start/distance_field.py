"""Greedy start: each item, largest first, where there is most room."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.fields.clearance import Clearance

JITTER = 0.11
"""Random shift of each item, in its radius: it makes seeds differ and breaks the ties
of symmetric containers. Larger undoes the even spread. Tried."""


def distance_field(
    container: Image, px_per_cu: float, radii_cu: FloatArray, rng: np.random.Generator
) -> tuple[FloatArray, FloatArray]:
    """Centres ``(x, y)``, canvas units, of discs placed largest first.

    Wang and Lu 2025, section 3.4; the field is updated round each disc only, so that n
    items cost n small windows and not n full transforms. When there is no room left,
    items go where they overlap least.

    Parameters
    ----------
    container
        Coverage of the container.
    px_per_cu
        Pixels of that image per canvas unit.
    radii_cu
        ``(n,)`` radius of a disc of each item's area.
    rng
        Breaks ties.
    """
    room = Clearance(container > 0.5)
    x, y = np.empty(len(radii_cu)), np.empty(len(radii_cu))
    for k in np.argsort(-radii_cu, kind="stable"):
        x_px, y_px, free = room.largest()
        radius = float(radii_cu[k]) * px_per_cu
        shift = min(radius, max(free, 0.0)) * JITTER * rng.uniform(-1, 1, size=2)
        room.occupy(x_px, y_px, radius)
        x[k], y[k] = (x_px + shift[0]) / px_per_cu, (y_px + shift[1]) / px_per_cu
    return x, y
