"""Fading: a distance field whose pull decays exponentially with the distance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray
from packwork.forces.field import Field


@dataclass(frozen=True, eq=False)
class Fading:
    """A distance that counts less and less: its slope falls by e within each reach.

    Parameters
    ----------
    field
        A distance; of a direction, which has no place, nothing fades.
    reach
        Canvas units.

    Examples
    --------
    >>> from packwork.forces.distance import Distance
    >>> near = Fading(Distance.from_points(np.zeros((1, 2))), 2.0)
    >>> heights, slopes = near(np.array([[2.0, 0.0]]))
    >>> heights.round(3).tolist(), slopes.round(3).tolist()
    ([1.264], [[0.368, 0.0]])
    """

    field: Field
    reach: float

    def __call__(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Faded heights ``(n,)``, canvas units, and slopes ``(n, 2)``."""
        heights, slopes = self.field(points)
        left = np.exp(-heights / self.reach)
        return self.reach * (1 - left), slopes * left[:, None]
