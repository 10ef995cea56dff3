"""Polygons in place: items and container in one array of points, and where the items are now."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.kernels import distances
from packwork.geometry.outline import Outline

LEAST_STRIDE = 32
"""Successive edges of the container that share a box, at least; of many, their square root, so that
there are as many boxes as edges in each. Larger looks at more edges, smaller at more boxes.
Tried."""

PAIRS_PER_ITEM = 16
"""Room for near pairs at first; more are counted and then looked for again."""


class Arrangement:
    """Polygons that must not meet, in place: the items, and last all that is not container.

    Parameters
    ----------
    outlines
        One per item, canvas units, about the item's own origin: as large, turned and
        stretched as when ``places`` is zero but for the position.
    container
        In canvas units.
    places
        ``(n, 4)``: x, y, turn in radians, logarithm of growth.
    """

    def __init__(self, outlines: Sequence[Outline], container: Outline, places: FloatArray) -> None:
        backwards = Outline.from_rings([ring[::-1] for ring in container.rings])
        parts = [*outlines, backwards]
        self.count = len(outlines)
        self.container = container
        self._ring_sizes = np.concatenate([np.diff(part.starts) for part in outlines])
        self._ring_items = np.repeat(np.arange(self.count), [len(o.starts) - 1 for o in outlines])
        own = np.concatenate([part.points for part in parts])
        starts = np.cumsum([0, *(len(part.points) for part in parts)])
        after, before = _neighbours(parts)
        lengths = np.hypot(own[:, 0], own[:, 1])
        arms = np.maximum.reduceat(lengths, starts[:-1])[:-1]
        boxes = np.tile(np.array(container.bounds), (len(parts), 1))
        edges = own[starts[-2] :], own[after[starts[-2] :]]
        stride = max(LEAST_STRIDE, math.isqrt(len(edges[0])))
        self.board = distances.Board(
            own, starts, after, before, own.copy(), boxes, _spans(*edges, stride), stride,
            np.zeros((self.count, 4)), arms,
        )  # fmt: skip
        self.put(np.arange(self.count), places)

    @property
    def places(self) -> FloatArray:
        """``(n, 4)``: x, y, turn, growth; change them by :meth:`put` only."""
        return self.board.places

    @property
    def radii(self) -> FloatArray:
        """``(n,)`` largest distance of a vertex from its item's origin, now."""
        return np.asarray(self.board.arms * np.exp(self.places[:, 3]))

    def put(self, items: IntArray, places: FloatArray) -> None:
        """Put items ``(m,)`` to places ``(m, 4)``: x, y, turn, growth, as in the class.

        Examples
        --------
        >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
        >>> two = Arrangement([box] * 2, box, np.zeros((2, 4)))
        >>> two.put(np.array([1]), np.array([[5.0, 0.0, 0.0, np.log(2)]]))
        >>> two.board.boxes[1].tolist()
        [3.0, -2.0, 7.0, 2.0]
        """
        distances.put(self.board, items, np.ascontiguousarray(places))

    def pairs(self, reach: float) -> IntArray:
        """``(k, 2)`` solids whose boxes are within ``reach``; each item with the container."""
        boxes = self.board.boxes[:-1]
        order = np.argsort(boxes[:, 0], kind="stable")
        found = np.empty((PAIRS_PER_ITEM * (self.count + 1), 2), dtype=np.int64)
        count = distances.near_pairs(boxes, order, reach, found)
        if count > len(found):
            found = np.empty((count, 2), dtype=np.int64)
            distances.near_pairs(boxes, order, reach, found)
        wall = np.column_stack([np.arange(self.count), np.full(self.count, self.count)])
        return np.concatenate([found[:count], wall])

    def distances(self, pairs: IntArray, reach: float) -> FloatArray:
        """``(k,)`` distances of pairs ``(k, 2)``, canvas units: 0 if they meet, or ``reach``."""
        return np.asarray(distances.distances(self.board, pairs, reach))

    def rings(self, items: IntArray) -> tuple[FloatArray, IntArray]:
        """Points ``(p, 2)`` of items ``(m,)`` in place, and starts of their rings ``(r + 1,)``."""
        chosen = np.isin(self._ring_items, items)
        sizes = self._ring_sizes[chosen]
        of_items = self.board.points[: self.board.starts[-2]]
        points = of_items[np.repeat(chosen, self._ring_sizes)]
        return points, np.concatenate([[0], np.cumsum(sizes)])

    def conflicts(self, pairs: IntArray, gap: float) -> IntArray:
        """Those of pairs ``(k, 2)`` nearer than ``gap``, canvas units, that meet or stick out.

        Examples
        --------
        >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
        >>> wall = box.mapped(np.array([[9.0, 0, 0], [0, 9.0, 0]]))
        >>> two = Arrangement([box] * 2, wall, np.array([[0.0, 0, 0, 0], [2.5, 0, 0, 0]]))
        >>> two.conflicts(two.pairs(1.0), 0.6).tolist()
        [[0, 1]]
        """
        return np.asarray(pairs[self.distances(pairs, gap) < gap])


def _spans(begins: FloatArray, ends: FloatArray, stride: int) -> FloatArray:
    """``(m, 4)`` boxes about every ``stride`` successive edges, given by their ends ``(p, 2)``."""
    firsts = np.arange(0, len(begins), stride)
    least = np.minimum.reduceat(np.minimum(begins, ends), firsts)
    most = np.maximum.reduceat(np.maximum(begins, ends), firsts)
    return np.column_stack([least, most])


def _neighbours(outlines: Sequence[Outline]) -> tuple[IntArray, IntArray]:
    """Index of the next and of the previous vertex in the ring of each."""
    lengths = np.concatenate([np.diff(outline.starts) for outline in outlines])
    starts = np.concatenate([[0], np.cumsum(lengths)])
    after = np.arange(1, starts[-1] + 1)
    after[starts[1:] - 1] = starts[:-1]
    before = np.arange(-1, starts[-1] - 1)
    before[starts[:-1]] = starts[1:] - 1
    return after, before
