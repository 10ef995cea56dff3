"""Shrinking of single items out of conflicts, where all others stay: fillers and pinned items."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import FINE, Conflict, Detail, find_conflicts
from packwork.compaction.kernels import broad_phase, steps
from packwork.compaction.options import HAIR
from packwork.compaction.separate import CUT, MOST_CHECKS
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference
from packwork.scene.container import Container
from packwork.scene.pose import Limits, Poses

FILLER_CUT, FILLER_CHECKS = 0.04, 20
"""Logarithm of size that a filler in conflict loses at a time, and how often. A smaller
cut wastes less of its void and takes more checks. Tried."""


def admit_fillers(
    container: Container,
    outlines: Sequence[Outline],
    poses: Poses,
    fillers: int,
    gap_cu: float,
) -> tuple[IntArray, Poses]:
    """``(m,)`` indices of the items that stay, and their poses: no two of them in conflict.

    The last ``fillers`` items shrink until they are free of all others, or are left out; all
    others, which have no conflicts, stay as they are. A hair is added to the gap, as in the finish.

    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = Container("", "", box.mapped(np.array([[5.0, 0, 5], [0, 5.0, 5]])), 10, 10)
    >>> poses = Poses(
    ...     np.array([3.0, 7.9, 3.2]), np.full(3, 5.0), np.zeros(3), np.array([2.8, 2.4, 0.1])
    ... )
    >>> kept, stay = admit_fillers(wall, [box] * 3, poses, 2, 0.0)
    >>> kept.tolist(), bool(2 < stay.scale[1] < 2.1)
    ([0, 1], True)
    """
    gap = gap_cu + HAIR * container.side
    covers = Detail(outlines, container.outline, poses).covers(FINE)
    zero = np.zeros(len(poses))
    arrangement = covers.arrangement(np.column_stack([poses.x, poses.y, zero, zero]))
    last = np.arange(len(poses) - fillers, len(poses))
    pairs = broad_phase.pairs_of(arrangement.board.boxes, last, gap)
    steps.clear_by_shrinking(arrangement.board, last, pairs, gap, FILLER_CUT, FILLER_CHECKS)
    stuck = np.unique(arrangement.conflicts(arrangement.pairs(gap), gap))
    stay = np.setdiff1d(np.arange(len(poses)), np.intersect1d(stuck, last))
    shrunk = replace(poses, scale=poses.scale * np.exp(arrangement.places[:, 3]))
    return stay, shrunk.subset(stay)


def separate_pinned(
    container: Container,
    outlines: Sequence[Outline],
    poses: Poses,
    limits: Limits,
    items: IntArray,
    gap: float,
) -> Poses:
    """Poses in which some items, without the others, are no nearer than ``gap``, if that can be.

    Those in conflict, with the container's edge too, shrink as far as they may, and move along the
    line that they are pinned to, if it is one.

    >>> from packwork.geometry.affine import similarity
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = Container("", "", tile.mapped(similarity(5, 5, 0.0, 5)), 10, 10)
    >>> two = Poses(np.array([4.0, 5.9]), np.full(2, 5.0), np.zeros(2), np.ones(2))
    >>> limits = replace(
    ...     Limits.free(2), x=two.x, y=two.y, smallest=np.array([0.1, 1.0]), largest=np.ones(2)
    ... )
    >>> free = separate_pinned(wall, [tile] * 2, two, limits, np.arange(2), 0.1)
    >>> bool(free.scale[0] < 0.81), float(free.scale[1]), free.x.tolist()
    (True, 1.0, [4.0, 5.9])
    """
    own = [outlines[k] for k in items]
    extents = np.array([outline.extent for outline in own])
    some = poses.subset(items)
    held, smallest = limits.held[items], limits.smallest[items]
    for _ in range(MOST_CHECKS):
        found = find_conflicts(container, own, some, gap)
        bad = np.unique([k for one in found for k in (one.item, one.other) if k is not None])
        bad = bad.astype(np.int64)
        shrinking = bad[some.scale[bad] > smallest[bad]]
        away = _away(container, own, some, found) * ~held[:, :2]
        if len(shrinking) == 0 and not away.any():
            break
        step = CUT * (extents * some.scale)[:, None] * away
        scale = some.scale.copy()
        scale[shrinking] = np.maximum(scale[shrinking] * (1 - CUT), smallest[shrinking])
        some = replace(some, x=some.x + step[:, 0], y=some.y + step[:, 1], scale=scale)
    return poses.with_some(items, some)


def _away(
    container: Container, outlines: Sequence[Outline], poses: Poses, found: Sequence[Conflict]
) -> FloatArray:
    """``(n, 2)`` which way along x and y leads out of conflicts: -1, 0 or 1 each."""
    push = np.zeros((len(poses), 2))
    for one in found:
        i, j = one.item, one.other
        here = np.array([poses.x[i], poses.y[i]])
        if j is not None:
            apart = here - (poses.x[j], poses.y[j])
            push[i] += apart
            push[j] -= apart
            continue
        region = outlines[i].mapped(poses.matrix(i)).region
        outside = difference(region, container.outline.region)
        if outside.area > 0:
            push[i] += here - shapely.get_coordinates(outside.centroid)[0]
    return np.sign(push)
