"""Separation of pinned items, which compaction may not move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.conflicts import Conflict, find_conflicts
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference
from packwork.scene.container import Container
from packwork.scene.limits import Limits
from packwork.scene.pose import Poses

CUT = 0.996
"""Factor on the scale of an item in conflict, again and again. Larger takes longer,
smaller gives room away. As in the finish."""

STEP = 0.004
"""Move of an item in conflict that has a line to move on, as a share of its extent. As
above."""

MOST_ROUNDS = 400
"""Times at most: by then items are a fifth of what they were. Chosen."""


def separate_pinned(
    container: Container,
    outlines: Sequence[Outline],
    poses: Poses,
    limits: Limits,
    items: IntArray,
    gap: float,
) -> Poses:
    """Poses in which some items, without the others, are no nearer than ``gap``, if that can be.

    Those in conflict shrink as far as they may, and move along the line that they are
    pinned to, if it is one.

    Parameters
    ----------
    container
        Whose edge counts as well.

    Examples
    --------
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
    for _ in range(MOST_ROUNDS):
        found = find_conflicts(container, own, some, gap)
        bad = np.unique([k for one in found for k in (one.item, one.other) if k is not None])
        bad = bad.astype(np.int64)
        shrinking = bad[some.scale[bad] > smallest[bad]]
        away = _away(container, own, some, found) * ~held[:, :2]
        if len(shrinking) == 0 and not away.any():
            break
        step = STEP * (extents * some.scale)[:, None] * away
        scale = some.scale.copy()
        scale[shrinking] = np.maximum(scale[shrinking] * CUT, smallest[shrinking])
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
