"""One step of compaction: its objective and bounds, and the exact check of what it moves.

``items``: ``(n,)`` those that move; ``pairs``: ``(k, 2)`` polygons that may meet. Sources:
``compact.py``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from packwork.compaction.kernels import distances
from packwork.compiled import helper, kernel, leaf

TRAVEL = 7.2
"""Trust regions by which two items can come nearer in one step. Derived: each by the diagonal of
its move, its turn and its growth, and a little for the curve."""

RETURN_WEIGHT = 10.0
"""How much more a return to the allowed sizes is worth than growth within them. Larger lets one
item that is out of them push all others aside. Chosen."""

ACCURACY = 0.1
"""Share of the growth that a programme may miss. Smaller costs time and drives items to the ends of
their freedom; larger leaves them amid their room. Tried."""

FIRST_CUT = 0.004
"""First cut of size of items in conflict after a step, trust regions at their farthest vertex,
doubled while it lasts. Larger gives room away, smaller needs more checks. Tried."""

CUTS = 7
"""Doublings before an item stays where it was: the last cut is half a trust region."""

MOST_GROWTH = 1.0
"""Logarithm of size by which one step grows an item at most, or cuts it at most. Programmes are
linear: where an item is far smaller than the trust region, larger steps end anywhere, and larger
cuts make specks. Chosen."""

LEAST_GROWTH = -10.0
"""Logarithm of size below which no item falls: a 20,000th. Chosen."""

CHECKS = 16
"""Checks of one step before it is halved for all. Smaller halves steps that one more cut would have
saved. Tried."""

HALVINGS = 4
"""Halvings before the whole step is given up. Chosen."""


class Objective(NamedTuple):
    """Objective and bounds of a compaction: what growth is worth, how far items may turn and grow.

    Logarithms of growth and radians, ``(n,)`` each. An item of growth g is worth ``weights *
    exp(power * g) / power``: its area with power 2; with a large negative power, the smallest items
    count most. ``push``: ``(n, 2)`` what a move by one canvas unit is worth.
    """

    smallest: np.ndarray
    largest: np.ndarray
    backmost: np.ndarray
    foremost: np.ndarray
    weights: np.ndarray
    power: float
    push: np.ndarray


@helper
def gains_and_bounds(board, objective, items, trust):
    """Gains and bounds of the unknowns, lengths in units of ``trust``."""
    n = items.shape[0]
    gain, low, high = np.empty(4 * n), np.empty(4 * n), np.empty(4 * n)
    for k in range(n):
        i = items[k]
        for c in range(2):
            low[4 * k + c], high[4 * k + c] = -1.0, 1.0
        gain[4 * k + 2] = 0.0
        turn, growth = board.places[i, 2], board.places[i, 3]
        most = trust / distances.arm(board, i)
        gain[4 * k], gain[4 * k + 1] = objective.push[i, 0] * trust, objective.push[i, 1] * trust
        low[4 * k + 2] = max((objective.backmost[i] - turn) / most, -1.0)
        high[4 * k + 2] = min((objective.foremost[i] - turn) / most, 1.0)
        slope = objective.weights[i] * np.exp(objective.power * growth) * most
        down, up = (objective.smallest[i] - growth) / most, (objective.largest[i] - growth) / most
        step = min(MOST_GROWTH / most, 1.0)
        if down > 0.0:
            slope *= RETURN_WEIGHT
            down = 0.0
        elif up < 0.0:
            slope *= -RETURN_WEIGHT
            down, up = up, 0.0
        gain[4 * k + 3] = slope
        low[4 * k + 3], high[4 * k + 3] = max(down, -step), min(up, step)
        for c in (2, 3):
            low[4 * k + c], high[4 * k + c] = min(low[4 * k + c], 0.0), max(high[4 * k + c], 0.0)
    return gain, low, high


@leaf
def mark_conflicts(board, pairs, gap, changed, struck, room):
    """Mark polygons in conflict, of which one has ``changed``; returns the number of pairs."""
    count = 0
    for p in range(pairs.shape[0]):
        struck[pairs[p, 0]] = struck[pairs[p, 1]] = False
    for p in range(pairs.shape[0]):
        i, j = pairs[p, 0], pairs[p, 1]
        if (changed[i] or changed[j]) and distances.distance(board, i, j, gap, room) < gap:
            struck[i] = struck[j] = True
            count += 1
    # The container never moves: its items do.
    struck[-1] = False
    return count


@helper
def _polygons_of(pairs, marks):
    """Polygons of some pairs, each once; ``marks``, one for each of all, are lost."""
    for p in range(pairs.shape[0]):
        marks[pairs[p, 0]] = marks[pairs[p, 1]] = 0
    found = np.empty(2 * pairs.shape[0], np.int64)
    count = 0
    for p in range(pairs.shape[0]):
        for i in pairs[p]:
            if marks[i] == 0:
                marks[i] = 1
                found[count] = i
                count += 1
    return found[:count]


@helper
def _apply_share(board, items, before, step, share, pairs, gap, unit):
    """Move by a share of a step; items in conflict are cut, then left where they were."""
    # Only what is in the pairs is looked at: work must not grow with all polygons.
    strikes = np.empty(board.starts.shape[0] - 1, np.int64)
    changed, struck = np.empty(strikes.shape[0], np.bool_), np.empty(strikes.shape[0], np.bool_)
    polygons = _polygons_of(pairs, strikes)
    for i in polygons:
        strikes[i], changed[i], struck[i] = 0, True, False
    place = np.empty((1, 4))
    room = distances.room_for(distances.most_points(board.starts, pairs))
    for _ in range(CHECKS):
        for k in range(items.shape[0]):
            hits = strikes[items[k]]
            if not changed[items[k]]:
                continue
            for c in range(4):
                place[0, c] = before[k, c] + (share * step[k, c] if hits <= CUTS else 0.0)
            if 0 < hits <= CUTS:
                place[0, 3] -= unit[k] * 2.0 ** (hits - 1)
                place[0, 3] = max(place[0, 3], min(before[k, 3], LEAST_GROWTH))
            distances.put(board, items[k : k + 1], place)
        if mark_conflicts(board, pairs, gap, changed, struck, room) == 0:
            return True
        for i in polygons:
            strikes[i] += struck[i]
            changed[i] = struck[i]
    return False


@helper
def apply_step(board, items, step, pairs, gap, trust):
    """Move ``items`` by as much of ``step`` as is free; how many halvings, -1 for no move.

    Curves that the linear programme took for straight leave conflicts far smaller than the step:
    items in one are made a little smaller rather than sent back.
    """
    n = items.shape[0]
    before, unit = np.empty((n, 4)), np.empty(n)
    for k in range(n):
        for c in range(4):
            before[k, c] = board.places[items[k], c]
        unit[k] = min(
            FIRST_CUT * trust / distances.arm(board, items[k]), MOST_GROWTH / 2.0 ** (CUTS - 1)
        )
    for halving in range(HALVINGS):
        if _apply_share(board, items, before, step, 0.5**halving, pairs, gap, unit):
            return halving
    distances.put(board, items, before)
    return -1


@kernel
def step_of(board, items, z, trust):
    """Change of place of ``items`` that the unknowns of a programme stand for."""
    step = np.empty((items.shape[0], 4))
    for k in range(items.shape[0]):
        arm = distances.arm(board, items[k])
        for c in range(4):
            step[k, c] = z[4 * k + c] * trust / (arm if c > 1 else 1.0)
    return step


@kernel
def clear_by_shrinking(board, items, pairs, gap, cut, checks):
    """Shrink ``items`` that are in conflict, by steps, until none is; False if some stay."""
    struck = np.empty(board.starts.shape[0] - 1, np.bool_)
    changed = np.ones(struck.shape[0], np.bool_)
    place = np.empty((1, 4))
    room = distances.room_for(distances.most_points(board.starts, pairs))
    for _ in range(checks):
        if mark_conflicts(board, pairs, gap, changed, struck, room) == 0:
            return True
        for k in range(items.shape[0]):
            if struck[items[k]]:
                for c in range(4):
                    place[0, c] = board.places[items[k], c]
                place[0, 3] -= cut
                distances.put(board, items[k : k + 1], place)
    return False
