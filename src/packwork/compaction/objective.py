"""Objective and bounds of a compaction: what growth is worth, by size mode and turn limit."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.kernels.steps import LEAST_GROWTH, Objective
from packwork.compaction.options import MoveOptions
from packwork.scene.pose import turn_sides

LAGGARD = 0.05
"""Logarithm of size by which an item must stay behind to be moved to a void, and by which it may
outgrow the others there. Smaller moves items that would have caught up. Chosen."""

AHEAD = 0.5
"""How far above the smallest item others may grow where sizes are common, growths of one step.
Larger takes room that the smallest needs. Tried."""

URGENCY = 1.0
"""How much more a step of growth is worth for an item that is one step smaller, logarithm. Larger
cares for the smallest item only. Tried."""

MOST_URGENT = 4.0
"""Bound of that logarithm, about the median item. Chosen."""

MOST_EXPONENT = 300.0
"""Largest exponent that weights may have: float64 ends at 709. Derived."""

OVERSHOOT = 1e-4
"""Logarithm of size by which items may exceed a fixed size, so that they reach it. Derived: far
below the tolerance of the outlines."""

AREA_POWER = 2.0
"""Area goes with the square of the scale."""

SIZE_TOLERANCE = 1e-3
"""Logarithm of size below which no item is too small: steps end a little off their bounds.
Chosen."""


class Sizing(ABC):
    """A size mode: objective of the next round, and the items that stayed behind.

    Growths ``(n,)`` are logarithms. ``areas``: ``(n,)`` at growth 0, squared canvas units;
    ``turns``: farthest turns back and on, ``(n,)`` each, rad.
    """

    def __init__(self, areas: FloatArray, turns: tuple[FloatArray, FloatArray]) -> None:
        self.areas = areas
        self.turns = turns

    @abstractmethod
    def objective(self, growth: FloatArray, spread: float) -> Objective:
        """Objective at these growths; ``spread``: the most that one step grows."""

    @abstractmethod
    def laggards(self, growth: FloatArray) -> IntArray:
        """Indices of items that are far below their bounds or the others."""

    def undersized(self, growth: FloatArray) -> tuple[int, ...]:
        """Indices of items below their bounds; none of common sizes."""
        return ()

    @abstractmethod
    def is_done(self, growth: FloatArray) -> bool:
        """Whether the objective is reached."""


@final
class FreeSizes(Sizing):
    """Free sizes: each item within its own bounds, logarithms ``(n,)``; all area worth the same."""

    def __init__(
        self,
        areas: FloatArray,
        turns: tuple[FloatArray, FloatArray],
        smallest: FloatArray,
        largest: FloatArray,
    ) -> None:
        super().__init__(areas, turns)
        self.smallest, self.largest = smallest, largest

    def objective(self, growth: FloatArray, spread: float) -> Objective:
        """The same in all rounds."""
        weights = AREA_POWER * self.areas
        still = np.zeros((len(growth), 2))
        return Objective(self.smallest, self.largest, *self.turns, weights, AREA_POWER, still)

    def laggards(self, growth: FloatArray) -> IntArray:
        """Items ``(m,)`` below their smallest size."""
        return np.flatnonzero(growth < self.smallest - LAGGARD)

    def undersized(self, growth: FloatArray) -> tuple[int, ...]:
        """Items below their smallest size."""
        return tuple(int(k) for k in np.flatnonzero(self.smallest - growth > SIZE_TOLERANCE))

    def is_done(self, growth: FloatArray) -> bool:
        """Whether all are as large as they may be."""
        return bool((growth >= self.largest).all())


class CommonSize(Sizing):
    """Sizes of one common factor: growth of those that are behind the median is worth more."""

    def _objective(self, growth: FloatArray, spread: float, largest: FloatArray) -> Objective:
        steepest = MOST_EXPONENT / max(float(np.abs(growth).max()), 1.0)
        power = -min(URGENCY / spread, steepest)
        behind = power * (growth - np.median(growth))
        value = np.exp(np.clip(behind, -MOST_URGENT, MOST_URGENT))
        smallest = np.full_like(growth, LEAST_GROWTH)
        weights, still = value * np.exp(-power * growth), np.zeros((len(growth), 2))
        return Objective(smallest, largest, *self.turns, weights, power, still)


@final
class SharedSize(CommonSize):
    """Shared sizes: one common factor, as large as possible."""

    def objective(self, growth: FloatArray, spread: float) -> Objective:
        """Bounds a little above the smallest item."""
        largest = np.maximum(growth, growth.min() + AHEAD * spread)
        return self._objective(growth, spread, largest)

    def levelling(self, growth: FloatArray, back: float) -> Objective:
        """Objective of coming down: all smaller than the smallest by ``back``, logarithms."""
        aim = np.full_like(growth, growth.min() - back)
        return Objective(aim, aim, *self.turns, np.exp(-growth), 1.0, np.zeros((len(growth), 2)))

    def laggards(self, growth: FloatArray) -> IntArray:
        """Items ``(m,)`` far below most."""
        return np.flatnonzero(growth < np.median(growth) - LAGGARD)

    def is_done(self, growth: FloatArray) -> bool:
        """False: there is always room to grow into."""
        return False


@final
class FixedSize(CommonSize):
    """Fixed sizes: items that were shrunk grow back to growth 0, no farther."""

    def objective(self, growth: FloatArray, spread: float) -> Objective:
        """Growth back to 0, the farther behind the worthier."""
        return self._objective(growth, spread, np.maximum(growth, OVERSHOOT))

    def laggards(self, growth: FloatArray) -> IntArray:
        """Items ``(m,)`` far below growth 0."""
        return np.flatnonzero(growth < -LAGGARD)

    def is_done(self, growth: FloatArray) -> bool:
        """Whether all growths are at 0 or above."""
        return bool((growth >= 0).all())


def turn_ranges(angle: FloatArray, options: MoveOptions) -> tuple[FloatArray, FloatArray]:
    """Ranges in which items at these angles may turn back and on, ``(n,)`` each.

    >>> back, on = turn_ranges(np.array([0.1]), MoveOptions(turn_limit=0.5))
    >>> back.round(6).tolist(), on.round(6).tolist()
    ([-0.6], [0.4])
    >>> turn_ranges(np.zeros(2), MoveOptions(still=(True, False)))[1].tolist()
    [0.0, inf]
    """
    back, on = _ranges_of_all(angle, options)
    if options.still is None:
        return back, on
    still = np.array(options.still, dtype=bool)
    return np.where(still, 0.0, back), np.where(still, 0.0, on)


def _ranges_of_all(angle: FloatArray, options: MoveOptions) -> tuple[FloatArray, FloatArray]:
    if not options.turning:
        return np.zeros_like(angle), np.zeros_like(angle)
    if options.turn_limit is None or options.turn_limit >= math.pi:
        return np.full_like(angle, -np.inf), np.full_like(angle, np.inf)
    upright = np.remainder(angle + math.pi, 2 * math.pi) - math.pi
    leans = np.zeros_like(angle) if options.leans is None else np.array(options.leans)
    low, high = turn_sides(options.turn_limit, leans)
    back, on = low - upright, high - upright
    return np.minimum(back, 0.0), np.maximum(on, 0.0)
