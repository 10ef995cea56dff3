"""One step down a potential: what its linear programme aims at, and the exact check.

Sizes stay as they are. What the programme took for straight and was not is kept out by a
condition that bends keep away from; items that meet all the same stay where they were.
"""

from __future__ import annotations

import numpy as np

from packwork.compaction.kernels import contacts, distances, interior_point, steps
from packwork.compiled import helper, kernel

ASIDE = 0.5
"""Bound of a move across the slope, trust regions, where an item goes straight along an axis.
Larger lets items slide off farther, and those on the diagonals outrun all others; smaller
jams. Tried."""

CUTS = 3
"""Halvings of the step of an item in conflict before it stays where it was: what bends costs
a quarter at half the way. Tried."""

CHECKS = 30
"""Checks of one step before it is halved for all. As of the finish, but here those behind an
item that goes back follow one by one. Chosen."""


@kernel
def gains_and_bounds(board, slope, backmost, foremost, items, trust):
    """Gains and bounds of the unknowns, lengths in units of ``trust``.

    ``slope``: ``(m, 2)`` what a move by one canvas unit costs, by x and y, a row for each of
    ``items``; ``backmost``, ``foremost``: bounds of the turn of every polygon.
    """
    n = items.shape[0]
    gain, low, high = np.zeros(4 * n), np.zeros(4 * n), np.zeros(4 * n)
    for k in range(n):
        i = items[k]
        most = trust / distances.arm(board, i)
        steepness = max(np.hypot(slope[k, 0], slope[k, 1]), 1e-300)
        for c in range(2):
            gain[4 * k + c] = -slope[k, c]
            # As far down in all directions: a box alone would favour the diagonals.
            high[4 * k + c] = max(abs(slope[k, c]) / steepness, ASIDE)
            low[4 * k + c] = -high[4 * k + c]
        turn = board.places[i, 2]
        low[4 * k + 2] = min(max((backmost[i] - turn) / most, -1.0), 0.0)
        high[4 * k + 2] = max(min((foremost[i] - turn) / most, 1.0), 0.0)
    return gain, low, high


@kernel
def circle_about(board, items, centre):
    """Radius of the circle about a point that holds ``items``."""
    most = 0.0
    for k in range(items.shape[0]):
        for v in range(board.starts[items[k]], board.starts[items[k] + 1]):
            x, y = board.points[v, 0] - centre[0], board.points[v, 1] - centre[1]
            most = max(most, x * x + y * y)
    return np.sqrt(most)


@helper
def _tops(board, items, centre, least, item_of, numbers):
    """Write the points farther off than ``least`` that are farther than those beside them.

    ``numbers``: distance and unit normal of each; returns how many.
    """
    count = 0
    for k in range(items.shape[0]):
        for v in range(board.starts[items[k]], board.starts[items[k] + 1]):
            x, y = board.points[v, 0] - centre[0], board.points[v, 1] - centre[1]
            far = np.hypot(x, y)
            if far < least:
                continue
            is_top = True
            for w in (board.before[v], board.after[v]):
                if np.hypot(board.points[w, 0] - centre[0], board.points[w, 1] - centre[1]) > far:
                    is_top = False
            if is_top:
                if count < item_of.shape[0]:
                    item_of[count] = k
                    numbers[count, 0], numbers[count, 1], numbers[count, 2] = far, x / far, y / far
                count += 1
    return count


@kernel
def with_circle(board, items, rows, centre, circle, trust):
    """Rows and those that keep ``items`` in a circle, whose radius is one item more."""
    n, m = items.shape[0], rows.first.shape[0]
    room = 16 * n + 64
    while True:
        item_of, numbers = np.empty(room, np.int64), np.empty((room, 3))
        count = _tops(board, items, centre, circle - contacts.REACH * trust, item_of, numbers)
        if count <= room:
            break
        room = count
    first, second = np.empty(m + count, np.int64), np.empty(m + count, np.int64)
    coefficients, limits = np.zeros((m + count, 8)), np.empty(m + count)
    first[:m], second[:m] = rows.first, rows.second
    coefficients[:m], limits[:m] = rows.coefficients, rows.limits
    for k in range(count):
        i = items[item_of[k]]
        far, nx, ny = numbers[k, 0], numbers[k, 1], numbers[k, 2]
        first[m + k], second[m + k] = item_of[k], n
        ex = centre[0] + far * nx - board.places[i, 0]
        ey = centre[1] + far * ny - board.places[i, 1]
        coefficients[m + k, 0], coefficients[m + k, 1] = nx, ny
        coefficients[m + k, 2] = (ex * ny - ey * nx) / distances.arm(board, i)
        coefficients[m + k, 4] = -1.0
        limits[m + k] = max(circle - far, 0.0) / trust
    return interior_point.Rows(first, second, coefficients, limits)


@helper
def _move_share(board, items, before, step, share, pairs, gap):
    """Move by a share of a step; items in conflict go half as far, then back.

    False if some stay in conflict.
    """
    hits = np.zeros(board.starts.shape[0] - 1, np.int64)
    changed, struck = hits == 0, hits > 0
    room = distances.room_for(distances.most_points(board.starts, pairs))
    place = np.empty((1, 4))
    for _ in range(CHECKS):
        for k in range(items.shape[0]):
            i = items[k]
            if not changed[i]:
                continue
            factor = share * 0.5 ** hits[i] if hits[i] <= CUTS else 0.0
            for c in range(4):
                place[0, c] = before[k, c] + factor * step[k, c]
            distances.put(board, items[k : k + 1], place)
        if steps.mark_conflicts(board, pairs, gap, changed, struck, room) == 0:
            return True
        for i in range(hits.shape[0]):
            hits[i] += struck[i]
            changed[i] = struck[i]
    return False


@kernel
def move(board, items, step, pairs, gap):
    """Move ``items`` by as much of ``step`` as leaves no conflict; False if nothing moved."""
    n = items.shape[0]
    before = np.empty((n, 4))
    for k in range(n):
        for c in range(4):
            before[k, c] = board.places[items[k], c]
    for halving in range(steps.HALVINGS):
        if _move_share(board, items, before, step, 0.5**halving, pairs, gap):
            return True
    distances.put(board, items, before)
    return False
