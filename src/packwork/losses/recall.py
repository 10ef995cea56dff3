"""Recall: distance from the container of items whose centre lies outside it."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.fields.distance_transform import nearest_to
from packwork.losses import _kernels
from packwork.losses.term import PoseTerm


class Recall:
    """Distance of each item's centre from the container, weighted by the item's area.

    An item wholly outside sees the same adjoint all round and feels no force in image
    space; this object-space loss pulls it straight to the nearest part of the
    container, from anywhere on the canvas or off it.

    Parameters
    ----------
    container
        ``(rows, columns)`` coverage of the container at any resolution.

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
