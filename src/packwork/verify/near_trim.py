"""Shapes that end near where a sheet is trimmed."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray

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
    count = 0
    near = on_sheet & (gaps < _NEAR_PT - HAIR_PT).any(axis=1)
    for k in np.flatnonzero(near).tolist():
        ends = [side for side in range(4) if -HAIR_PT < gaps[k, side] < _NEAR_PT]
        count += any(gaps[k, side] > HAIR_PT or not _goes_on(boxes, gaps, k, side) for side in ends)
    return count


def _goes_on(boxes: FloatArray, gaps: FloatArray, k: int, side: int) -> bool:
    """Whether something beyond one side of the trim adjoins all of a shape that ends there."""
    across, opposite = 1 - side % 2, (side + 2) % 4
    length = gaps[k, opposite] + float(np.ptp(boxes[k, :, side % 2]))
    beyond = (gaps[:, side] < -SEEN_PT) & (gaps[:, opposite] < length + SEEN_PT)
    low = boxes[:, 0, across] < boxes[k, 0, across] + SEEN_PT
    high = boxes[:, 1, across] > boxes[k, 1, across] - SEEN_PT
    return bool((beyond & low & high).any())
