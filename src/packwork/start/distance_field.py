"""Distance-field start: each item, largest first, at the centre of the largest empty circle.

Wang and Lu 2025, section 3.4 (doi:10.1145/3721238.3730690).
"""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.fields.clearance import Clearance
from packwork.start.allowed_pixels import AllowedPixels
from packwork.start.greedy import place_discs

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

    Parameters
    ----------
    radii_cu
        ``(n,)`` radius of the disc to keep free for each item.

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
