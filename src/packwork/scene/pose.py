"""Poses of items, translations, turns, scales and stretches, and limits on them.

Limits are of single items: sizes, turns, places, zones, and kinds that are not to be neighbours.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.errors import ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.simplify import grown


def _column(values: npt.ArrayLike, count: int, name: str) -> FloatArray:
    numbers = np.asarray(values, dtype=np.float64)
    if numbers.shape == (count,):
        return numbers
    if numbers.ndim == 0:
        return np.full(count, numbers)
    raise ShapeError(f"poses need as many numbers of {name} as of x ({count}), not {numbers.shape}")


@dataclass(frozen=True, eq=False, init=False)
class Poses:
    """Poses of n items, one array per parameter; a single number is that of all.

    Parameters
    ----------
    x, y
        ``(n,)`` canvas units: where the item's origin (its centroid) lies.
    angle
        ``(n,)`` radians, clockwise on screen.
    scale
        ``(n,)`` canvas units per item unit, positive.
    stretch
        ``(n,)`` width over height of what was square in the item's own frame, before it
        was turned: the paper's elementwise scale is ``scale * sqrt(stretch)`` along the
        item's own x and ``scale / sqrt(stretch)`` along its y, so areas do not depend on
        it. All ones if none are given.

    Raises
    ------
    ShapeError
        If there are not as many of each.

    Examples
    --------
    >>> Poses([1, 2], [5, 5], scale=3).scale.tolist()
    [3.0, 3.0]
    """

    x: FloatArray
    y: FloatArray
    angle: FloatArray
    scale: FloatArray
    stretch: FloatArray

    def __init__(
        self,
        x: npt.ArrayLike,
        y: npt.ArrayLike,
        angle: npt.ArrayLike = 0.0,
        scale: npt.ArrayLike = 1.0,
        stretch: npt.ArrayLike = 1.0,
    ) -> None:
        numbers = np.asarray(x, dtype=np.float64)
        count, put = numbers.size, object.__setattr__
        put(self, "x", _column(numbers, count, "x"))
        put(self, "y", _column(y, count, "y"))
        put(self, "angle", _column(angle, count, "angle"))
        put(self, "scale", _column(scale, count, "scale"))
        put(self, "stretch", _column(stretch, count, "stretch"))

    def __len__(self) -> int:
        return len(self.x)

    def __repr__(self) -> str:
        return f"<Poses: {len(self)}>"

    @property
    def axis_scales(self) -> FloatArray:
        """``(n, 2)`` canvas units per item unit along each item's own x and y.

        Wang and Lu 2025 call them s: P' = r (P * s) + t.

        Examples
        --------
        >>> one = np.ones(1)
        >>> Poses(one, one, one, 3 * one, 4 * one).axis_scales.tolist()
        [[6.0, 1.5]]
        """
        root = np.sqrt(self.stretch)
        return np.column_stack([self.scale * root, self.scale / root])

    def matrix(self, k: int) -> FloatArray:
        """2 x 3 map from the units of item ``k`` to canvas units.

        Examples
        --------
        >>> one = np.ones(1)
        >>> Poses(2 * one, 3 * one, 0 * one, one).matrix(0)[:, 2].tolist()
        [2.0, 3.0]
        """
        place = affine.similarity(
            float(self.x[k]), float(self.y[k]), float(self.angle[k]), float(self.scale[k])
        )
        stretch = float(self.stretch[k])
        return place if stretch == 1.0 else affine.compose(place, affine.stretched(stretch))

    def moved(self, x: float, y: float) -> Poses:
        """Poses moved by so much."""
        return replace(self, x=self.x + x, y=self.y + y)

    def subset(self, items: IntArray) -> Poses:
        """Poses of some items, ``(m,)`` indices.

        Examples
        --------
        >>> x = np.array([5.0, 6.0, 7.0])
        >>> Poses(x, x, x, x).subset(np.array([2, 0])).x.tolist()
        [7.0, 5.0]
        """
        return Poses(*(getattr(self, column.name)[items] for column in fields(Poses)))

    def with_some(self, items: IntArray, poses: Poses) -> Poses:
        """All poses, those of some items, ``(m,)`` indices, replaced.

        Examples
        --------
        >>> x, one = np.array([5.0, 6.0, 7.0]), np.ones(1)
        >>> Poses(x, x, x, x).with_some(np.array([1]), Poses(one, one, one, one)).x.tolist()
        [5.0, 1.0, 7.0]
        """
        columns = {column.name: getattr(self, column.name).copy() for column in fields(Poses)}
        for name, values in columns.items():
            values[items] = getattr(poses, name)
        return Poses(**columns)

    def followed_by(self, poses: Poses) -> Poses:
        """These poses, then others.

        Examples
        --------
        >>> one = Poses(*(np.ones(1),) * 4)
        >>> len(one.followed_by(one))
        2
        """
        both = ((getattr(self, c.name), getattr(poses, c.name)) for c in fields(Poses))
        return Poses(*(np.append(mine, theirs) for mine, theirs in both))


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
