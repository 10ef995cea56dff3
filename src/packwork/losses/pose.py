"""Object-space losses: values of poses, with no image between."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.fields.distance_transform import nearest_to
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


def area_shares(placed: PosedItems) -> PoseTerm:
    """Variance of the logarithm of area over area asked for.

    Zero when all items are larger or smaller than asked by one common factor. For free
    sizes: a soft form of what shared sizes hold exactly. An object-space loss; its value
    is dimensionless.

    Examples
    --------
    >>> from packwork.scene.pose import Poses
    >>> zero = np.zeros(2)
    >>> poses = Poses(zero, zero, zero, np.array([1.0, np.e]))
    >>> term = area_shares(PosedItems(poses, np.ones(2), np.ones(2)))
    >>> term.value, term.log_scale.tolist()
    (1.0, [-2.0, 2.0])
    """
    growth = 2 * np.log(placed.poses.scale / placed.nominal)
    deviation = growth - growth.mean()
    zero = np.zeros_like(deviation)
    return PoseTerm(
        float(np.mean(deviation**2)), zero, zero, log_scale=4 * deviation / len(deviation)
    )


class Recall:
    """Distance of each item's centre from the container, weighted by the item's area.

    An item wholly outside sees the same adjoint all round and feels no force in image
    space; this object-space loss pulls it straight to the nearest part of the
    container, from anywhere on the canvas or off it.

    ``container``: ``(rows, columns)`` coverage of the container at any resolution.

    Examples
    --------
    >>> recall = Recall(np.array([[1.0, 0.0, 0.0]]), 1.0)
    >>> term = recall(np.array([0.5, 2.5]), np.array([0.5, 0.5]), np.ones(2))
    >>> term.value, term.x.tolist()
    (2.0, [0.0, 1.0])
    """

    def __init__(self, container: Image, px_per_cu: float) -> None:
        inside = container > 0.5
        if not inside.any():
            # Thinner than half a pixel everywhere: its thickest parts stand for it.
            inside = container >= container.max() / 2
        self._nearest_row, self._nearest_column = nearest_to(inside)
        self._inside = inside
        self._px_per_cu = px_per_cu

    def __call__(self, x: FloatArray, y: FloatArray, areas: FloatArray) -> PoseTerm:
        """Loss for centres ``(n,)`` in canvas units and areas in squared ones."""
        by_x, by_y = np.empty_like(x), np.empty_like(y)
        total = _kernels.recall(
            x, y, areas, self._px_per_cu, self._inside, self._nearest_row, self._nearest_column,
            by_x, by_y,
        )  # fmt: skip
        return PoseTerm(total / self._px_per_cu, by_x, by_y)
