"""Ways inside a region: how far each pixel lies from one of the region's two ends.

The ends are those of the longest shortest path, by the double sweep (G. Handler, "Minimax location
of a facility in an undirected tree graph", Transportation Science 7 (1973), 287-293), exact in
trees and near it in regions that are long: along the medial axis of a snake the distance rises from
head to tail.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray

STEPS = ((0, 1), (1, 0), (1, 1), (1, -1))
"""Rows and columns to half of a pixel's neighbours."""


def lengthwise(mask: BoolArray) -> FloatArray:
    """``(rows, columns)`` pixels from the end that lies farther left; NaN outside.

    Parts that do not touch follow each other from left to right, each from where the last ended.

    Examples
    --------
    >>> mask = np.array([[True, True, True], [False, False, True], [False, False, True]])
    >>> lengthwise(mask).round(1).tolist()
    [[0.0, 1.0, 2.0], [nan, nan, 2.4], [nan, nan, 3.4]]
    """
    # Needed for such arrangements alone.
    from scipy.ndimage import label
    from scipy.sparse.csgraph import dijkstra

    found = np.full(mask.shape, np.nan)
    parts, count = label(mask, np.ones((3, 3)))
    firsts = [int(np.flatnonzero((parts == k + 1).any(axis=0))[0]) for k in range(count)]
    before = 0.0
    for part in np.argsort(firsts, kind="stable") + 1:
        inside = parts == part
        graph = _graph(inside)
        columns = np.nonzero(inside)[1]
        first = int(np.argmax(dijkstra(graph, directed=False, indices=0)))
        away = dijkstra(graph, directed=False, indices=first)
        last = int(np.argmax(away))
        if columns[last] < columns[first]:
            away = dijkstra(graph, directed=False, indices=last)
        found[inside] = before + away
        before += float(away.max()) + 1.0
    return found


def _graph(inside: BoolArray):  # type: ignore[no-untyped-def] # of a library without types
    """Sparse matrix of steps between pixels that touch, by their lengths."""
    from scipy.sparse import coo_array

    numbers: IntArray = np.full(np.add(inside.shape, 2), -1)
    numbers[1:-1, 1:-1][inside] = np.arange(np.count_nonzero(inside))
    rows, columns = np.nonzero(numbers >= 0)
    pairs, lengths = [], []
    for down, right in STEPS:
        there = numbers[rows + down, columns + right]
        known = there >= 0
        pairs.append((numbers[rows, columns][known], there[known]))
        lengths.append(np.full(np.count_nonzero(known), np.hypot(down, right)))
    ends = np.concatenate(pairs, axis=1)
    size = len(rows)
    return coo_array((np.concatenate(lengths), (ends[0], ends[1])), shape=(size, size)).tocsr()
