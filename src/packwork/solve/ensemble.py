"""All items' outlines as one array of points, at one level of detail."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.outline import Outline, joined
from packwork.scene.pose import Poses
from packwork.solve import _kernels


class Ensemble:
    """Points of all items, placed by poses, and gradients gathered back to poses.

    Parameters
    ----------
    outlines
        One per item, in item units, origin at the item's centroid; copies may repeat
        one object.

    Examples
    --------
    >>> square = Outline.from_rings([np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]])])
    >>> two = Ensemble([square, square])
    >>> one = np.ones(2)
    >>> two.place(Poses(np.array([1.0, 4.0]), one, 0 * one, one), 10.0)[[0, 4]].tolist()
    [[0.0, 0.0], [30.0, 0.0]]
    """

    def __init__(self, outlines: Sequence[Outline]) -> None:
        self._own, self.ring_starts = joined(outlines)
        counts = [len(o.points) for o in outlines]
        self._item_starts: IntArray = np.cumsum([0, *counts], dtype=np.int64)
        self._rings_before: IntArray = np.cumsum([0] + [len(o.rings) for o in outlines])[:-1]
        self._points = np.empty_like(self._own)
        self._by_pose = np.zeros((len(outlines), 5))

    def place(self, poses: Poses, px_per_cu: float) -> FloatArray:
        """Points in pixels, ``(n, 2)``; a buffer that the next call reuses."""
        _kernels.place(
            self._own, self._item_starts, poses.x, poses.y, poses.angle, poses.scale,
            poses.stretch, px_per_cu, self._points,
        )  # fmt: skip
        return self._points

    def gather(self, gradient: FloatArray, poses: Poses, px_per_cu: float) -> FloatArray:
        """Pose gradients from the gradients of the points last placed.

        Returns
        -------
        FloatArray
            ``(items, 5)``: by x and y (per canvas unit), angle (rad), log scale and log
            stretch; a buffer that the next call reuses.
        """
        _kernels.gather(
            self._points, gradient, self._item_starts, poses.x, poses.y, poses.angle,
            px_per_cu, self._by_pose,
        )  # fmt: skip
        return self._by_pose

    def per_item(self, per_ring: FloatArray) -> FloatArray:
        """Sums ``(items,)`` of numbers ``(rings,)`` over each item's rings, in their unit."""
        return np.asarray(np.add.reduceat(per_ring, self._rings_before))

    def per_ring(self, per_item: FloatArray) -> FloatArray:
        """Rows ``(rings, m)``, each ring's its item's, of ``(items, m)``."""
        counts = np.diff(np.append(self._rings_before, len(self.ring_starts) - 1))
        return np.repeat(per_item, counts, axis=0)
