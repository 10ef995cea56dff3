"""Opening and closing of regions by discs, through distance transforms; erosion by sides.

J. Serra, "Image Analysis and Mathematical Morphology", Academic Press 1982.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray
from packwork.fields.distance_transform import distance_to


def closed(mask: BoolArray, radius_px: float) -> BoolArray:
    """Closing of a mask ``(rows, columns)``: what a disc of a radius, px, cannot enter is filled.

    What lies off the image counts as outside.

    Examples
    --------
    >>> ring = np.ones((3, 3), dtype=bool)
    >>> ring[1, 1] = False
    >>> bool(closed(ring, 1.0)[1, 1])
    True
    """
    margin = int(radius_px) + 2
    near = distance_to(np.pad(mask, margin)) <= radius_px
    within = (slice(margin, -margin),) * 2
    return np.asarray((distance_to(~near) > radius_px)[within])


def opened(mask: BoolArray, radius_px: float) -> BoolArray:
    """Opening of a mask ``(rows, columns)``: what a disc of a radius, px, inside it can cover.

    What lies off the image counts as outside.

    Examples
    --------
    >>> opened(np.array([[0, 0, 0, 1, 1, 1, 0], [1, 1, 0, 1, 1, 1, 0], [0, 0, 0, 1, 1, 1, 0]],
    ...        dtype=bool), 1.5)[1].astype(int).tolist()
    [0, 0, 0, 1, 1, 1, 0]
    """
    room = distance_to(np.pad(~mask, 1, constant_values=True))[1:-1, 1:-1]
    # Centres and edges of pixels lie half a pixel apart.
    core = room - 0.5 >= radius_px
    return np.asarray(mask & (distance_to(core) <= radius_px))


def eroded(mask: BoolArray, steps: int) -> BoolArray:
    """Mask ``(rows, columns)`` without what some steps from side to side lead out of.

    What lies off the image counts as outside.

    Examples
    --------
    >>> eroded(np.ones((3, 4), dtype=bool), 1).astype(int).tolist()
    [[0, 0, 0, 0], [0, 1, 1, 0], [0, 0, 0, 0]]
    """
    for _ in range(steps):
        padded = np.pad(mask, 1)
        across = padded[1:-1, :-2] & padded[1:-1, 2:]
        mask = mask & across & padded[:-2, 1:-1] & padded[2:, 1:-1]
    return mask
