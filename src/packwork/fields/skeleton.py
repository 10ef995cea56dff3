"""Skeleton of a region: its middle line, one pixel wide.

T. Zhang and C. Suen, "A fast parallel algorithm for thinning digital patterns", Communications of
the ACM 27 (1984), 236-239, doi:10.1145/357994.358023, as scikit-image has it.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray


def medial_axis(mask: BoolArray) -> BoolArray:
    """True on the line, one pixel wide, that runs midway between the region's edges.

    Thinned, not read from the distance field: the same mask always
    has the same axis, and the staircases of slanting edges grow no branches. Every part
    of the region keeps at least one pixel. What lies off the image counts as outside.

    Parameters
    ----------
    mask
        The region, ``[row, col]``.

    Examples
    --------
    >>> medial_axis(np.ones((3, 6), dtype=bool)).any(axis=1).tolist()
    [True, True, False]
    """
    # Takes longer to load than most runs take to start, and few look for a middle line.
    from skimage.morphology import skeletonize

    return np.asarray(skeletonize(np.pad(mask, 1)), dtype=np.bool_)[1:-1, 1:-1]
