"""Polygons in place: items and container in one array of points, and where the items are now.

Where they repeat by a lattice there are no walls: each item has images about it, which move as it
does and must not be met either. Rounds work on outlines that are simplified to a tolerance
(:class:`Detail`); conflicts of a layout are found by the true ones.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.kernels import broad_phase, distances
from packwork.compaction.outer_simplify import Covers, inner_simplified
from packwork.geometry.distance import distance
from packwork.geometry.lattice import Lattice
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference, intersection, part_about
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.threads import at_once

LEAST_STRIDE = 32
"""Successive edges of the container that share a box, at least; of many, their square root. Larger
looks at more edges, smaller at more boxes. Tried."""

FAR = 9
"""Cells as far as which walls lie that no item meets. Derived: images reach two."""

MOST_PAIRS = 4_000
"""Pairs whose distances are looked at by one thread at a time, some ten milliseconds. Chosen."""

PAIRS_PER_ITEM = 16
"""Room for near pairs at first; more are counted and then looked for again."""


class Arrangement:
    """Polygons that must not meet, in place: the items, and last all that is not container.

    ``outlines``: one per item, canvas units, about its own origin, as when ``places`` is zero but
    for the position; ``places``: ``(n, 4)`` x, y, turn in radians, logarithm of growth;
    ``lattice``: by which they repeat; a container that is its cell then has no walls.
    """

    def __init__(
        self,
        outlines: Sequence[Outline],
        container: Outline,
        places: FloatArray,
        lattice: Lattice | None = None,
    ) -> None:
        self.count = len(outlines)
        self.container, self.lattice = container, lattice
        self.is_open = False
        """Whether there is no wall: of what repeats, the outline of the cell is none."""
        shifts = np.zeros((0, 2)) if lattice is None else lattice.neighbours()
        if lattice is not None and container.bounds == lattice.cell:
            far, self.is_open = FAR * max(lattice.width, lattice.height), True
            container = Outline.box(-far, -far, far, far)
        backwards = Outline.from_rings([ring[::-1] for ring in container.rings])
        images = [outline for outline in outlines for _ in shifts]
        parts = [*outlines, *images, backwards]
        items = np.arange(self.count)
        self.owners = np.concatenate([items, np.repeat(items, len(shifts)), [self.count]])
        """``(p,)`` item that each polygon is, or is an image of; last the container, ``count``."""
        self._ring_sizes = np.concatenate([np.diff(part.starts) for part in parts[:-1]])
        self._ring_items = np.repeat(self.owners[:-1], [len(o.starts) - 1 for o in parts[:-1]])
        own = np.concatenate([part.points for part in parts])
        starts = np.cumsum([0, *(len(part.points) for part in parts)])
        after, before = _neighbours(parts)
        arms = np.maximum.reduceat(np.hypot(own[:, 0], own[:, 1]), starts[:-1])[:-1]
        boxes = np.tile(np.array(container.bounds), (len(parts), 1))
        edges = own[starts[-2] :], own[after[starts[-2] :]]
        stride = max(LEAST_STRIDE, math.isqrt(len(edges[0])))
        self.board = distances.Board(
            own, starts, after, before, own.copy(), boxes, _spans(*edges, stride), stride,
            np.zeros((len(arms), 4)), arms, np.append(self.owners[:-1], len(arms)), shifts,
        )  # fmt: skip
        if lattice is not None:
            # Images reach one cell from where an item is: all are brought into the same one.
            places = np.column_stack([lattice.wrapped(places[:, :2]), places[:, 2:]])
        self.put(items, places)

    @property
    def places(self) -> FloatArray:
        """``(n, 4)``: x, y, turn, growth; change them by :meth:`put` only."""
        return self.board.places[: self.count]

    @property
    def radii(self) -> FloatArray:
        """``(n,)`` largest distance of a vertex from its item's origin, now."""
        return np.asarray(self.board.arms[: self.count] * np.exp(self.places[:, 3]))

    def wrap(self, share: float) -> None:
        """Cut the plane elsewhere: bring items into the cell that lies off by a share of one."""
        if self.lattice is not None and self.is_open:
            places = self.places.copy()
            off = share * np.array([self.lattice.width, self.lattice.height])
            places[:, :2] = self.lattice.wrapped(places[:, :2] + off) - off
            self.put(np.arange(self.count), places)

    def put(self, items: IntArray, places: FloatArray) -> None:
        """Put items ``(m,)`` to places ``(m, 4)``: x, y, turn, growth, as in the class.

        >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
        >>> two = Arrangement([box] * 2, box, np.zeros((2, 4)))
        >>> two.put(np.array([1]), np.array([[5.0, 0.0, 0.0, np.log(2)]]))
        >>> two.board.boxes[1].tolist()
        [3.0, -2.0, 7.0, 2.0]
        """
        distances.put(self.board, items, np.ascontiguousarray(places))

    def pairs(self, reach: float) -> IntArray:
        """``(k, 2)`` polygons whose boxes are within ``reach``; each item with the container.

        The first of two is an item, not an image.
        """
        boxes = self.board.boxes[:-1]
        order = np.argsort(boxes[:, 0], kind="stable")
        found = np.empty((PAIRS_PER_ITEM * (self.count + 1), 2), dtype=np.int64)
        count = broad_phase.near_pairs(boxes, order, reach, found)
        if count > len(found):
            found = np.empty((count, 2), dtype=np.int64)
            broad_phase.near_pairs(boxes, order, reach, found)
        found = found[:count]
        wall = np.column_stack([np.arange(self.count), np.full(self.count, len(boxes))])
        if self.lattice is not None:
            found = found[found[:, 0] < self.count]
        return np.concatenate([found, wall])

    def distances(self, pairs: IntArray, reach: float) -> FloatArray:
        """``(k,)`` distances of pairs ``(k, 2)``, canvas units: 0 if they meet, or ``reach``."""
        # What takes less than some milliseconds is not parted.
        parts = np.array_split(pairs, -(-len(pairs) // MOST_PAIRS)) if len(pairs) else [pairs]
        calls = [(self.board, part, reach) for part in parts]
        return np.concatenate(at_once(distances.distances, calls))

    def rings(self, items: IntArray) -> tuple[FloatArray, IntArray]:
        """Points ``(p, 2)`` of items ``(m,)`` and images, and starts of rings ``(r + 1,)``."""
        chosen = np.isin(self._ring_items, items)
        sizes = self._ring_sizes[chosen]
        of_items = self.board.points[: self.board.starts[-2]]
        points = of_items[np.repeat(chosen, self._ring_sizes)]
        return points, np.concatenate([[0], np.cumsum(sizes)])

    def conflicts(self, pairs: IntArray, gap: float) -> IntArray:
        """Items of pairs ``(k, 2)`` nearer than ``gap``, canvas units, that meet or stick out.

        The container is called ``count``.

        >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
        >>> wall = box.mapped(np.array([[9.0, 0, 0], [0, 9.0, 0]]))
        >>> two = Arrangement([box] * 2, wall, np.array([[0.0, 0, 0, 0], [2.5, 0, 0, 0]]))
        >>> two.conflicts(two.pairs(1.0), 0.6).tolist()
        [[0, 1]]
        """
        return np.asarray(self.owners[pairs[self.distances(pairs, gap) < gap]])


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


COARSE, FINE = 4e-3, 3e-4
"""Tolerance of the outlines that rounds work on, shares of an item's extent: first and last. Larger
is faster and wastes room. Tried."""

FINE_OF_GAP, COARSE_OF_GAP, ROUGHEST = 0.003, 0.015, 0.1
"""Tolerances of outlines as shares of the gap, where items are small beside it, and the largest
share of an item's extent. Larger wastes room, smaller takes minutes where the gap is as wide as
items. Tried."""


class Detail:
    """Covers of the outlines at one tolerance, finer ones inside coarser ones.

    ``outlines``: one per item, item units; ``container``: canvas units; ``poses``: first poses,
    whose scales, angles and stretches are taken in; ``lattice``: by which all repeat.
    """

    def __init__(
        self,
        outlines: Sequence[Outline],
        container: Outline,
        poses: Poses,
        lattice: Lattice | None = None,
    ) -> None:
        self._outlines, self._container, self._poses = outlines, container, poses
        self._lattice = lattice

    def tolerance(self, least: float, distance_cu: float) -> float:
        """A distance in shares of the usual item's extent; no less than ``least``.

        >>> one = np.ones(1)
        >>> tile = Outline.from_rings([np.array([[0.0, 0], [9, 0], [9, 9], [0, 9]])])
        >>> detail = Detail([tile], tile, Poses(one, one, one, 2 * one))
        >>> detail.tolerance(1e-3, 0.9), detail.tolerance(1e-3, 1e-3)
        (0.05, 0.001)
        """
        extents = [outline.extent for outline in self._outlines] * self._poses.scale
        return float(np.clip(distance_cu / np.median(extents), least, max(least, ROUGHEST)))

    def covers(self, tolerance: float, stop: Callable[[], bool] = bool) -> Detail:
        """The same with fewer vertices, ``tolerance`` in shares of extents; itself once stopped."""
        known: dict[Outline, Outline] = {}
        covers = Covers()
        for outline in self._outlines:
            if outline not in known:
                if stop():
                    return self
                known[outline] = covers.cover_of_shape(outline, tolerance)
        outlines = [known[outline] for outline in self._outlines]
        sizes = [outline.extent for outline in self._outlines] * self._poses.scale
        container = self._container
        if self._lattice is None:
            slack = tolerance * float(np.median(sizes))
            container = Outline.from_region(inner_simplified(container.region, slack))
        return Detail(outlines, container, self._poses, self._lattice)

    def subset(self, items: IntArray, poses: Poses) -> Detail:
        """The same of items ``(m,)``, by their indices: of the same sizes, in other poses."""
        own = [self._outlines[int(k)] for k in items]
        return Detail(own, self._container, poses.subset(items), self._lattice)

    def arrangement(self, places: FloatArray) -> Arrangement:
        """Outlines in place: ``(n, 4)`` x, y, turn and growth against the first poses."""
        own = []
        for k, outline in enumerate(self._outlines):
            matrix = self._poses.matrix(k).copy()
            matrix[:, 2] = 0.0
            own.append(outline.mapped(matrix))
        return Arrangement(own, self._container, places, self._lattice)


ROUNDING = 1e-9
"""Share of the gap that rounding may take. Derived: coordinates are good to 1e-16 of the canvas,
the smallest gap is 1e-5 of it."""


STRIP = 1_000
"""Items whose polygons are in memory at once where conflicts are looked for. Larger takes memory,
smaller more often what lies at the edge of a strip."""


@dataclass(frozen=True)
class Conflict:
    """An item in conflict with another one, or with the container if ``other`` is None.

    ``overlap_cu2``: area that they share, or that lies outside the container; ``gap_cu``: their
    distance if they share none.
    """

    item: int
    other: int | None
    overlap_cu2: float
    gap_cu: float

    def numbered(self, items: IntArray) -> Conflict:
        """The same where items are called by the numbers ``(n,)``."""
        other = None if self.other is None else int(items[self.other])
        return replace(self, item=int(items[self.item]), other=other)


def find_conflicts(
    container: Container, outlines: Sequence[Outline], poses: Poses, gap: float
) -> tuple[Conflict, ...]:
    """Pairs nearer than ``gap``, and items nearer to the container's edge or beyond it.

    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[5.0, 0, 5], [0, 5.0, 5]]))
    >>> poses = Poses(np.array([4.0, 5.5]), np.full(2, 5.0), np.zeros(2), np.ones(2))
    >>> found = find_conflicts(Container("", "", wall, 10, 10), [box] * 2, poses, 0.1)
    >>> [(o.item, o.other, o.overlap_cu2) for o in found]
    [(0, 1, 1.0)]
    """
    if len(outlines) == 0:
        return ()
    if container.lattice is not None:
        x, y = container.lattice.wrapped(np.column_stack([poses.x, poses.y])).T
        poses = replace(poses, x=x, y=y)
    zero = np.zeros(len(poses))
    places = np.column_stack([poses.x, poses.y, zero, zero])
    detail = Detail(outlines, container.outline, poses, container.lattice)
    # Two that meet over an edge are found from either side.
    pairs: dict[tuple[int, int], None] = {}
    # Where items repeat, what is near may lie on the other side.
    most = STRIP if container.lattice is None else len(poses)
    for items in _strips(outlines, poses, gap, most):
        arrangement = detail.subset(items, poses).arrangement(places[items])
        bad = arrangement.conflicts(arrangement.pairs(gap), gap * (1 - ROUNDING))
        names = np.append(items, len(outlines))[bad]
        pairs |= dict.fromkeys((int(min(pair)), int(max(pair))) for pair in names)
    return tuple(_conflict(container, outlines, poses, i, j, gap) for i, j in pairs)


def _strips(outlines: Sequence[Outline], poses: Poses, gap: float, most: int) -> Iterator[IntArray]:
    """Strips of ``most`` items along the longer side, each with all beyond it that may be near.

    All in their order where there are no more.
    """
    if len(poses) <= most:
        yield np.arange(len(poses))
        return
    reach = poses.scale * np.sqrt(np.maximum(poses.stretch, 1 / poses.stretch))
    reach *= np.array([outline.radius for outline in outlines])
    along = max(poses.x, poses.y, key=np.ptp)
    order = np.argsort(along - reach, kind="stable")
    nearest, farthest = (along - reach)[order], (along + reach)[order]
    for begin in range(0, len(order), most):
        beyond = farthest[begin : begin + most].max() + gap
        yield order[begin : max(int(np.searchsorted(nearest, beyond)), begin + most)]


def _conflict(
    container: Container, outlines: Sequence[Outline], poses: Poses, i: int, j: int, gap: float
) -> Conflict:
    first = outlines[i].mapped(poses.matrix(i)).region
    if j == len(outlines):
        # What is nearer than asked lies within that gap.
        near = part_about(container.outline.region, first, gap)
        outside = float(difference(first, near).area)
        return Conflict(i, None, outside, 0.0 if outside > 0 else distance(near.boundary, first))
    second = outlines[j].mapped(poses.matrix(j)).region
    if container.lattice is not None:
        second = container.lattice.repeated(second, itself=i != j)
    shared = float(intersection(first, second).area)
    return Conflict(i, j, shared, distance(first, second))
