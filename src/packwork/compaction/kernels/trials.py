"""Trials: items put elsewhere, cleared of conflicts, and compacted with what lies about them.

All that a trial reads and writes lies in its neighbourhood. Trials whose neighbourhoods do not
meet may be made at once, in any order and by any number of threads: they come out the same.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from packwork.compaction.kernels import distances, interior_point, steps
from packwork.compiled import helper, kernel

CUT, CHECKS = 0.06, 25
"""Logarithm of size that moved items lose at a time while they are in conflict, and how often.
Chosen."""

FINALISTS = 2
"""Places in which the moved items grow, of those where they come clear at the largest size.
Larger takes longer and finds little more. Tried."""

SHORT = 1e-9
"""Logarithm of size by which steps may end off their bounds. Derived."""


class Trial(NamedTuple):
    """Trial move: items, and poses that are tried for them.

    ``moved``: ``(m,)`` items that are put elsewhere; ``places``: ``(k, m, 4)``, of which the best
    is taken; ``items``: ``(n,)`` those that move afterwards, the moved ones among them, neighbours
    near each other; ``near``: ``(r,)`` all that they may come near, ascending; ``bounds``:
    ``(n, 4)`` boxes that they must not leave, or ``(0, 4)``. Where none is moved, it is
    plain compaction.
    """

    moved: np.ndarray
    places: np.ndarray
    items: np.ndarray
    near: np.ndarray
    bounds: np.ndarray


class Rounds(NamedTuple):
    """Trust regions of a trial's linear programmes, canvas units.

    ``alone``: of the moved items; ``together``: of all that move; ``missing``: worth that may be
    missing when each of these begins.
    """

    alone: float
    together: np.ndarray
    missing: np.ndarray


@helper
def worth(board, objective, items):
    """Worth of some items together; less for those out of their bounds."""
    total = 0.0
    for i in items:
        growth = board.places[i, 3]
        value = objective.weights[i] * math.exp(objective.power * growth)
        below = max(objective.smallest[i] - growth, 0.0)
        above = max(growth - objective.largest[i], 0.0)
        total += value / objective.power - steps.RETURN_WEIGHT * value * (below + above)
    return total


@helper
def _shortfall(board, objective, items):
    """Sum of how far some items are below their smallest sizes, logarithms."""
    total = 0.0
    for i in items:
        total += max(objective.smallest[i] - board.places[i, 3] - SHORT, 0.0)
    return total


@helper
def _least(board, items):
    least = np.inf
    for i in items:
        least = min(least, board.places[i, 3])
    return least


@helper
def _keep(board, items, places):
    """Write where items are."""
    for k in range(items.shape[0]):
        for c in range(4):
            places[k, c] = board.places[items[k], c]


@helper
def _are_within(board, items, bounds):
    """True if items are in the boxes that they must not leave."""
    for k in range(bounds.shape[0]):
        if distances.sticks_out(board.boxes[items[k]], bounds[k]):
            return False
    return True


@helper
def _clear_all(board, objective, trial, places, worths, gap):
    """Write places of the moved items, shrunk until they are clear there, and the worth of each.

    -inf where they do not come clear.
    """
    for k in range(worths.shape[0]):
        distances.put(board, trial.moved, trial.places[k])
        pairs = distances.pairs_among(board.boxes, trial.moved, trial.near, gap)
        worths[k] = -np.inf
        if steps.clear_by_shrinking(board, trial.moved, pairs, gap, CUT, np.int64(CHECKS)):
            worths[k] = worth(board, objective, trial.moved)
            _keep(board, trial.moved, places[k])


@helper
def _put_next(board, moved, places, worths):
    """Put the moved items where they come clear at the next largest worth; False if nowhere."""
    best = 0
    for k in range(worths.shape[0]):
        if worths[k] > worths[best]:
            best = k
    if worths[best] == -np.inf:
        return False
    worths[best] = -np.inf
    distances.put(board, moved, places[best])
    return True


@kernel
def attempt(board, objective, trial, rounds, allowed, least, gap, hair):
    """Make a trial; what it gained, or -inf where it was undone, for it gained too little.

    First the moved items grow by themselves, where they come clear at the largest sizes, all others
    standing still; from the best of those places on, all move.

    ``allowed``: worth that it may lose; ``least``: logarithm of size that none may end below.
    Plain compaction is not undone; -inf says that nothing could move.
    """
    items, moved, count = trial.items, trial.moved, trial.places.shape[0]
    before, chosen = np.empty((items.shape[0], 4)), np.empty((moved.shape[0], 4))
    places, worths = np.empty((count, moved.shape[0], 4)), np.empty(count)
    _keep(board, items, before)
    value, short = worth(board, objective, items), _shortfall(board, objective, items)
    _clear_all(board, objective, trial, places, worths, gap)
    best, has_moved, goes_on = -np.inf, False, True
    firsts = min(FINALISTS, count)
    # One loop for both: what is called in two places is compiled twice.
    for p in range(firsts + rounds.together.shape[0]):
        is_first = p < firsts
        movers = moved if is_first else items
        trust = rounds.alone if is_first else rounds.together[p - firsts]
        if is_first:
            goes_on = _put_next(board, moved, places, worths)
        elif value - allowed - worth(board, objective, items) > rounds.missing[p - firsts]:
            goes_on = False
        if goes_on:
            reach = gap + steps.TRAVEL * trust
            pairs = distances.pairs_among(board.boxes, movers, trial.near, reach)
            rows = steps.rows_of(board, movers, pairs, trust, gap, hair)
            gain, low, high = steps.gains_and_bounds(board, objective, movers, trust)
            z = interior_point.maximise(rows, gain, low, high, steps.ACCURACY)
            step = steps.step_of(board, movers, z, trust)
            has_moved |= steps.apply_step(board, movers, step, pairs, gap, trust) >= 0
        if is_first and goes_on and worth(board, objective, moved) > best:
            best = worth(board, objective, moved)
            _keep(board, moved, chosen)
        if p == firsts - 1:
            goes_on = best > -np.inf
            if goes_on:
                distances.put(board, moved, chosen)
        if p >= firsts - 1:
            goes_on = goes_on and _are_within(board, items, trial.bounds)
            if not goes_on:
                break
    found = worth(board, objective, items) - value
    if moved.shape[0] == 0:
        return found if has_moved else -np.inf
    # What others gain does not make up for items below the size that they should have at least.
    goes_on = goes_on and found > -allowed and _least(board, items) >= least
    if goes_on and _shortfall(board, objective, items) <= short:
        return found
    distances.put(board, items, before)
    return -np.inf
