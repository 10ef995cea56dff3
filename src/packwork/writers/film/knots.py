"""Keyframe reduction: few frames between which a motion may be interpolated.

By the split of Douglas and Peucker (1973, see ``geometry.simplify``), with the largest difference
of any number at the same time for a distance.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray


def knots(path: FloatArray, tolerance: float) -> IntArray:
    """Frames between which a path may go straight on and be nowhere farther off.

    Parameters
    ----------
    path
        ``(frames, k)`` numbers, all of one unit.
    tolerance
        Largest difference of any number, in that unit.

    Examples
    --------
    >>> knots(np.array([[0.0], [1.0], [2.0], [2.0], [2.0]]), 0.1).tolist()
    [0, 2, 4]
    """
    last = len(path) - 1
    found, spans = {0, last}, [(0, last)]
    while spans:
        begin, end = spans.pop()
        if end - begin < 2:
            continue
        share = np.arange(1, end - begin)[:, None] / (end - begin)
        straight = (1 - share) * path[begin] + share * path[end]
        off = np.abs(path[begin + 1 : end] - straight).max(axis=1)
        worst = int(np.argmax(off))
        if off[worst] > tolerance:
            middle = begin + 1 + worst
            found.add(middle)
            spans += [(begin, middle), (middle, end)]
    return np.array(sorted(found), dtype=np.int64)


def item_knots(frames: FloatArray, radius: float, tolerance: float) -> IntArray:
    """The same of the ``(frames, 5)`` numbers of one item: no point of it is farther off.

    Parameters
    ----------
    frames
        As in a track.
    radius
        Of the item, its own units.
    tolerance
        Canvas units, for each of place, turn and size.
    """
    x, y, angle, scale, stretch = frames.T
    reach = radius * float(scale.max())
    ways = (x, y, reach * angle, radius * scale, reach * np.sqrt(stretch))
    return knots(np.column_stack(ways), tolerance)
