"""Inward force: distance from the container, for what is outside."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.forces.distance import Distance
from packwork.geometry.outline import Outline


@dataclass(frozen=True, eq=False)
class Inward:
    """Distance from the container; none inside.

    Parameters
    ----------
    outline
        Of the container, canvas units.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])])
    >>> heights, slopes = Inward(tile)(np.array([[1.0, 1.0], [6.0, 2.0]]))
    >>> heights.tolist(), slopes.tolist()
    ([0.0, 2.0], [[0.0, 0.0], [1.0, 0.0]])
    """

    outline: Outline

    def __call__(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Distances ``(n,)``, canvas units, 0 inside, and unit vectors ``(n, 2)`` that lead off."""
        begins = np.concatenate(self.outline.rings)
        ends = np.concatenate([np.roll(ring, -1, axis=0) for ring in self.outline.rings])
        heights, slopes = np.zeros(len(points)), np.zeros((len(points), 2))
        outside = ~shapely.contains_xy(self.outline.region, points[:, 0], points[:, 1])
        heights[outside], slopes[outside] = Distance(begins, ends)(points[outside])
        return heights, slopes
