"""Conflicts of a layout: pairs that overlap or are too near, by the true outlines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import IntArray
from packwork.compaction.detail import Detail
from packwork.geometry.distance import distance
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference, intersection, part_about
from packwork.scene.container import Container
from packwork.scene.pose import Poses

ROUNDING = 1e-9
"""Share of the gap that rounding may take. Derived: coordinates are good to 1e-16 of the
canvas, the smallest gap is 1e-5 of it."""


@dataclass(frozen=True)
class Conflict:
    """An item in conflict with another one, or with the container if ``other`` is None.

    Parameters
    ----------
    overlap_cu2
        Area that they share, or that lies outside the container.
    gap_cu
        Their distance if they share none.
    """

    item: int
    other: int | None
    overlap_cu2: float
    gap_cu: float

    def numbered(self, items: IntArray) -> Conflict:
        """The same where items are called by the numbers ``(n,)`` given."""
        other = None if self.other is None else int(items[self.other])
        return replace(self, item=int(items[self.item]), other=other)


def find_conflicts(
    container: Container, outlines: Sequence[Outline], poses: Poses, gap: float
) -> tuple[Conflict, ...]:
    """Pairs nearer than ``gap``, and items nearer to the container's edge or beyond it.

    Examples
    --------
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[5.0, 0, 5], [0, 5.0, 5]]))
    >>> poses = Poses(np.array([4.0, 5.5]), np.full(2, 5.0), np.zeros(2), np.ones(2))
    >>> found = find_conflicts(Container("", "", wall, 10, 10), [box] * 2, poses, 0.1)
    >>> [(o.item, o.other, o.overlap_cu2) for o in found]
    [(0, 1, 1.0)]
    """
    if len(outlines) == 0:
        return ()
    zero = np.zeros(len(poses))
    places = np.column_stack([poses.x, poses.y, zero, zero])
    arrangement = Detail(outlines, container.outline, poses).arrangement(places)
    bad = arrangement.conflicts(arrangement.pairs(gap), gap * (1 - ROUNDING))
    return tuple(_conflict(container, outlines, poses, int(i), int(j), gap) for i, j in bad)


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
    shared = float(intersection(first, second).area)
    return Conflict(i, j, shared, distance(first, second))
