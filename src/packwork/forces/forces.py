"""All forces of a run together: which items each acts on, and how strongly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.forces.field import Bond, Field, Group


@dataclass(frozen=True, eq=False)
class Pull:
    """Height of n items and its slope.

    Parameters
    ----------
    parts
        ``(n,)`` each item's part of the height, area times canvas units.
    slopes
        ``(n, 2)`` derivatives of the whole by x and y, squared canvas units.
    """

    parts: FloatArray
    slopes: FloatArray

    @property
    def value(self) -> float:
        """The whole height."""
        return float(self.parts.sum())


@dataclass(frozen=True, eq=False)
class FieldForce:
    """A field that acts on some items.

    Parameters
    ----------
    field
        The height.
    strengths
        ``(n,)`` one per item of the run: 0 for those that it does not act on, negative
        for those that it pushes off.
    """

    field: Field
    strengths: FloatArray


@dataclass(frozen=True, eq=False)
class BondForce:
    """A bond between some items.

    Parameters
    ----------
    bond
        The height of the group.
    strengths
        As of a field; items of strength 0 are no part of the group.
    """

    bond: Bond
    strengths: FloatArray


@dataclass(frozen=True, eq=False)
class Forces:
    """Object-space losses that act on items by where they are.

    An item's part is its area times its height: large ones press harder, as under gravity.

    Parameters
    ----------
    fields, bonds
        Those that act.
    kinds
        ``(n,)`` items of one number are copies of one thing.
    side
        Longer side of the canvas.

    Examples
    --------
    >>> from packwork.forces.direction import Direction
    >>> down = FieldForce(Direction(np.pi / 2), np.array([1.0, 2.0]))
    >>> forces = Forces([down], [], np.zeros(2, int), 10.0)
    >>> pull = forces(np.array([[1.0, 3], [2, 4]]), np.array([1.0, 1.0]))
    >>> pull.value, pull.slopes.round(9).tolist()
    (-11.0, [[-0.0, -1.0], [-0.0, -2.0]])
    """

    fields: Sequence[FieldForce]
    bonds: Sequence[BondForce]
    kinds: IntArray
    side: float

    def __call__(self, points: FloatArray, areas: FloatArray) -> Pull:
        """Height and slopes of items at points ``(n, 2)`` with areas ``(n,)``."""
        parts, slopes = np.zeros(len(points)), np.zeros((len(points), 2))
        for force in self.fields:
            height, slope = force.field(points)
            weight = force.strengths * areas
            parts += weight * height
            slopes += weight[:, None] * slope
        for bond in self.bonds:
            own = bond.strengths != 0
            group = Group(points[own], areas[own], self.kinds[own], self.side)
            if own.any():
                part, slope = bond.bond(group)
                # One strength for all of a group: its mean.
                strength = float(bond.strengths[own].mean())
                parts[own] += strength * part
                slopes[own] += strength * slope
        return Pull(parts, slopes)

    def some(self, items: IntArray) -> Forces:
        """The same on some of the items."""
        return Forces(
            [FieldForce(f.field, f.strengths[items]) for f in self.fields],
            [BondForce(b.bond, b.strengths[items]) for b in self.bonds],
            self.kinds[items],
            self.side,
        )

    def heights(self, points: FloatArray, item: int) -> FloatArray:
        """``(m,)`` height of one item at many points, of the fields alone."""
        total = np.zeros(len(points))
        for force in self.fields:
            if force.strengths[item]:
                total += force.strengths[item] * force.field(points)[0]
        return total
