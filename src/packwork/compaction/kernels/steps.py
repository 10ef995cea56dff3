"""One round of compaction: contacts, the linear programme over them, the exact check.

``board``: polygons in place, as of ``distances``; ``items``: ``(n,)`` those that move; ``pairs``:
``(k, 2)`` solids that may meet. Sources: ``compact.py``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from packwork.compaction.kernels import contacts, distances, interior_point
from packwork.compiled import helper, kernel

REACH = 3.0
"""Distance within which features bind, trust regions. Larger gives more conditions,
smaller lets items run into what was not seen. Tried."""


BEND = 0.25
"""Distance kept beyond the gap for what turning bends: squares of the trust region over
the mean arm. Larger wastes room while trust is large, smaller fails more checks. Tried."""

TRAVEL = 7.2
"""Trust regions by which two items can come nearer in one step: each by the diagonal of
its move, its turn and its growth, and a little for the curve. Derived."""

TIGHT = 1.2
"""Hair that steps aim at, over the one that is checked. Larger wastes room, smaller fails
more checks. Tried."""

LEAST_SLANT = 0.05
"""Angle by which a vertex may miss being the nearest of its neighbours to an edge and
still bind, rad, beyond what the items may turn. Larger gives more conditions of which few
matter. Tried."""

RETURN_WEIGHT = 10.0
"""How much more a return to the allowed sizes is worth than growth within them. Larger
lets one item that is out of them push all others aside. Chosen."""

ACCURACY = 0.1
"""Share of the growth that a programme may miss. Smaller costs time and drives items to
the ends of their freedom; larger leaves them in the middle of their room. Tried."""

FIRST_CUT = 0.004
"""First cut of size of items in conflict after a step, trust regions at their farthest
vertex; doubled while the conflict lasts. Larger gives room away, smaller needs more
checks. Tried."""

CUTS = 7
"""Doublings before an item stays where it was: the last cut is half a trust region."""

LAST_CUT = 1.0
"""Logarithm of size that such a cut takes at most: of items far smaller than the trust region
all would be taken. Larger makes specks of them, smaller leaves conflicts. Chosen."""

MOST_GROWTH = 1.0
"""Logarithm of size by which one step grows an item at most. Programmes are linear: where an
item is far smaller than the trust region, larger steps end anywhere. Chosen."""

LEAST_GROWTH = -10.0
"""Logarithm of size below which no item falls: a 20,000th. Chosen."""

CHECKS = 16
"""Checks of one step before it is halved for all. Smaller halves steps that one more cut
would have saved. Tried."""

HALVINGS = 4
"""Halvings before the whole step is given up. Chosen."""


class Objective(NamedTuple):
    """Objective and bounds of a compaction: what growth is worth, how far items may turn and grow.

    Logarithms of growth and radians, ``(n,)`` each.

    An item of growth g is worth ``weights * exp(power * g) / power``: its area with power
    2; with a large negative power, the smallest items count most. ``push``: ``(n, 2)`` what
    a move by one canvas unit is worth, by x and y.
    """

    smallest: np.ndarray
    largest: np.ndarray
    backmost: np.ndarray
    foremost: np.ndarray
    weights: np.ndarray
    power: float
    push: np.ndarray


@helper
def all_contacts(board, pairs, reach, slants):
    """All contacts of pairs: the pair of each ``(m,)`` and its numbers ``(m, 7)``."""
    room = 24 * pairs.shape[0] + 256
    while True:
        pair_of, numbers = np.empty(room, np.int64), np.empty((room, 7))
        count = contacts.contacts(board, pairs, reach, slants, pair_of, numbers)
        if count <= room:
            return pair_of[:count], numbers[:count]
        room = count


@helper
def _motion(board, i, nx, ny, x, y, sign, out):
    """Write how fast a point of an item goes along a normal, for each unknown."""
    ex, ey = x - board.places[i, 0], y - board.places[i, 1]
    arm = distances.arm(board, i)
    out[0], out[1] = sign * nx, sign * ny
    out[2] = sign * (ex * ny - ey * nx) / arm
    out[3] = sign * (ex * nx + ey * ny) / arm


@helper
def constraint_rows(board, pairs, pair_of, numbers, where, trust, gap):
    """Contacts as rows of a programme, lengths in units of ``trust``.

    ``where``: each solid's number in the programme, -1 if it stands still. Rows that no
    step within the trust region can reach are left out.
    """
    most = pair_of.shape[0]
    first, second = np.empty(most, np.int64), np.empty(most, np.int64)
    coefficients, limits = np.zeros((most, 8)), np.empty(most)
    count = 0
    for k in range(most):
        i, j = pairs[pair_of[k], 0], pairs[pair_of[k], 1]
        a, b = where[i], where[j]
        if a < 0 and b < 0:
            continue
        nx, ny = numbers[k, 0], numbers[k, 1]
        row = coefficients[count]
        for c in range(8):
            row[c] = 0.0
        part = 0
        if a >= 0:
            _motion(board, i, nx, ny, numbers[k, 2], numbers[k, 3], -1.0, row[:4])
            part = 4
        if b >= 0:
            _motion(board, j, nx, ny, numbers[k, 4], numbers[k, 5], 1.0, row[part : part + 4])
        limits[count] = max(numbers[k, 6] - gap, 0.0) / trust
        reach = 0.0
        for c in range(8):
            reach += abs(row[c])
        if limits[count] < reach:
            first[count], second[count] = (a, b) if a >= 0 else (b, -1)
            count += 1
    return interior_point.Rows(first[:count], second[:count], coefficients[:count], limits[:count])


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
        worth = objective.weights[i] * np.exp(objective.power * growth) * most
        down, up = (objective.smallest[i] - growth) / most, (objective.largest[i] - growth) / most
        step = min(MOST_GROWTH / most, 1.0)
        if down > 0.0:
            worth *= RETURN_WEIGHT
            down = 0.0
        elif up < 0.0:
            worth *= -RETURN_WEIGHT
            down, up = up, 0.0
        gain[4 * k + 3] = worth
        low[4 * k + 3], high[4 * k + 3] = max(down, -step), min(up, step)
        for c in (2, 3):
            low[4 * k + c], high[4 * k + c] = min(low[4 * k + c], 0.0), max(high[4 * k + c], 0.0)
    return gain, low, high


@helper
def mark_conflicts(board, pairs, gap, changed, struck, room):
    """Mark solids in conflict; only pairs of which one has ``changed`` can be. Number of pairs."""
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
def _solids(pairs, marks):
    """Solids of some pairs, each once; ``marks``, one for each of all, are lost."""
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
    # Only what is in the pairs is looked at: work must not grow with all solids.
    strikes = np.empty(board.starts.shape[0] - 1, np.int64)
    changed, struck = np.empty(strikes.shape[0], np.bool_), np.empty(strikes.shape[0], np.bool_)
    solids = _solids(pairs, strikes)
    for i in solids:
        strikes[i], changed[i], struck[i] = 0, True, False
    place = np.empty((1, 4))
    room = np.empty((2, distances.most_points(board.starts, pairs)), np.int64)
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
        for i in solids:
            strikes[i] += struck[i]
            changed[i] = struck[i]
    return False


@helper
def apply_step(board, items, step, pairs, gap, trust):
    """Move ``items`` by as much of ``step`` as leaves no conflict; how many halvings.

    Curves that the linear programme took for straight leave conflicts far smaller than
    the step: items in one are made a little smaller rather than sent back. -1 if the
    step was given up and nothing has moved.
    """
    n = items.shape[0]
    before, unit = np.empty((n, 4)), np.empty(n)
    for k in range(n):
        for c in range(4):
            before[k, c] = board.places[items[k], c]
        unit[k] = min(
            FIRST_CUT * trust / distances.arm(board, items[k]), LAST_CUT / 2.0 ** (CUTS - 1)
        )
    for halving in range(HALVINGS):
        if _apply_share(board, items, before, step, 0.5**halving, pairs, gap, unit):
            return halving
    distances.put(board, items, before)
    return -1


@helper
def near_contacts(board, items, pairs, trust, gap, hair):
    """Contacts within reach of a step, each solid's number in the programme, the gap to keep."""
    slants = np.empty(pairs.shape[0])
    last = board.starts.shape[0] - 2
    mean = 0.0
    for p in range(pairs.shape[0]):
        slants[p] = LEAST_SLANT
        for i in (pairs[p, 0], pairs[p, 1]):
            if i != last:
                slants[p] += trust / distances.arm(board, i)
        slants[p] = min(slants[p], 1.0)
    where = np.empty(last + 1, np.int64)
    for p in range(pairs.shape[0]):
        where[pairs[p, 0]] = where[pairs[p, 1]] = -1
    for k in range(items.shape[0]):
        where[items[k]] = k
        mean += distances.arm(board, items[k]) / items.shape[0]
    pair_of, numbers = all_contacts(board, pairs, gap + REACH * trust, slants)
    kept = gap + (TIGHT - 1.0) * hair + BEND * trust * trust / mean
    return pair_of, numbers, where, kept


@kernel
def rows_of(board, items, pairs, trust, gap, hair):
    """Rows of the programme that keep ``items`` apart, from each other and what stands still."""
    pair_of, numbers, where, kept = near_contacts(board, items, pairs, trust, gap, hair)
    return constraint_rows(board, pairs, pair_of, numbers, where, trust, kept)


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
    room = np.empty((2, distances.most_points(board.starts, pairs)), np.int64)
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
