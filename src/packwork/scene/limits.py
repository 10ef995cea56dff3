"""Limits of single items: sizes, turns, places, zones, and kinds that are not to be neighbours."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import grown

LEAST, MOST = 0.2, 0.3
"""Least tilts of items on one side, as shares of the largest that is allowed: rectangles that may
turn as one lie closest at one common angle. Larger and farther apart strews more and fills less.
Tried."""

_GOLDEN = (math.sqrt(5) - 1) / 2


def leanings(count: int, limit_rad: float) -> FloatArray:
    """``(count,)`` least tilts, rad: every other item to the left, evenly spread in size.

    Examples
    --------
    >>> leanings(4, 1.0).round(2).tolist()
    [0.2, -0.26, 0.22, -0.29]
    """
    number = np.arange(count)
    shares = LEAST + (MOST - LEAST) * np.remainder(number * _GOLDEN, 1.0)
    return np.asarray(np.where(number % 2 == 0, 1.0, -1.0) * shares * limit_rad)


def turn_sides(
    limit_rad: FloatArray | float, leans_rad: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest turn from upright of each item, ``(n,)`` each.

    ``leans_rad``: ``(n,)`` least tilts with their signs; 0 for items that may lean either way.

    Examples
    --------
    >>> low, high = turn_sides(0.5, np.array([0.1, -0.2, 0.0]))
    >>> low.tolist(), high.tolist()
    ([0.1, -0.5, -0.5], [0.5, -0.2, 0.5])
    """
    limit = np.broadcast_to(np.asarray(limit_rad, dtype=np.float64), leans_rad.shape)
    return np.where(leans_rad > 0, leans_rad, -limit), np.where(leans_rad < 0, leans_rad, limit)


@dataclass(frozen=True, eq=False)
class Zone:
    """Part of the container that some items stay in.

    ``outline``: canvas units; inside the container.
    ``items``: ``(m,)`` which items.
    """

    outline: Outline
    items: IntArray


@dataclass(frozen=True, eq=False)
class Limits:
    """Bounds of n items, one array per parameter, for every stage that moves them.

    ``x``, ``y``: ``(n,)`` canvas units: where an item's centroid has to lie; NaN where that is
    free.
    ``angle``: ``(n,)`` radians: the turn that it has to have; NaN where that is free.
    ``turn_limit``: ``(n,)`` radians: largest turn from upright; infinite for any, and where the
    angle is given.
    ``smallest``, ``largest``: ``(n,)`` scales; equal where the size is given.
    ``rigid``: ``(n,)`` whether the item's stretch stays as it is: that of items pinned in size.
    ``zones``: parts of the container that items stay in; an item is in one at most.
    ``kinds``: ``(n,)`` items of one number are not to lie side by side; a number each if all may.

    Examples
    --------
    >>> limits = Limits.free(2)
    >>> limits.binds, limits.held.any(), limits.largest.tolist()
    (False, np.False_, [inf, inf])
    """

    x: FloatArray
    y: FloatArray
    angle: FloatArray
    turn_limit: FloatArray
    smallest: FloatArray
    largest: FloatArray
    rigid: BoolArray
    kinds: IntArray
    zones: tuple[Zone, ...] = ()
    binds: bool = field(default=True, init=False)
    """Whether stages have to heed these; False of :meth:`free` ones alone."""

    @classmethod
    def free(cls, count: int) -> Limits:
        """Limits of items that may do anything."""
        nan, inf = np.full(count, np.nan), np.full(count, np.inf)
        rigid = np.zeros(count, dtype=bool)
        limits = cls(nan, nan, nan, inf, np.zeros(count), inf, rigid, np.arange(count))
        # What is made of them by ``replace`` binds.
        object.__setattr__(limits, "binds", False)
        return limits

    @property
    def keeps_kinds_apart(self) -> bool:
        """Whether some items are not to lie side by side."""
        return len(np.unique(self.kinds)) < len(self.kinds)

    @cached_property
    def held(self) -> BoolArray:
        """``(n, 5)`` what stays as it is of x, y, angle, scale and stretch."""
        given = [~np.isnan(value) for value in (self.x, self.y, self.angle)]
        return np.column_stack([*given, self.smallest == self.largest, self.rigid])

    @cached_property
    def is_movable(self) -> BoolArray:
        """``(n,)`` whether an item may be lifted to any other place of its zone."""
        return np.logical_not(np.logical_or(self.held[:, 0], self.held[:, 1]))

    @cached_property
    def groups(self) -> IntArray:
        """``(n,)`` items of one number may change places; those of -1 may not."""
        groups = np.zeros(len(self.x), dtype=np.int64)
        for number, zone in enumerate(self.zones, start=1):
            groups[zone.items] = number
        groups[~self.is_movable] = -1
        return groups

    def widened(self, margin: float) -> Limits:
        """The same for items that are taken for larger than they are, by a margin all round."""
        if margin == 0 or not self.zones:
            return self
        zones = tuple(replace(z, outline=grown(z.outline, margin)) for z in self.zones)
        return replace(self, zones=zones)

    def joined_by(self, count: int) -> Limits:
        """The same with as many more items, which may do anything, each of a kind of its own.

        Examples
        --------
        >>> len(Limits.free(2).joined_by(3).x)
        5
        """
        if not self.binds:
            return Limits.free(len(self.x) + count)
        more = Limits.free(count)
        return replace(
            self,
            x=np.append(self.x, more.x),
            y=np.append(self.y, more.y),
            angle=np.append(self.angle, more.angle),
            turn_limit=np.append(self.turn_limit, more.turn_limit),
            smallest=np.append(self.smallest, more.smallest),
            largest=np.append(self.largest, more.largest),
            rigid=np.append(self.rigid, more.rigid),
            kinds=np.append(self.kinds, self.kinds.max(initial=-1) + 1 + more.kinds),
        )


NO_LIMITS = Limits.free(0)
"""Limits of stages that were given none: of however many items, for none of them binds."""
