"""Uniform field: the same pull everywhere, as gravity."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray


@dataclass(frozen=True)
class Direction:
    """Height that falls evenly along one direction.

    Parameters
    ----------
    angle
        Where things fall to, radians, clockwise on screen from the right: down is pi / 2.

    Examples
    --------
    >>> heights, slopes = Direction(math.pi / 2)(np.array([[3.0, 4.0]]))
    >>> heights.tolist(), slopes.round(9).tolist()
    ([-4.0], [[-0.0, -1.0]])
    """

    angle: float

    @property
    def way(self) -> FloatArray:
        """Unit vector ``(2,)``."""
        return np.array([math.cos(self.angle), math.sin(self.angle)])

    def __call__(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Heights ``(n,)``, canvas units: minus the way along it; and slopes ``(n, 2)``."""
        return -points @ self.way, np.tile(-self.way, (len(points), 1))
