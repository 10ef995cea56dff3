"""Medial-axis start: items along the container's middle line, larger ones where it is wider.

Wang and Lu 2025, section 3.4 (doi:10.1145/3721238.3730690).
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.fields.clearance import Clearance
from packwork.fields.skeleton import medial_axis as axis_of
from packwork.start.allowed_pixels import AllowedPixels
from packwork.start.greedy import place_discs

ELBOW_ROOM = 1.5
"""As for the distance field; closer, because items on a line have two neighbours only.
Tried."""


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

    Parameters
    ----------
    container
        Coverage of the container, not 0 everywhere.
    radii_cu
        ``(n,)`` radius of the disc to keep free for each item.

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
