"""Clearance: radius of the largest empty circle about each pixel, kept as discs are placed.

From a Euclidean distance transform; after each disc only a window round it is updated.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.fields.distance_transform import distance_to


def distance_inside(mask: BoolArray) -> FloatArray:
    """Distance ``(rows, columns)`` of each True pixel's centre from the mask's edge, px; 0 outside.

    What lies off the image counts as outside.

    Examples
    --------
    >>> distance_inside(np.ones((3, 3), dtype=bool)).tolist()[1]
    [0.5, 1.5, 0.5]
    """
    padded = np.pad(mask, 1)
    distance = distance_to(~padded)[1:-1, 1:-1]
    return np.asarray(np.maximum(distance - 0.5, 0.0))


class Clearance:
    """Radius of the largest free disc about each pixel's centre.

    Parameters
    ----------
    free
        ``(rows, columns)``, True where there is room.

    Examples
    --------
    >>> room = Clearance(np.ones((9, 9), dtype=bool))
    >>> room.largest()
    (4.5, 4.5, 4.5)
    >>> room.occupy(4.5, 4.5, 3.0)
    >>> room.largest()[2] < 4.5
    True
    """

    def __init__(self, free: BoolArray) -> None:
        self._free = free
        self._radius = distance_inside(free)
        self._radius[~free] = -np.inf
        self._largest: tuple[float, float, float] | None = None

    def largest(self) -> tuple[float, float, float]:
        """Pixel coordinates ``(x, y)`` of the roomiest place and its radius (may be < 0)."""
        if self._largest is None:
            row, column = divmod(int(np.argmax(self._radius)), self._radius.shape[1])
            self._largest = column + 0.5, row + 0.5, float(self._radius[row, column])
        return self._largest

    def largest_among(self, pixels: IntArray) -> tuple[float, float, float]:
        """Like :meth:`largest`, of some pixels only.

        Parameters
        ----------
        pixels
            ``(n,)``, n > 0: ``row * columns + column`` of each.

        Examples
        --------
        >>> Clearance(np.ones((3, 9), dtype=bool)).largest_among(np.array([9, 10]))
        (1.5, 1.5, 1.5)
        """
        radii = self._radius.ravel()[pixels]
        best = int(np.argmax(radii))
        row, column = divmod(int(pixels[best]), self._radius.shape[1])
        return column + 0.5, row + 0.5, float(radii[best])

    def occupy(self, x: float, y: float, radius: float) -> None:
        """Take a disc away; only the pixels it can concern are looked at."""
        room = max(self.largest()[2], 0.0)
        reach = radius + room + 1
        rows, columns = self._radius.shape
        top, bottom = max(int(y - reach), 0), min(int(y + reach) + 1, rows)
        left, right = max(int(x - reach), 0), min(int(x + reach) + 1, columns)
        if top >= bottom or left >= right:
            return
        away = np.hypot(
            np.arange(left, right)[None, :] + 0.5 - x, np.arange(top, bottom)[:, None] + 0.5 - y
        )
        window = self._radius[top:bottom, left:right]
        np.minimum(window, away - radius, out=window)
        self._largest = None
