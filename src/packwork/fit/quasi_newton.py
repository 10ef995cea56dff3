"""Limited-memory BFGS for a few hundred unknowns.

Nocedal and Wright, "Numerical Optimization" (2006), algorithm 7.4, with the bisection line
search of Lewis and Overton (2013) for the weak Wolfe conditions. SciPy's L-BFGS-B ends alike,
but on a busy machine its BLAS threads wait for each other many times longer than they
compute, on vectors as short as these.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from packwork.arrays import FloatArray

Objective: TypeAlias = Callable[[FloatArray], tuple[float, FloatArray]]

MEMORY = 5
"""Steps that the quasi-Newton matrix remembers; 5 to 40 end alike. Tried."""

LEAST_DECREASE = 1e-4
"""Share of the slope's promise that a step must keep. Customary."""

LEAST_FLATTENING = 0.9
"""Share of the slope at most that may remain after a step. Customary."""

MOST_TRIALS = 20
"""Trials of one line search, after which the value is taken to be at its floor. Chosen."""


class Visit(NamedTuple):
    """A point with its value and gradient."""

    x: FloatArray
    value: float
    gradient: FloatArray


def lowest(
    objective: Objective, start: FloatArray, iterations: int, least_gain: float
) -> FloatArray:
    """Point near ``start`` where a smooth function is lowest.

    Parameters
    ----------
    objective
        Point to value and gradient, all of one shape ``(n,)``.
    start
        Where to begin, in units in which a step of length one is a cautious first step.
    least_gain
        Ends when an iteration lowers the value by less.

    Examples
    --------
    >>> def bowl(x):
    ...     return float(x[0] ** 2 + 10 * x[1] ** 2), np.array([2 * x[0], 20 * x[1]])
    >>> lowest(bowl, np.array([3.0, 1.0]), 50, 1e-12).round(4).tolist()
    [0.0, 0.0]
    """
    here = Visit(start, *objective(start))
    steps: deque[tuple[FloatArray, FloatArray, float]] = deque(maxlen=MEMORY)
    for _ in range(iterations):
        direction = _direction(here.gradient, steps)
        if not float(direction @ here.gradient) < 0:
            break
        there = _searched(objective, here, direction)
        if there is None:
            break
        move, turn = there.x - here.x, there.gradient - here.gradient
        curvature = float(move @ turn)
        if curvature > 0:
            steps.append((move, turn, curvature))
        gain, here = here.value - there.value, there
        if gain < least_gain:
            break
    return here.x


def _direction(
    gradient: FloatArray, steps: deque[tuple[FloatArray, FloatArray, float]]
) -> FloatArray:
    """Downhill through the remembered curvature (two-loop recursion); length one at first."""
    if not steps:
        return -gradient / max(float(np.sqrt(gradient @ gradient)), 1e-300)
    rest = gradient.copy()
    shares = []
    for move, turn, curvature in reversed(steps):
        shares.append(float(move @ rest) / curvature)
        rest -= shares[-1] * turn
    _, turn, curvature = steps[-1]
    rest *= curvature / float(turn @ turn)
    for (move, turn, curvature), share in zip(steps, reversed(shares), strict=True):
        rest += (share - float(turn @ rest) / curvature) * move
    return -rest


def _searched(objective: Objective, here: Visit, direction: FloatArray) -> Visit | None:
    """First point found along a direction that is low and flat enough; None if none is low."""
    slope = float(here.gradient @ direction)
    low, high, length = 0.0, np.inf, 1.0
    best = None
    for _ in range(MOST_TRIALS):
        x = here.x + length * direction
        there = Visit(x, *objective(x))
        if there.value > here.value + LEAST_DECREASE * length * slope:
            high = length
        elif float(there.gradient @ direction) < LEAST_FLATTENING * slope:
            low, best = length, there
        else:
            return there
        length = 0.5 * (low + high) if np.isfinite(high) else 2 * length
    return best
