"""Skeleton of a region: its middle line, one pixel wide.

Z. Guo and R. Hall, "Parallel thinning with two-subiteration algorithms", Communications of the ACM
32 (1989), 359-373, doi:10.1145/62065.62074, algorithm A1. Zhang and Suen's older conditions delete
squares of two by two pixels whole; these keep every part in one piece.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray
from packwork.fields import _kernels


def _removable() -> BoolArray:
    """``(2, 256)``: whether a pixel with these neighbours goes in the first, second sub-iteration.

    Neighbours are bits, clockwise from the one above; ``p2`` to ``p9`` as the paper names them.
    """
    p2, p3, p4, p5, p6, p7, p8, p9 = (np.arange(256) >> np.arange(8)[:, None]) & 1 == 1
    corners = ((p2, p3, p4), (p4, p5, p6), (p6, p7, p8), (p8, p9, p2))
    connected = sum((~a & (b | c)).astype(int) for a, b, c in corners)
    sides = sum((a | b).astype(int) for a, b in ((p9, p2), (p3, p4), (p5, p6), (p7, p8)))
    other_sides = sum((a | b).astype(int) for a, b in ((p2, p3), (p4, p5), (p6, p7), (p8, p9)))
    neighbours = np.minimum(sides, other_sides)
    is_simple = (connected == 1) & (neighbours >= 2) & (neighbours <= 3)
    return np.stack([is_simple & ~((p2 | p3 | ~p5) & p4), is_simple & ~((p6 | p7 | ~p9) & p8)])


def medial_axis(mask: BoolArray) -> BoolArray:
    """True on the line, one pixel wide, that runs midway between the region's edges.

    Thinned, not read from the distance field: the same mask always
    has the same axis, and the staircases of slanting edges grow no branches. Every part
    of the region keeps at least one pixel. What lies off the image counts as outside.

    Examples
    --------
    >>> medial_axis(np.ones((3, 6), dtype=bool)).any(axis=1).tolist()
    [False, True, False]
    """
    image = np.pad(mask, 1).astype(np.uint8)
    rows, cols = np.nonzero(image)
    _kernels.thin(image, _removable(), rows, cols)
    return image[1:-1, 1:-1].astype(np.bool_)
