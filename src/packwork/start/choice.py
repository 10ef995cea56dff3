"""Choice of the start that suits a container: medial axis where it is narrow."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.fields.clearance import distance_inside
from packwork.fields.skeleton import medial_axis
from packwork.start.options import Placing

NARROW = 1.6
"""Half the container's mean width, in radii of the items' mean disc, below which items
start along its middle line. Larger lines up items that have room side by side. Tried."""


def suitable(container: Image, px_per_cu: float, radii_cu: FloatArray) -> Placing:
    """Choose the medial axis where few items fit side by side, else the distance field.

    Parameters
    ----------
    container
        Coverage of the container, not 0 everywhere.
    radii_cu
        ``(n,)`` radius of a disc of each item's size.

    Examples
    --------
    >>> suitable(np.ones((10, 90)), 1.0, np.full(9, 4.0))
    'medial-axis'
    >>> suitable(np.ones((10, 90)), 1.0, np.full(99, 1.0))
    'distance-field'
    """
    mask = container > 0.5
    width_px = distance_inside(mask)[medial_axis(mask)]
    is_narrow = np.mean(width_px) < NARROW * np.mean(radii_cu) * px_per_cu
    return "medial-axis" if is_narrow else "distance-field"
