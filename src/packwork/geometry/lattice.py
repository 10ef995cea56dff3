"""Plane lattices: the translations by which what lies in one cell repeats over the plane."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.overlay import union
from packwork.geometry.polygon import Region

Repeat: TypeAlias = Literal["square", "half-drop"]
"""Ways in which a canvas repeats, as files state them."""

SQUARE: Final = "square"
HALF_DROP: Final = "half-drop"

Box = tuple[float, float, float, float]
"""Left, top, right, bottom."""


@dataclass(frozen=True)
class Lattice:
    """Lattice of columns of cells, each column let down by ``drop`` against the one before.

    The cell is a box with its corner at the origin; the basis is ``(width, drop), (0, height)``.
    A drop of half the height makes a half-drop; of cells as wide as the square root of 3/4 of
    their height, the hexagonal lattice.
    """

    width: float
    height: float
    drop: float = 0.0

    @classmethod
    def of_canvas(cls, width: float, height: float, kind: str) -> Lattice:
        """Lattice by which a canvas repeats: as one cell if ``square``, else as two columns.

        >>> Lattice.of_canvas(6.0, 4.0, "half-drop")
        Lattice(width=3.0, height=4.0, drop=2.0)
        """
        return cls(width, height) if kind == SQUARE else cls(width / 2, height, height / 2)

    @property
    def kind(self) -> Repeat:
        """``square`` or ``half-drop``."""
        return HALF_DROP if self.drop else SQUARE

    @property
    def cell(self) -> Box:
        """The box that tiles the plane."""
        return 0.0, 0.0, self.width, self.height

    def neighbours(self) -> FloatArray:
        """``(s, 2)`` translations to the cells about one; of dropped columns two cells far.

        >>> Lattice(4.0, 2.0).neighbours()[:3].tolist()
        [[-4.0, -2.0], [-4.0, 0.0], [-4.0, 2.0]]
        """
        # Two columns on lies what a narrow cell is as near to as to what lies above it.
        far = 2 if self.drop else 1
        steps = [(a, b) for a in range(-far, far + 1) for b in range(-2, 3) if a or b]
        found = np.array([(a * self.width, a * self.drop + b * self.height) for a, b in steps])
        return np.asarray(found[np.abs(found[:, 1]) <= 1.5 * self.height])

    def wrapped(self, points: FloatArray) -> FloatArray:
        """Points ``(n, 2)`` brought into the cell.

        >>> Lattice(4.0, 2.0, 1.0).wrapped(np.array([[5.0, 1.5], [1.0, -0.5]])).tolist()
        [[1.0, 0.5], [1.0, 1.5]]
        """
        column = np.floor(points[:, 0] / self.width)
        y = points[:, 1] - column * self.drop
        row = np.floor(y / self.height)
        return np.column_stack([points[:, 0] - column * self.width, y - row * self.height])

    def nearest(self, point: FloatArray, to: FloatArray) -> FloatArray:
        """Image of a point ``(2,)`` that is nearest to another one.

        >>> Lattice(4.0, 2.0).nearest(np.array([3.9, 1.0]), np.array([0.2, 1.0])).round(9).tolist()
        [-0.1, 1.0]
        """
        off = self.wrapped((point - to)[None])
        found = np.concatenate([off, off + self.neighbours()])
        return np.asarray(to + found[np.hypot(*found.T).argmin()])

    def repeated(self, region: Region, *, itself: bool = True) -> Region:
        """A region's images in the cells about it, together with itself or without.

        >>> Lattice(4.0, 4.0).repeated(shapely.box(0, 0, 2, 1)).area
        18.0
        """
        shifts = [*([(0.0, 0.0)] if itself else []), *self.neighbours()]
        return union(moved(region, shift) for shift in shifts)

    def meeting(self, bounds: Box, within: Box) -> FloatArray:
        """``(m, 2)`` translations that bring a box to where it meets another one.

        >>> Lattice(4.0, 4.0).meeting((3.0, 1.0, 5.0, 2.0), (0.0, 0.0, 4.0, 4.0)).tolist()
        [[-4.0, 0.0], [0.0, 0.0]]
        """
        found = []
        left, top, right, bottom = bounds
        for a in _between((within[0] - right) / self.width, (within[2] - left) / self.width):
            down = a * self.drop
            first = (within[1] - bottom - down) / self.height
            last = (within[3] - top - down) / self.height
            found += [(a * self.width, down + b * self.height) for b in _between(first, last)]
        return np.array(found).reshape(-1, 2)


def moved(region: Region, shift: tuple[float, float] | FloatArray) -> Region:
    """A region, translated."""
    return shapely.transform(region, lambda points: points + shift)


def _between(low: float, high: float) -> range:
    return range(math.ceil(low), math.floor(high) + 1)
