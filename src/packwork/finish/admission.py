"""Insertion of fillers into a clean layout: shrunk until they fit, or left out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from packwork.arrays import IntArray
from packwork.compaction.detail import FINE, Detail
from packwork.compaction.kernels import distances, steps
from packwork.compaction.options import HAIR
from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.pose import Poses

CUT, CHECKS = 0.04, 20
"""Logarithm of size that a filler in conflict loses at a time, and how often. A smaller
cut wastes less of its void and takes more checks. Tried."""


def admitted(
    container: Container,
    outlines: Sequence[Outline],
    poses: Poses,
    fillers: int,
    gap_cu: float,
) -> tuple[IntArray, Poses]:
    """``(m,)`` indices of the items that stay, and their poses: no two of them in conflict.

    The last ``fillers`` items shrink until they are free of all others; those that do
    not come free are left out. All others stay as they are.

    Parameters
    ----------
    outlines
        One per item, item units.
    poses
        Of all items; without the fillers they have no conflicts.
    gap_cu
        Gap between items and to the container's edge; a hair is added, as in the finish.

    Examples
    --------
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = Container("", "", box.mapped(np.array([[5.0, 0, 5], [0, 5.0, 5]])), 10, 10)
    >>> poses = Poses(
    ...     np.array([3.0, 7.9, 3.2]), np.full(3, 5.0), np.zeros(3), np.array([2.8, 2.4, 0.1])
    ... )
    >>> kept, stay = admitted(wall, [box] * 3, poses, 2, 0.0)
    >>> kept.tolist(), bool(2 < stay.scale[1] < 2.1)
    ([0, 1], True)
    """
    gap = gap_cu + HAIR * container.side
    covers = Detail(outlines, container.outline, poses).covers(FINE)
    zero = np.zeros(len(poses))
    arrangement = covers.arrangement(np.column_stack([poses.x, poses.y, zero, zero]))
    last = np.arange(len(poses) - fillers, len(poses))
    pairs = distances.pairs_of(arrangement.board.boxes, last, gap)
    steps.clear_by_shrinking(arrangement.board, last, pairs, gap, CUT, CHECKS)
    stuck = np.unique(arrangement.conflicts(arrangement.pairs(gap), gap))
    stay = np.setdiff1d(np.arange(len(poses)), np.intersect1d(stuck, last))
    shrunk = replace(poses, scale=poses.scale * np.exp(arrangement.places[:, 3]))
    return stay, shrunk.subset(stay)
