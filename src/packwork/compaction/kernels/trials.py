"""Trials: items put elsewhere, cleared of conflicts, and compacted with what lies about them.

All that a trial reads and writes lies in its neighbourhood. Trials whose neighbourhoods do not
meet may be made at once, in any order and by any number of threads: they come out the same.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from packwork.compaction.kernels import broad_phase, contacts, distances, interior_point, steps
from packwork.compiled import helper, kernel, leaf

CUT, CHECKS = 0.06, 25
"""Logarithm of size that moved items lose at a time while they are in conflict, and how often.
Chosen."""

FINALISTS = 2
"""Places in which the moved items grow, of those where they come clear at the largest size. More
take longer and find little. Tried."""


class Trial(NamedTuple):
    """Trial move: items, and poses that are tried for them.

    ``moved``: ``(m,)`` items that are put elsewhere, none in plain compaction; ``places``: ``(k, m,
    4)``, of which the best is taken; ``items``: ``(n,)`` those that move afterwards, the moved ones
    among them, neighbours near each other; ``near``: ``(r,)`` all that they may come near,
    ascending; ``bounds``: ``(n, 4)`` boxes that they must not leave, or ``(0, 4)``.
    """

    moved: np.ndarray
    places: np.ndarray
    items: np.ndarray
    near: np.ndarray
    bounds: np.ndarray


class Rounds(NamedTuple):
    """Trust regions of a trial's linear programmes, canvas units.

    ``alone``: of the moved items; ``together``: of all that move; ``missing``: value that may be
    missing when each of these begins.
    """

    alone: float
    together: np.ndarray
    missing: np.ndarray


@leaf
def objective_value(board, objective, items):
    """Objective value of some items together; less for those out of their bounds."""
    total = 0.0
    for i in items:
        growth = board.places[i, 3]
        value = objective.weights[i] * math.exp(objective.power * growth)
        below = max(objective.smallest[i] - growth, 0.0)
        above = max(growth - objective.largest[i], 0.0)
        total += value / objective.power - steps.RETURN_WEIGHT * value * (below + above)
    return total


@leaf
def _shortfall(board, objective, items):
    """Sum of how far some items are below their smallest sizes, logarithms."""
    total = 0.0
    for i in items:
        total += max(objective.smallest[i] - board.places[i, 3] - interior_point.ROUNDING, 0.0)
    return total


@leaf
def _least(board, items):
    least = np.inf
    for i in items:
        least = min(least, board.places[i, 3])
    return least


@leaf
def _keep(board, items, places):
    for k in range(items.shape[0]):
        for c in range(4):
            places[k, c] = board.places[items[k], c]


@leaf
def _are_within(board, items, bounds):
    for k in range(bounds.shape[0]):
        if broad_phase.sticks_out(board.boxes[items[k]], bounds[k]):
            return False
    return True


@helper
def _clear_all(board, objective, trial, places, values, gap):
    """Write places of the moved items, shrunk until clear there, and the objective value of each.

    -inf where they do not come clear.
    """
    for k in range(values.shape[0]):
        distances.put(board, trial.moved, trial.places[k])
        pairs = broad_phase.pairs_among(board.boxes, trial.moved, trial.near, gap)
        values[k] = -np.inf
        if steps.clear_by_shrinking(board, trial.moved, pairs, gap, CUT, np.int64(CHECKS)):
            values[k] = objective_value(board, objective, trial.moved)
            _keep(board, trial.moved, places[k])


@helper
def _put_next(board, moved, places, values):
    """Put the moved items where they come clear at the next largest value; False if nowhere."""
    best = 0
    for k in range(values.shape[0]):
        if values[k] > values[best]:
            best = k
    if values[best] == -np.inf:
        return False
    values[best] = -np.inf
    distances.put(board, moved, places[best])
    return True


@kernel
def attempt(board, objective, trial, rounds, allowed, least, gap, hair):
    """Make a trial; what it gained, or -inf where it was undone, for it gained too little.

    First the moved items grow by themselves, where they come clear at the largest sizes, all others
    standing still; from the best of those places on, all move. ``allowed``: value that it may lose;
    ``least``: logarithm of size that none may end below. Plain compaction is not undone; -inf says
    that nothing could move.
    """
    items, moved, count = trial.items, trial.moved, trial.places.shape[0]
    before, chosen = np.empty((items.shape[0], 4)), np.empty((moved.shape[0], 4))
    places, values = np.empty((count, moved.shape[0], 4)), np.empty(count)
    _keep(board, items, before)
    value, short = objective_value(board, objective, items), _shortfall(board, objective, items)
    _clear_all(board, objective, trial, places, values, gap)
    best, has_moved, goes_on = -np.inf, False, True
    firsts = min(FINALISTS, count)
    # One loop for both: what is called in two places is compiled twice.
    for p in range(firsts + rounds.together.shape[0]):
        is_first = p < firsts
        movers = moved if is_first else items
        trust = rounds.alone if is_first else rounds.together[p - firsts]
        if is_first:
            goes_on = _put_next(board, moved, places, values)
        elif (
            value - allowed - objective_value(board, objective, items) > rounds.missing[p - firsts]
        ):
            goes_on = False
        if goes_on:
            reach = gap + steps.TRAVEL * trust
            pairs = broad_phase.pairs_among(board.boxes, movers, trial.near, reach)
            rows = contacts.rows_of(board, movers, pairs, trust, gap, hair)
            gain, low, high = steps.gains_and_bounds(board, objective, movers, trust)
            z = interior_point.maximise(rows, gain, low, high, steps.ACCURACY)
            step = steps.step_of(board, movers, z, trust)
            has_moved |= steps.apply_step(board, movers, step, pairs, gap, trust) >= 0
        if is_first and goes_on and objective_value(board, objective, moved) > best:
            best = objective_value(board, objective, moved)
            _keep(board, moved, chosen)
        if p == firsts - 1:
            goes_on = best > -np.inf
            if goes_on:
                distances.put(board, moved, chosen)
        if p >= firsts - 1:
            goes_on = goes_on and _are_within(board, items, trial.bounds)
            if not goes_on:
                break
    found = objective_value(board, objective, items) - value
    if moved.shape[0] == 0:
        return found if has_moved else -np.inf
    # What others gain does not make up for items below the size that they should have at least.
    goes_on = goes_on and found > -allowed and _least(board, items) >= least
    if goes_on and _shortfall(board, objective, items) <= short:
        return found
    distances.put(board, items, before)
    return -np.inf


class TrialBatch(NamedTuple):
    """Room for trials that may be made at once, and where each may reach.

    ``trials``: ``(c,)`` which of those that were asked for; ``items``: of all of them one after
    another, from ``begins[k, 0]`` on those of the k-th, with the boxes ``bounds`` that they must
    not leave; ``near``: from ``begins[k, 1]`` on what they may come near, ascending; ``reached``:
    from ``begins[k, 2]`` on all boxes that they may be in.
    """

    trials: np.ndarray
    begins: np.ndarray
    items: np.ndarray
    bounds: np.ndarray
    near: np.ndarray
    reached: np.ndarray


def allocate_batch(most: int, neighbours: int, count: int) -> TrialBatch:
    """Room for so many trials, with so many neighbours of each moved item, of so many polygons."""
    width = 2 * neighbours + 4
    return TrialBatch(
        np.empty(most, np.int64), np.zeros((most + 1, 3), np.int64),
        np.empty(most * width, np.int64), np.empty((most * width, 4)),
        np.empty(most * count, np.int64), np.empty((most * (width + 2), 4)),
    )  # fmt: skip


@leaf
def _away(places, j, moved, pair):
    """Squared distance of an item from the nearest of those that are moved."""
    least = np.inf
    for k in range(pair):
        x = places[j, 0] - places[moved[k], 0]
        y = places[j, 1] - places[moved[k], 1]
        least = min(least, x * x + y * y)
    return least


@helper
def _nearest_items(board, radii, moved, pair, wanted, found):
    """Write the moved items and those nearest to them, by their x; returns how many.

    What is nearest goes by distances of centres less radii, ``(n,)``.
    """
    away = np.empty(wanted)
    held, farthest = 0, np.inf
    for j in range(radii.shape[0]):
        squared = _away(board.places, j, moved, pair)
        if held == wanted and squared >= (farthest + radii[j]) ** 2 and farthest + radii[j] > 0.0:
            continue
        far = math.sqrt(squared) - radii[j]
        if held == wanted and far >= farthest:
            continue
        k = held if held < wanted else held - 1
        held = k + 1
        while k > 0 and away[k - 1] > far:
            away[k], found[k] = away[k - 1], found[k - 1]
            k -= 1
        away[k], found[k] = far, j
        farthest = away[held - 1]
    for k in range(pair):
        is_new = True
        for h in range(held):
            is_new &= found[h] != moved[k]
        if is_new:
            found[held] = moved[k]
            held += 1
    for h in range(1, held):
        item = found[h]
        k = h
        while k > 0 and (
            board.places[found[k - 1], 0] > board.places[item, 0]
            or (board.places[found[k - 1], 0] == board.places[item, 0] and found[k - 1] > item)
        ):
            found[k] = found[k - 1]
            k -= 1
        found[k] = item
    return held


@leaf
def _bound(board, item, moved, pair, places, room, bound):
    """Write the box that an item must not leave: about its disc where it is put, or its own."""
    box = board.boxes[item]
    for c in range(4):
        bound[c] = box[c] + (room if c > 1 else -room)
    for k in range(pair):
        if moved[k] == item:
            reach = board.arms[item] * math.exp(places[k, 3]) + room
            bound[0], bound[1] = places[k, 0] - reach, places[k, 1] - reach
            bound[2], bound[3] = places[k, 0] + reach, places[k, 1] + reach


@leaf
def _hull(boxes, begin, end, hull):
    hull[0] = hull[1] = np.inf
    hull[2] = hull[3] = -np.inf
    for k in range(begin, end):
        hull[0], hull[1] = min(hull[0], boxes[k, 0]), min(hull[1], boxes[k, 1])
        hull[2], hull[3] = max(hull[2], boxes[k, 2]), max(hull[3], boxes[k, 3])


@leaf
def _comes_near(boxes, begin, end, left, top, right, bottom):
    for b in range(begin, end):
        if (
            boxes[b, 0] <= right
            and boxes[b, 2] >= left
            and boxes[b, 1] <= bottom
            and boxes[b, 3] >= top
        ):
            return True
    return False


@leaf
def _meet(boxes, begin, end, hull, margin):
    """True if some boxes, all in a hull, come within a margin of those before them."""
    for b in range(begin):
        left, top = boxes[b, 0] - margin, boxes[b, 1] - margin
        right, bottom = boxes[b, 2] + margin, boxes[b, 3] + margin
        if hull[0] > right or hull[2] < left or hull[1] > bottom or hull[3] < top:
            continue
        if _comes_near(boxes, begin, end, left, top, right, bottom):
            return True
    return False


@leaf
def _add_near(boxes, begin, end, hull, board, moved, margin, near, count):
    """Write which polygons come within a margin of some boxes, all in a hull, or are moved.

    Images move with their item, to where their boxes do not lie yet.
    """
    polygons = board.boxes
    for j in range(polygons.shape[0] - 1):
        left, top = polygons[j, 0] - margin, polygons[j, 1] - margin
        right, bottom = polygons[j, 2] + margin, polygons[j, 3] + margin
        is_near = hull[0] <= right and hull[2] >= left and hull[1] <= bottom and hull[3] >= top
        if is_near:
            is_near = _comes_near(boxes, begin, end, left, top, right, bottom)
        owner = board.owners[j]
        if is_near or owner == moved[0] or owner == moved[1]:
            near[count] = j
            count += 1
    return count


@kernel
def choose_disjoint(board, radii, moved, places, neighbours, room, margin, chosen):
    """Choose the first of some trials and those after it whose neighbourhoods do not meet.

    As many as there is room for; returns how many. ``moved``: ``(p, 2)`` those that are put
    elsewhere, the second -1 for one alone; ``places``: ``(p, 2, 4)`` where; ``neighbours``: how
    many give way for each of these; ``room``: how far each may go; ``margin``: how near to what
    else.
    """
    begins, reached = chosen.begins, chosen.reached
    hull = np.empty(4)
    count = 0
    for p in range(moved.shape[0]):
        if count == chosen.trials.shape[0]:
            break
        begin, last = begins[count, 0], begins[count, 2]
        here = chosen.items[begin:]
        pair = 2 if moved[p, 1] >= 0 else 1
        wanted = min(pair * (neighbours + 1), radii.shape[0])
        held = _nearest_items(board, radii, moved[p], pair, wanted, here)
        for k in range(held):
            _bound(board, here[k], moved[p], pair, places[p], room, reached[last + k])
        for k in range(pair):
            for c in range(4):
                reached[last + held + k, c] = board.boxes[moved[p, k], c]
        end = last + held + pair
        _hull(reached, last, end, hull)
        if _meet(reached, last, end, hull, margin):
            continue
        for k in range(held):
            for c in range(4):
                chosen.bounds[begin + k, c] = reached[last + k, c]
        chosen.trials[count] = p
        count += 1
        begins[count, 0], begins[count, 2] = begin + held, end
        begins[count, 1] = _add_near(
            reached, last, last + held, hull, board, moved[p], margin, chosen.near,
            begins[count - 1, 1],
        )  # fmt: skip
    return count
