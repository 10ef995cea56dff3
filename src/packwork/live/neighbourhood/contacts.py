"""Contact graph of the items now: a gesture spreads along it."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels.broad_phase import pairs_of
from packwork.live.document import Document
from packwork.live.neighbourhood.caches import LevelCache
from packwork.scene.container import Container
from packwork.scene.pose import Poses

REACH = 0.6
"""Gap of two items that count as side by side at most, in radii of a disc as large as the usual
one. Larger stirs more items, smaller does not see across the gap that a gesture has left.
Chosen."""

RINGS = 3
"""Neighbours of neighbours that a gesture reaches: that make room, that grow into room which it has
left, and that a settle takes in where it fails. More share out what it takes and stir more items.
Tried."""


class ContactGraph:
    """Neighbours of items in their present places, found at a cost that follows what is asked."""

    def __init__(self, document: Document, levels: LevelCache) -> None:
        self._levels = levels
        poses = document.poses
        shapes = [item.outline for item in document.items]
        outlines = levels.covers(shapes, poses.stretch.tolist())
        container = document.container
        self._arrangement = Arrangement(
            outlines, container.outline, places_of(container, poses), container.lattice
        )
        self._document = document
        self.reach = _reach_of(document)

    def turned_to(self, document: Document) -> ContactGraph:
        """Neighbours in another document: these, brought up to date, where no shape is another."""
        before, now = self._document, places_of(document.container, document.poses)
        if (
            before.container is not document.container
            or len(before) != len(document)
            or any(
                one is not other for one, other in zip(before.items, document.items, strict=True)
            )
            or (before.poses.stretch != document.poses.stretch).any()
        ):
            return ContactGraph(document, self._levels)
        changed = np.flatnonzero((now != self._arrangement.places).any(axis=1))
        self._arrangement.put(changed, now[changed])
        self._document = document
        self.reach = _reach_of(document)
        return self

    def follow(self, items: IntArray, poses: Poses) -> None:
        """Take over where items ``(m,)`` are; ``poses``: of all."""
        self._arrangement.put(items, places_of(self._document.container, poses.subset(items)))

    def beside(self, items: IntArray) -> IntArray:
        """Items within reach of some items ``(m,)``, these among them, ascending."""
        reach = self.reach
        pairs = pairs_of(self._arrangement.board.boxes, items, reach)
        owners = self._arrangement.owners
        pairs = pairs[owners[pairs[:, 1]] < self._arrangement.count]
        near = pairs[self._arrangement.distances(pairs, reach) < reach] if len(pairs) else pairs
        return np.union1d(items, owners[near])

    def rings(self, sources: IntArray, most: int) -> IntArray:
        """``(n,)`` steps from the nearest of some items ``(m,)``; -1 beyond ``most``."""
        found = np.full(self._arrangement.count, -1, dtype=np.int64)
        found[sources] = 0
        front = inner = np.asarray(sources, dtype=np.int64)
        for ring in range(1, most + 1):
            if not len(front):
                break
            inner = np.union1d(inner, self.beside(front))
            front = inner[found[inner] < 0]
            found[front] = ring
        return found


def _reach_of(document: Document) -> float:
    areas = document.areas
    return REACH * float(np.sqrt(np.median(areas) / np.pi)) if len(areas) else 0.0


def others_near(poses: Poses, radii: FloatArray, items: IntArray, margin: float) -> IntArray:
    """Rows of others whose boxes are within a margin of the box about items ``(m,)``.

    ``radii``: ``(n,)``, canvas units as ``margin``, infinite for all others.

    Examples
    --------
    >>> row = Poses(np.array([0.0, 4.0, 9.0]), *np.ones((3, 3)))
    >>> others_near(row, np.ones(3), np.array([0]), 2.5).tolist()
    [1]
    """
    found = np.ones(len(poses), dtype=bool)
    for along in (poses.x, poses.y):
        low, high = along - radii, along + radii
        found &= high >= low[items].min(initial=np.inf) - margin
        found &= low <= high[items].max(initial=-np.inf) + margin
    found[items] = False
    return np.flatnonzero(found)


def places_of(container: Container, poses: Poses) -> FloatArray:
    """``(n, 4)`` x, y, turn and logarithm of growth of poses, from upright and scale 1."""
    poses = container.brought_in(poses)
    return np.column_stack([poses.x, poses.y, poses.angle, np.log(poses.scale)])
