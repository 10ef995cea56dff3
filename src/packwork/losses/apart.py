"""Repulsion of items of one kind."""

from __future__ import annotations

import numpy as np

from packwork.losses import _kernels
from packwork.losses.term import PosedItems, PoseTerm

REACH = 1.5
"""Distance from which two items of a kind do not feel each other, in sums of the radii of
discs as large as they are asked to be: another item lies between them then. Larger ones
spread kinds over the container and let them yield less to their neighbours. Tried."""


def apart(placed: PosedItems) -> PoseTerm:
    """Sum over near pairs of one kind of (1 - distance / reach)², per item.

    Nothing if no kinds are given. An object-space loss; its value is dimensionless, and
    does not depend on how large the items have grown.

    Examples
    --------
    >>> from packwork.scene.pose import Poses
    >>> zero, one = np.zeros(2), np.ones(2)
    >>> poses = Poses(np.array([0.0, 1.5]), zero, zero, one)
    >>> term = apart(PosedItems(poses, np.pi * one, one, kinds=np.zeros(2, dtype=np.int64)))
    >>> term.value, term.x.tolist()
    (0.125, [0.16666666666666666, -0.16666666666666666])
    """
    poses = placed.poses
    by_x, by_y = np.zeros(len(poses)), np.zeros(len(poses))
    if placed.kinds is None or len(poses) == 0:
        return PoseTerm(0.0, by_x, by_y)
    order = np.argsort(placed.kinds, kind="stable")
    reach = REACH * placed.nominal * np.sqrt(placed.areas / np.pi)
    total = _kernels.repel(poses.x, poses.y, placed.kinds, order, reach, by_x, by_y)
    by_x /= len(poses)
    by_y /= len(poses)
    return PoseTerm(total / len(poses), by_x, by_y)
