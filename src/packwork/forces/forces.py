"""All forces of a run together: which items each acts on, and how strongly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.forces.field import Bond, Distance, Field, ItemGroup

FORCE_WEIGHT = 30.0
"""Weight of a force of strength 1: an item that is drawn across the whole canvas pays for
being covered thirty times over. Larger presses items into each other, smaller is drowned by
the reward for filling. Tried."""

PRESSURE = 0.1
"""Share of a pull on all items alike that is felt where they fill a container. Larger presses them
together more and covers less. Tried."""


@dataclass(frozen=True, eq=False)
class Pull:
    """Height of n items and its slope.

    ``parts``: ``(n,)`` each item's part of the height, area times canvas units.
    ``slopes``: ``(n, 2)`` derivatives of the whole by x and y, squared canvas units.
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

    ``strengths``: ``(n,)`` one per item of the run: 0 for those that it does not act on, negative
    for those that it pushes off.
    """

    field: Field
    strengths: FloatArray


@dataclass(frozen=True, eq=False)
class BondForce:
    """A bond between some items.

    ``strengths``: as of a field; items of strength 0 are no part of the group.
    """

    bond: Bond
    strengths: FloatArray


@dataclass(frozen=True, eq=False)
class Forces:
    """Object-space losses that act on items by where they are.

    An item's part is its area times its height: large ones press harder, as under gravity.

    ``kinds``: ``(n,)`` items of one number are copies of one thing.
    ``side``: longer side of the canvas.

    Examples
    --------
    >>> from packwork.forces.field import Direction
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

    @property
    def acts(self) -> bool:
        """Whether anything pulls."""
        return bool(self.fields or self.bonds)

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
            group = ItemGroup(points[own], areas[own], self.kinds[own], self.side)
            if own.any():
                part, slope = bond.bond(group)
                # One strength for all of a group: its mean.
                strength = float(bond.strengths[own].mean())
                parts[own] += strength * part
                slopes[own] += strength * slope
        return Pull(parts, slopes)

    def common_point(self) -> FloatArray | None:
        """The one point ``(2,)`` to which all items are drawn alike; None where that is not all.

        Examples
        --------
        >>> from packwork.forces.field import Distance
        >>> middle = Distance.from_points(np.array([[1.0, 2.0]]))
        >>> def drawn(strengths):
        ...     return Forces([FieldForce(middle, strengths)], [], np.zeros(2, int), 10.0)
        >>> drawn(np.ones(2)).common_point().tolist(), drawn(np.array([1.0, 2.0])).common_point()
        ([1.0, 2.0], None)
        """
        if len(self.fields) != 1 or self.bonds:
            return None
        [force] = self.fields
        if not isinstance(force.field, Distance) or not (force.strengths > 0).all():
            return None
        if np.ptp(force.strengths) > 0 or not force.field.is_point:
            return None
        return np.asarray(force.field.begins[0])

    def cost(self, points: FloatArray, areas: FloatArray) -> Pull:
        """Cost of points ``(n, 2)`` and areas ``(n,)``, squared canvas units, and its slope."""
        pull, weight = self(points, areas), FORCE_WEIGHT / self.side
        return Pull(weight * pull.parts, weight * pull.slopes)

    def cost_changes(self, points: FloatArray, areas: FloatArray, places: FloatArray) -> FloatArray:
        """``(n, m)`` change of the whole cost, squared canvas units, by an item at another place.

        Examples
        --------
        >>> from packwork.forces.field import Direction
        >>> down = FieldForce(Direction(np.pi / 2), np.array([1.0, 2.0]))
        >>> forces = Forces([down], [], np.zeros(2, int), FORCE_WEIGHT)
        >>> points = np.array([[1.0, 3], [2, 4]])
        >>> forces.cost_changes(points, np.ones(2), points).round(9).tolist()
        [[0.0, -1.0], [2.0, 0.0]]
        """
        found = np.zeros((len(points), len(places)))
        for force in self.fields:
            change = force.field(places)[0] - force.field(points)[0][:, None]
            found += (force.strengths * areas)[:, None] * change
        for bond in self.bonds:
            own = bond.strengths != 0
            group = ItemGroup(points[own], areas[own], self.kinds[own], self.side)
            if own.any():
                found[own] += bond.strengths[own].mean() * bond.bond.changes(group, places)
        return np.asarray(FORCE_WEIGHT / self.side * found)

    def buoyant(self, areas: FloatArray) -> Forces:
        """The same where a container is full: what is drawn less than others gives way.

        Of fields that draw all items, little of the mean is left: it would press all together
        and make all smaller.

        ``areas``: ``(n,)`` how much each counts, squared canvas units.
        """
        fields = []
        for force in self.fields:
            pull = force.strengths
            if len(pull) and pull.all():
                pull = pull - (1 - PRESSURE) * np.average(pull, weights=areas)
            fields.append(FieldForce(force.field, pull))
        return Forces(fields, self.bonds, self.kinds, self.side)

    def subset(self, items: IntArray) -> Forces:
        """The same on some of the items, ``(m,)`` indices."""
        return Forces(
            [FieldForce(f.field, f.strengths[items]) for f in self.fields],
            [BondForce(b.bond, b.strengths[items]) for b in self.bonds],
            self.kinds[items],
            self.side,
        )

    def heights(
        self, points: FloatArray, item: int, anchor: FloatArray | None = None
    ) -> FloatArray:
        """``(m,)`` height of one item at many points.

        Of the fields alone; with an ``anchor``, also of the bonds with others that lie about it.
        """
        total = np.zeros(len(points))
        for force in self.fields:
            if force.strengths[item]:
                total += force.strengths[item] * force.field(points)[0]
        if anchor is not None:
            for bond in self.bonds:
                if bond.strengths[item]:
                    total += bond.strengths[item] * bond.bond.alone(points, anchor, self.side)
        return total


NO_FORCES = Forces((), (), np.arange(0), 1.0)
"""Forces of stages that were given none: nothing pulls, however many items there are."""
