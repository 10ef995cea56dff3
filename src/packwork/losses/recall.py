"""Items whose centre lies outside the container are called back."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from packwork.arrays import FloatArray, Image
from packwork.losses.term import PoseTerm


class Recall:
    """Distance of each item's centre from the container, weighted by the item's area.

    An item wholly outside sees the same adjoint all round and feels no force in image
    space; this object-space loss pulls it straight to the nearest part of the
    container, from anywhere on the canvas or off it.

    Parameters
    ----------
    container
        Coverage of the container at any resolution.
    px_per_cu
        Pixels of that image per canvas unit.

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
        _, nearest = ndimage.distance_transform_edt(~inside, return_indices=True)
        self._nearest_row, self._nearest_column = nearest
        self._inside = inside
        self._px_per_cu = px_per_cu

    def __call__(self, x: FloatArray, y: FloatArray, areas: FloatArray) -> PoseTerm:
        """Loss for centres ``(n,)`` in canvas units and areas in squared ones."""
        rows, columns = self._inside.shape
        x_px, y_px = x * self._px_per_cu, y * self._px_per_cu
        column = np.clip(x_px, 0, columns - 1).astype(np.int64)
        row = np.clip(y_px, 0, rows - 1).astype(np.int64)
        on_canvas = (x_px >= 0) & (x_px < columns) & (y_px >= 0) & (y_px < rows)
        home = on_canvas & self._inside[row, column]
        away_x = np.where(home, 0.0, x_px - self._nearest_column[row, column] - 0.5)
        away_y = np.where(home, 0.0, y_px - self._nearest_row[row, column] - 0.5)
        distance = np.hypot(away_x, away_y)
        safe = np.where(distance > 0, distance, 1.0)
        return PoseTerm(
            float(np.sum(areas * distance) / self._px_per_cu),
            areas * away_x / safe,
            areas * away_y / safe,
        )
