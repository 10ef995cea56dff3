"""Protocols of forces: a height over the canvas (field), or one of a whole group (bond)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from packwork.arrays import FloatArray, IntArray


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

    Parameters
    ----------
    points
        ``(n, 2)`` where their centroids lie, canvas units.
    areas
        ``(n,)`` how much each counts.
    kinds
        ``(n,)`` items of one number are copies of one thing.
    side
        Longer side of the canvas.
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
