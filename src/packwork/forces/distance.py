"""Distance fields of points, lines and curves, with unit vectors that lead away."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from packwork.arrays import FloatArray

AT_ONCE = 2**22
"""Products of points and pieces that are looked at together. Larger takes more memory for
no speed. Chosen."""

FEW_PIECES = 32
"""Pieces up to which all are looked at for each point. Larger is slower for many points, smaller
builds an index for nothing. Tried."""

NOWHERE = 1e-12
"""Distance below which there is no direction. Derived: far below any canvas' rounding."""


@dataclass(frozen=True, eq=False)
class Distance:
    """Distance from the nearest of some straight pieces; a point is a piece of no length.

    Parameters
    ----------
    begins, ends
        ``(m, 2)`` ends of the pieces, canvas units.

    Examples
    --------
    >>> line = Distance.from_line(np.array([[0.0, 0], [10, 0]]))
    >>> heights, slopes = line(np.array([[5.0, 3.0], [13.0, 4.0]]))
    >>> heights.tolist(), slopes.tolist()
    ([3.0, 5.0], [[0.0, 1.0], [0.6, 0.8]])
    """

    begins: FloatArray
    ends: FloatArray

    @classmethod
    def from_points(cls, points: FloatArray) -> Distance:
        """From the nearest of several points ``(m, 2)``."""
        return cls(points, points)

    @classmethod
    def from_line(cls, line: FloatArray) -> Distance:
        """From a line through points ``(m, 2)``."""
        return cls(line[:-1], line[1:])

    @property
    def is_point(self) -> bool:
        """Whether it is from one point."""
        return len(self.begins) == 1 and bool((self.begins == self.ends).all())

    def __call__(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Distances ``(n,)``, canvas units, and unit vectors ``(n, 2)`` that lead off, or zeros."""
        off = np.empty_like(points)
        step = max(AT_ONCE // min(max(len(self.begins), 1), FEW_PIECES), 1)
        for first in range(0, len(points), step):
            some = slice(first, first + step)
            off[some] = points[some] - self.nearest(points[some])
        heights = np.hypot(off[:, 0], off[:, 1])
        return heights, off / np.maximum(heights, NOWHERE)[:, None]

    def nearest(self, points: FloatArray) -> FloatArray:
        """``(n, 2)`` nearest point of the pieces to each point ``(n, 2)``, canvas units."""
        off = self._from_all(points) if len(self.begins) <= FEW_PIECES else self._from_near(points)
        return np.asarray(points - off)

    def _from_all(self, points: FloatArray) -> FloatArray:
        """``(n, 2)`` way from the nearest piece: all are looked at."""
        off = _ways(points[:, None], self.begins, self.ends)
        best = np.argmin((off**2).sum(axis=2), axis=1)
        return np.asarray(off[np.arange(len(points)), best])

    def _from_near(self, points: FloatArray) -> FloatArray:
        """The same by an index of the pieces."""
        best = self._tree.nearest(shapely.points(points))
        return _ways(points, self.begins[best], self.ends[best])

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree(shapely.linestrings(np.stack([self.begins, self.ends], axis=1)))


def _ways(points: FloatArray, begins: FloatArray, ends: FloatArray) -> FloatArray:
    """Ways ``(..., 2)`` to points from the nearest places of pieces."""
    along = ends - begins
    square = np.maximum((along**2).sum(axis=-1), NOWHERE**2)
    since = points - begins
    share = np.clip((since * along).sum(axis=-1) / square, 0.0, 1.0)
    return np.asarray(since - share[..., None] * along)
