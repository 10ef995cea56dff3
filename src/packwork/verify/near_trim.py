"""Shapes that end near where a sheet is trimmed."""

from __future__ import annotations

import math
from itertools import islice

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray

NEAR_MM = 3.0
"""Width along the trim within which a knife may stray, and within which nothing should end."""

HAIR_PT = 0.01
"""Distance that is rounding."""

SEEN_PT = 0.1
"""Overlap of art in the bleed with art on the sheet, at most."""

_NEAR_PT = NEAR_MM * 72 / 25.4


def ending_near(boxes: FloatArray, trim: FloatArray) -> int:
    """Number of shapes that end near the trim and are not continued beyond it.

    ``boxes``: ``(n, 2, 2)`` low and high corners of the shapes; ``trim``: ``(2, 2)`` of the trimmed
    sheet; points.

    Examples
    --------
    >>> trim = np.array([[0.0, 0.0], [100.0, 100.0]])
    >>> ending_near(np.array([[[20.0, 20.0], [99.0, 30.0]], [[20.0, 20.0], [80.0, 30.0]]]), trim)
    1
    """
    # Distances of left, low, right and high inwards from the trim.
    gaps = np.hstack([boxes[:, 0] - trim[0], trim[1] - boxes[:, 1]])
    inner = np.minimum(boxes[:, 1], trim[1]) - np.maximum(boxes[:, 0], trim[0])
    on_sheet = (inner > SEEN_PT).all(axis=1)
    near = on_sheet & (gaps < _NEAR_PT - HAIR_PT).any(axis=1)
    ends = near[:, None] & (gaps > -HAIR_PT) & (gaps < _NEAR_PT)
    stops = ends & (gaps > HAIR_PT)
    for side in range(4):
        on_trim = np.flatnonzero(ends[:, side] & ~stops[:, side] & ~stops.any(axis=1))
        if len(on_trim):
            stops[on_trim, side] = ~_go_on(boxes, gaps, on_trim, side)
    return int(stops.any(axis=1).sum())


def _go_on(boxes: FloatArray, gaps: FloatArray, shapes: IntArray, side: int) -> BoolArray:
    """Flags of shapes that end at one side of the trim: something beyond adjoins all of each.

    Asked of the shapes from the shortest inwards, with all beyond that reach no farther in than
    these; its work grows with the number of shapes and its logarithm.
    """
    across, opposite = 1 - side % 2, (side + 2) % 4
    beyond = np.flatnonzero(gaps[:, side] < -SEEN_PT)
    beyond = beyond[np.argsort(gaps[beyond, opposite], kind="stable")]
    lows, order = np.unique(boxes[beyond, 0, across], return_inverse=True)
    lengths = gaps[shapes, opposite] + np.ptp(boxes[shapes, :, side % 2], axis=1)
    inner = np.searchsorted(gaps[beyond, opposite], lengths + SEEN_PT).tolist()
    lower = np.searchsorted(lows, boxes[shapes, 0, across] + SEEN_PT).tolist()
    needed = (boxes[shapes, 1, across] - SEEN_PT).tolist()
    added = zip(order.tolist(), boxes[beyond, 1, across].tolist(), strict=True)
    highs = [-math.inf] * (len(lows) + 1)
    found, done = np.zeros(len(shapes), dtype=bool), 0
    # Highest of all that begin below: a tree of prefixes (P. M. Fenwick, "A new data structure for
    # cumulative frequency tables", Software: Practice and Experience 24, 1994).
    for k in np.argsort(inner, kind="stable").tolist():
        for place, high in islice(added, inner[k] - done):
            node = place + 1
            while node < len(highs) and highs[node] < high:
                highs[node] = high
                node += node & -node
        done, node, highest = inner[k], lower[k], -math.inf
        while node:
            highest = max(highest, highs[node])
            node &= node - 1
        found[k] = highest > needed[k]
    return found
