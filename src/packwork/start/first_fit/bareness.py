"""Distance of a container's pixels from what lies in it."""

from __future__ import annotations

import math

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.fields.distance_transform import distance_to

LEAST = 0.02
"""Share of the container that may be bare. Larger leaves limbs bare, smaller sees to single pixels
while larger gaps stay. Tried."""


class Bareness:
    """Bare places of a container: farther from every item than a reader takes for filled.

    Parameters
    ----------
    free
        ``(rows, columns)`` the pixels that may be taken.
    far_px
        Distance from which on a pixel is bare.

    Examples
    --------
    >>> bare = Bareness(np.ones((1, 9), dtype=bool), 3.0)
    >>> bare.cover(np.ones((1, 2), dtype=bool), 0, 0)
    >>> bare.away().tolist()
    [[0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]]
    >>> bare.cover(np.ones((1, 1), dtype=bool), 0, 7)
    >>> bare.away() is None
    True
    """

    def __init__(self, free: BoolArray, far_px: float) -> None:
        self._free, self._far = free, far_px
        self._least = LEAST * np.count_nonzero(free)
        self._covered: BoolArray = np.zeros(free.shape, dtype=bool)
        self._away: FloatArray | None = None
        self._farthest: FloatArray = np.zeros(len(free))  # of each row: most rows stay as they are
        self._is_filled = False

    def emptied(self) -> Bareness:
        """The same before anything was put there."""
        return Bareness(self._free, self._far)

    def away(self) -> FloatArray | None:
        """Pixels from each free pixel to the nearest item; None where nothing draws items."""
        if self._is_filled or not self._covered.any():
            return None
        if self._away is None:
            self._away = np.where(self._free, distance_to(self._covered), 0.0)
            self._farthest = self._away.max(axis=1)
        self._is_filled = not np.count_nonzero(self._away > self._far) > self._least
        return None if self._is_filled else self._away

    def cover(self, mask: BoolArray, row: int, column: int) -> None:
        """Note pixels of an item; what of them lies off the image is not kept."""
        top, left = max(row, 0), max(column, 0)
        inner = mask[top - row :, left - column :]
        seen = self._covered[top:, left:][: inner.shape[0], : inner.shape[1]]
        seen |= inner[: seen.shape[0], : seen.shape[1]]
        if self._away is not None and seen.size:
            self._lessen(self._away, top, left, inner[: seen.shape[0], : seen.shape[1]])

    def _lessen(self, away: FloatArray, top: int, left: int, item: BoolArray) -> None:
        """Distances round an item that was put there."""
        reach = math.ceil(float(self._farthest.max()))
        above, before = min(top, reach), min(left, reach)
        rows = slice(top - above, top + item.shape[0] + reach)
        window = away[rows, left - before : left + item.shape[1] + reach]
        shown = np.zeros(window.shape, dtype=bool)
        shown[above : above + item.shape[0], before : before + item.shape[1]] = item
        np.minimum(window, distance_to(shown), out=window)
        self._farthest[rows] = away[rows].max(axis=1)
