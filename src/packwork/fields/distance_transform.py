"""Exact Euclidean distance and feature transforms of masks, their components, and ways inside them.

C. Maurer, R. Qi and V. Raghavan, "A linear time algorithm for computing exact Euclidean distance
transforms of binary images in arbitrary dimensions", IEEE Transactions on Pattern Analysis and
Machine Intelligence 25 (2003), 265-270, doi:10.1109/TPAMI.2003.1177156: nearest in each column,
then a row's Voronoi diagram. Equal to those of ``scipy.ndimage``, to the choice among pixels as
near; but that takes half a second to load, and five times as long.

Geodesic distances are told from one of a region's two ends, those of the longest shortest path, by
the double sweep (G. Handler, "Minimax location of a facility in an undirected tree graph",
Transportation Science 7 (1973), 287-293), exact in trees and near it in regions that are long:
along the medial axis of a snake they rise from head to tail.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.fields import _kernels

Indices: TypeAlias = npt.NDArray[np.int32]


def distance_to(mask: BoolArray) -> FloatArray:
    """Distance ``(rows, columns)``, px, of pixels from the nearest True one; infinite without one.

    >>> distance_to(np.array([[True, False, False]])).tolist()
    [[0.0, 1.0, 2.0]]
    """
    if not mask.any():
        return np.full(mask.shape, np.inf)
    out = np.empty(mask.shape)
    _kernels.distance_to(np.ascontiguousarray(mask), out)
    return out


def nearest_to(mask: BoolArray) -> tuple[Indices, Indices]:
    """Rows and columns ``(rows, columns)`` of the True pixel, one at least, nearest to each pixel.

    >>> nearest_to(np.array([[True, False, False]]))[1].tolist()
    [[0, 0, 0]]
    """
    nearest_row, nearest_column = (np.empty(mask.shape, np.int32) for _ in range(2))
    _kernels.nearest_to(np.ascontiguousarray(mask), nearest_row, nearest_column)
    return nearest_row, nearest_column


def label_components(mask: BoolArray) -> tuple[Indices, int]:
    """Number of each pixel's component, from 1 on, by sides, 0 where False; and how many there are.

    >>> labels, count = label_components(np.array([[True, False, True]]))
    >>> labels.tolist(), count
    ([[1, 0, 2]], 2)
    """
    labels = np.zeros(mask.shape, np.int32)
    return labels, int(_kernels.label_components(np.ascontiguousarray(mask), labels))


def distance_inside(mask: BoolArray) -> FloatArray:
    """Distance ``(rows, columns)`` of each True pixel's centre from the mask's edge, px; 0 outside.

    What lies off the image counts as outside.

    >>> distance_inside(np.ones((3, 3), dtype=bool)).tolist()[1]
    [0.5, 1.5, 0.5]
    """
    padded = np.pad(mask, 1)
    distance = distance_to(~padded)[1:-1, 1:-1]
    return np.asarray(np.maximum(distance - 0.5, 0.0))


STEPS = ((0, 1), (1, 0), (1, 1), (1, -1))
"""Rows and columns to half of a pixel's neighbours."""


def lengthwise(mask: BoolArray) -> FloatArray:
    """``(rows, columns)`` pixels from the end that lies farther left; NaN outside.

    Parts that do not touch follow each other from left to right, each from where the last ended.

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


def longest_paths(mask: BoolArray, least: float) -> Iterator[IntArray]:
    """``(n, 2)`` columns and rows of pixels along the longest shortest path, then of what is left.

    Those of ``least`` pixels and more; of loops the halves.

    >>> mask = np.array([[True, True, True], [False, False, True], [True, False, True]])
    >>> [path.tolist() for path in longest_paths(mask, 2)]
    [[[0, 0], [1, 0], [2, 1], [2, 2]]]
    """
    for inside, corner, _, (first, away, before) in _walked(mask, least):
        path = [int(np.argmax(away))]
        while path[-1] != first:
            path.append(int(before[path[-1]]))
        if len(path) < least:
            continue
        rows, columns = (found[path] for found in np.nonzero(inside))
        inside[rows, columns] = False
        yield np.column_stack([columns, rows]) + corner
        yield from (left + corner for left in longest_paths(inside, least))


MOST_TRIED = 64
"""Closing steps of a part, the farthest first, whose loops are walked to find the longest. Smaller
may miss that of a part with many spurs round its far side. Chosen."""


def loops_of(mask: BoolArray, share: float) -> Iterator[IntArray]:
    """``(n, 2)`` columns and rows of pixels along the longest loop of each part of thin lines.

    A step between two pixels that no shortest path from one end takes closes a loop (a
    fundamental cycle). Those that have a ``share`` of their part's pixels at least, in order.

    >>> mask = np.ones((4, 5), dtype=bool)
    >>> mask[1:-1, 1:-1] = False
    >>> [len(loop) >= 10 for loop in loops_of(mask, 0.75)]
    [True]
    """
    for inside, corner, graph, (_, away, before) in _walked(mask):
        steps = graph.tocoo()
        closes = (before[steps.row] != steps.col) & (before[steps.col] != steps.row)
        pairs = np.column_stack([steps.row, steps.col])[closes]
        farthest = np.argsort(-away[pairs].sum(axis=1), kind="stable")[:MOST_TRIED]
        loops = (_loop(pair.tolist(), before) for pair in pairs[farthest])
        loop = max(loops, key=len, default=[])
        if len(loop) > share * np.count_nonzero(inside):
            rows, columns = (found[loop] for found in np.nonzero(inside))
            yield np.column_stack([columns, rows]) + corner


def _loop(pair: Sequence[int], before: IntArray) -> list[int]:
    """Pixels from one of a pair to where the ways to both part, and on to the other."""
    ways = []
    for end in pair:
        way = [end]
        while before[way[-1]] >= 0:
            way.append(int(before[way[-1]]))
        ways.append(way)
    one, other = ways
    while len(one) > 1 and len(other) > 1 and one[-2] == other[-2]:
        one.pop()
        other.pop()
    return [*one, *other[-2::-1]]


def _walked(
    mask: BoolArray, least: float = 0.0
) -> Iterator[tuple[BoolArray, tuple[int, int], Any, tuple[int, FloatArray, IntArray]]]:
    """Connected parts of ``least`` pixels, their windows' corners, graphs and ways from an end.

    Those are the end's number, each pixel's distance from it, and the pixel before it.
    """
    from scipy.ndimage import find_objects, label
    from scipy.sparse.csgraph import dijkstra

    parts, _ = label(mask, np.ones((3, 3)))
    for part, window in enumerate(find_objects(parts), start=1):
        inside = parts[window] == part
        if np.count_nonzero(inside) >= least:
            graph = _graph(inside)
            first = int(np.argmax(dijkstra(graph, directed=False, indices=0)))
            ways = dijkstra(graph, directed=False, indices=first, return_predecessors=True)
            yield inside, (window[1].start, window[0].start), graph, (first, *ways)


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
