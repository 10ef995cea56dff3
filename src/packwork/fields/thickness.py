"""Thickness of a region: what openings by discs of growing radius leave uncovered (granulometry).

G. Matheron, "Random Sets and Integral Geometry", Wiley 1975.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.fields.distance_transform import distance_to

STEPS = 20
"""Radii looked at, each the same factor larger than the last. More tell the thickness finer and
take longer. Chosen."""


@dataclass(frozen=True, eq=False)
class Thickness:
    """Morphological openings of a region by discs of several radii.

    Parameters
    ----------
    radii_px
        ``(m,)``, growing.
    missing
        ``(m,)`` share of the region that is farther than some reach from every place that a
        disc of that radius inside the region can cover; growing.
    """

    radii_px: FloatArray
    missing: FloatArray

    def radius_for(self, missing: float) -> float:
        """Largest radius whose discs leave no more than that share of the region unreached.

        Examples
        --------
        >>> Thickness(np.array([1.0, 2.0, 4.0]), np.array([0.0, 0.0, 0.4])).radius_for(0.2)
        2.8284271247461903
        """
        if self.missing[-1] <= missing:
            return float(self.radii_px[-1])
        after = int(np.argmax(self.missing > missing))
        if after == 0:
            return float(self.radii_px[0])
        low, high = self.missing[after - 1 : after + 1]
        share = (missing - low) / (high - low)
        near, far = self.radii_px[after - 1 : after + 1]
        return float(near * (far / near) ** share)

    def missing_for(self, radius_px: float) -> float:
        """Share of the region that discs of a radius leave unreached.

        Examples
        --------
        >>> Thickness(np.array([1.0, 2.0, 4.0]), np.array([0.0, 0.0, 0.4])).missing_for(4.0)
        0.4
        """
        return float(np.interp(np.log(radius_px), np.log(self.radii_px), self.missing))


def thickness(mask: BoolArray, reach_px: float) -> Thickness:
    """Thickness of a mask ``(rows, columns)`` that holds at least one pixel; lengths in pixels.

    Examples
    --------
    >>> bar = np.zeros((30, 60), dtype=bool)
    >>> bar[10:20, 5:55] = True
    >>> 4.4 < thickness(bar, 1.0).radius_for(0.1) < 5.5
    True
    """
    room = distance_to(np.pad(~mask, 1, constant_values=True))[1:-1, 1:-1] - 0.5
    radii = np.geomspace(0.5, max(float(room.max()), 1.0), STEPS)
    whole = int(np.count_nonzero(mask))
    away = [mask & (distance_to(room >= radius) > radius + reach_px) for radius in radii]
    missing = np.array([np.count_nonzero(left) / whole for left in away])
    return Thickness(radii, np.maximum.accumulate(missing))
