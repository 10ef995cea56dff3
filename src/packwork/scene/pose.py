"""Where items are: translations, turns and scales."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.arrays import FloatArray
from packwork.geometry import affine


@dataclass(frozen=True, eq=False)
class Poses:
    """Poses of n items, one array per parameter.

    Parameters
    ----------
    x, y
        ``(n,)`` canvas units: where the item's origin (its centroid) lies.
    angle
        ``(n,)`` radians, clockwise on screen.
    scale
        ``(n,)`` canvas units per item unit, positive.
    """

    x: FloatArray
    y: FloatArray
    angle: FloatArray
    scale: FloatArray

    def __len__(self) -> int:
        return len(self.x)

    def matrix(self, k: int) -> FloatArray:
        """2 x 3 map from the units of item ``k`` to canvas units.

        Examples
        --------
        >>> import numpy as np
        >>> one = np.ones(1)
        >>> Poses(2 * one, 3 * one, 0 * one, one).matrix(0)[:, 2].tolist()
        [2.0, 3.0]
        """
        return affine.similarity(
            float(self.x[k]), float(self.y[k]), float(self.angle[k]), float(self.scale[k])
        )
