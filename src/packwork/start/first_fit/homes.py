"""Homes: places near which items that are put one by one had better lie."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import BoolArray, FloatArray


@dataclass(frozen=True, eq=False)
class Homes:
    """Points near which items had better lie.

    Parameters
    ----------
    points
        ``(n, 2)``, canvas units.
    pull
        ``(n,)`` score that an item gives for lying the canvas' side nearer to its own.
    is_first
        ``(n,)`` whether it is put before all that are not, however small it is.
    """

    points: FloatArray
    pull: FloatArray
    is_first: BoolArray

    @classmethod
    def of(cls, points: FloatArray, pull: float) -> Homes:
        """Points that all items are drawn to alike."""
        return cls(points, np.full(len(points), pull), np.zeros(len(points), dtype=bool))
