"""Schedules of a run, and its progress through them: steps shrink and penalties grow.

Progress is counted in epochs, or in seconds where a time was given.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Protocol

import numpy as np

from packwork.solve.options import ImageLossFunction, SolveOptions

STEADY = frozenset({"filling"})
"""Losses that do not harden; others would be drowned at the end, where they are needed. Tried."""

REWARDS = frozenset({"filling", "evenness"})
"""Losses that draw items into contact, cut while a run settles."""

FADING = 20.0
"""By how much forces fade over the run: they lead while items still pass through each other. Larger
ends fuller and keeps less of what was asked. Tried."""


def epochs_per_level(epochs: int, shares: Sequence[float]) -> list[int]:
    """Whole epochs in the proportion of ``shares``, rounded so that none is lost.

    >>> epochs_per_level(200, [1, 1, 1])
    [67, 66, 67]
    """
    ends = np.rint(np.cumsum(shares) / np.sum(shares) * epochs).astype(int)
    return [int(n) for n in np.diff(ends, prepend=0)]


def rate_factor(options: SolveOptions, progress: float) -> float:
    """Factor on all step lengths at ``progress`` (0..1) through the run.

    >>> rate_factor(SolveOptions(cooling=0.25), 0.5)
    0.5
    """
    return float(options.cooling**progress)


def growth(options: SolveOptions, progress: float) -> float:
    """By how much penalties have grown at ``progress`` (0..1) through the run.

    >>> growth(SolveOptions(hardening=9), 0.5)
    3.0
    """
    return float(options.hardening**progress)


def weights_at(options: SolveOptions, progress: float) -> dict[str | ImageLossFunction, float]:
    """Weight of each loss at ``progress`` (0..1) through the run.

    All but filling grow geometrically; rewards are cut while the run settles.

    >>> weights_at(SolveOptions(losses={"overlap": 2.0}, hardening=9), 0.5)
    {'overlap': 6.0}
    """
    grown = growth(options, progress)
    reward = options.settling_reward if progress > 1 - options.settling else 1.0
    return {
        name: weight * (1.0 if name in STEADY else grown) * (reward if name in REWARDS else 1.0)
        for name, weight in options.losses.items()
    }


def force_factor(progress: float) -> float:
    """Factor on forces at ``progress`` (0..1) through the run: they lead at first.

    >>> force_factor(0.0), force_factor(1.0) == 1 / FADING
    (1.0, True)
    """
    return float(FADING**-progress)


class Pace(Protocol):
    """Says when a level is over and how far the run is."""

    def advance(self) -> None:
        """Count one more epoch."""
        ...

    def progress(self) -> float:
        """Progress of the run, 0 at its first epoch and 1 at its last."""
        ...

    def has_reached(self, level: int, share: float) -> bool:
        """Whether that share of the level (by index) is done."""
        ...


class EpochPace:
    """A given number of epochs: the same on any machine.

    >>> pace = EpochPace([1, 2])
    >>> pace.advance()
    >>> pace.has_reached(0, 1.0), pace.has_reached(1, 0.5), pace.progress()
    (True, False, 0.5)
    """

    def __init__(self, per_level: Sequence[int]) -> None:
        self._begins = [0, *(int(n) for n in np.cumsum(per_level))]
        self._done = 0

    def advance(self) -> None:
        """Count one more epoch."""
        self._done += 1

    def progress(self) -> float:
        """Epochs done over those between the first and the last."""
        return min(self._done / max(self._begins[-1] - 1, 1), 1.0)

    def has_reached(self, level: int, share: float) -> bool:
        """Whether that share of the level's epochs, rounded down, is done."""
        begin, end = self._begins[level : level + 2]
        return self._done - begin >= int(share * (end - begin))


class TimePace:
    """As many epochs as a given time from now on allows, shared among the levels like epochs."""

    def __init__(self, seconds: float, shares: Sequence[float]) -> None:
        self._began = time.perf_counter()
        self._seconds = max(seconds, 1e-9)
        self._begins = np.concatenate([[0.0], np.cumsum(shares) / np.sum(shares)])

    def advance(self) -> None:
        """Nothing to count: the clock runs by itself."""

    def progress(self) -> float:
        """Share of the time that has passed, at most 1."""
        return min(self._elapsed(), 1.0)

    def has_reached(self, level: int, share: float) -> bool:
        """Whether that share of the level's time has passed."""
        begin, end = self._begins[level : level + 2]
        return bool(self._elapsed() >= begin + share * (end - begin))

    def _elapsed(self) -> float:
        return (time.perf_counter() - self._began) / self._seconds


def pace_of(options: SolveOptions) -> Pace:
    """Pace that the options ask for: seconds where given, else epochs."""
    shares = options.shares or [1.0] * len(options.levels)
    if options.seconds is not None:
        return TimePace(options.seconds, shares)
    return EpochPace(epochs_per_level(options.epochs, shares))
