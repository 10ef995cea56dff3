"""Schedules of a run: steps shrink and penalties grow."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.solve.options import ImageLossFunction, SolveOptions

STEADY = frozenset({"filling"})
"""Losses that do not harden. All others do: at a constant weight, evenness or a loss of
one's own is drowned at the end, where it is needed. Tried."""

REWARDS = frozenset({"filling", "evenness"})
"""Losses that draw items into contact, cut while a run settles."""

FADING = 20.0
"""By how much forces fade over the run. They lead while items still pass through each other; what
presses on at the end makes items smaller. Larger ends fuller and keeps less of what was asked.
Tried."""


def epochs_per_level(epochs: int, shares: Sequence[float]) -> list[int]:
    """Whole epochs in the proportion of ``shares``, rounded so that none is lost.

    Examples
    --------
    >>> epochs_per_level(200, [1, 1, 1])
    [67, 66, 67]
    """
    ends = np.rint(np.cumsum(shares) / np.sum(shares) * epochs).astype(int)
    return [int(n) for n in np.diff(ends, prepend=0)]


def rate_factor(options: SolveOptions, progress: float) -> float:
    """Factor on all step lengths at ``progress`` (0..1) through the run.

    Examples
    --------
    >>> rate_factor(SolveOptions(cooling=0.25), 0.5)
    0.5
    """
    return float(options.cooling**progress)


def growth(options: SolveOptions, progress: float) -> float:
    """By how much penalties have grown at ``progress`` (0..1) through the run.

    Examples
    --------
    >>> growth(SolveOptions(hardening=9), 0.5)
    3.0
    """
    return float(options.hardening**progress)


def weights_at(options: SolveOptions, progress: float) -> dict[str | ImageLossFunction, float]:
    """Weight of each loss at ``progress`` (0..1) through the run.

    All but filling grow geometrically; rewards are cut while the run settles.

    Examples
    --------
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

    Examples
    --------
    >>> force_factor(0.0), force_factor(1.0) == 1 / FADING
    (1.0, True)
    """
    return float(FADING**-progress)
