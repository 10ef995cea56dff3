"""The middle line of a region."""

from __future__ import annotations

import numpy as np
from skimage.morphology import skeletonize

from packwork.arrays import BoolArray


def medial_axis(mask: BoolArray) -> BoolArray:
    """True on the line, one pixel wide, that runs midway between the region's edges.

    Thinned (Zhang and Suen 1984), so that the same mask always has the same axis, and
    the pixels of a straight edge's staircase grow no branches. A region too small to
    thin is its own axis. What lies off the image counts as outside.

    Examples
    --------
    >>> medial_axis(np.ones((3, 7), dtype=bool)).astype(int).tolist()
    [[0, 0, 0, 0, 0, 0, 0], [0, 1, 1, 1, 1, 1, 0], [0, 0, 0, 0, 0, 0, 0]]
    """
    axis = np.asarray(skeletonize(np.pad(mask, 1)), dtype=np.bool_)[1:-1, 1:-1]
    return axis if axis.any() else mask
