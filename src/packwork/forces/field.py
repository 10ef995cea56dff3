"""Fields of force: a height at each point of the plane, which what stands there slides down.

Also the protocols of forces: of fields, and of bonds between the items of a group.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import prepared


class Field(Protocol):
    """A height at each point of the plane; what stands on it slides down.

    Heights and slopes are such that one unit of way is worth one unit of height at most.
    """

    def __call__(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Heights ``(n,)``, canvas units, and slopes ``(n, 2)`` at points ``(n, 2)``."""
        ...


@dataclass(frozen=True, eq=False)
class ItemGroup:
    """Items that belong together, as a force sees them.

    ``points``: ``(n, 2)`` where their centroids lie, canvas units.
    ``areas``: ``(n,)`` how much each counts.
    ``kinds``: ``(n,)`` items of one number are copies of one thing.
    ``side``: longer side of the canvas.
    """

    points: FloatArray
    areas: FloatArray
    kinds: IntArray
    side: float


class Bond(Protocol):
    """A height of a group of items, which depends on where the others are."""

    def __call__(self, group: ItemGroup) -> tuple[FloatArray, FloatArray]:
        """Each item's part of the height ``(n,)``, area times canvas units, and slopes.

        Slopes ``(n, 2)`` are those of the sum of all parts.
        """
        ...

    def changes(self, group: ItemGroup, places: FloatArray) -> FloatArray:
        """Change of the height if one item lay elsewhere and the others as they do.

        ``(n, m)``, area times canvas units: item by item for each of the places ``(m, 2)``.
        """
        ...

    def alone(self, points: FloatArray, anchor: FloatArray, side: float) -> FloatArray:
        """``(m,)`` heights at points of an item whose others all lie about ``anchor``."""
        ...


@dataclass(frozen=True)
class Direction:
    """Height that falls evenly along one direction.

    ``angle``: where things fall to, radians, clockwise on screen from the right: down is pi / 2.

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

    ``begins``, ``ends``: ``(m, 2)`` ends of the pieces, canvas units.

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


@dataclass(frozen=True, eq=False)
class Fading:
    """A distance that counts less and less: its slope falls by e within each reach.

    ``field``: a distance; of a direction, which has no place, nothing fades.
    ``reach``: canvas units.

    Examples
    --------
    >>> from packwork.forces.field import Distance
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


@dataclass(frozen=True, eq=False)
class Inward:
    """Distance from the container; none inside.

    ``outline``: of the container, canvas units.

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
        outside = ~shapely.contains_xy(prepared(self.outline.region), *points.T)
        heights[outside], slopes[outside] = Distance(begins, ends)(points[outside])
        return heights, slopes
