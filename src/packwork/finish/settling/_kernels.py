"""One step down a potential: contacts, the linear programme over them, the exact check.

Sizes stay as they are. What the programme took for straight and was not is kept out by a
condition that bends keep away from; items that meet all the same stay where they were.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from packwork.finish import _kernels as rounds
from packwork.finish.contact import _kernels as contact
from packwork.finish.programme import _kernels as programme

ACCURACY = 0.05
"""Share of the way down that a programme may miss. Smaller costs time; larger leaves items
hanging in the middle of their room. Tried."""

CHECKS = 24
"""Checks of one step before it is halved for all. As of the finish, but here an item in
conflict goes back at once, and those behind it follow one by one. Chosen."""

HALVINGS = 4
"""Halvings before the whole step is given up. Chosen."""


@njit(cache=True, nogil=True, error_model="numpy")
def best_step(board, slope, backmost, foremost, items, pairs, trust, gap, hair):
    """Change of place of ``items`` that goes down most and keeps the contacts apart, nearly.

    ``slope``: ``(m, 2)`` what a move by one canvas unit costs, by x and y, a row for each of
    ``items``; ``backmost``, ``foremost``: bounds of the turn of every solid.
    """
    n = items.shape[0]
    who, numbers, where, kept = rounds.near_contacts(board, items, pairs, trust, gap, hair)
    rows = rounds.conditions(board, pairs, who, numbers, where, trust, kept)
    gain, low, high = np.zeros(4 * n), np.zeros(4 * n) - 1.0, np.zeros(4 * n) + 1.0
    for k in range(n):
        i = items[k]
        most = trust / contact.arm(board, i)
        gain[4 * k], gain[4 * k + 1] = -slope[k, 0], -slope[k, 1]
        turn = board.places[i, 2]
        low[4 * k + 2] = min(max((backmost[i] - turn) / most, -1.0), 0.0)
        high[4 * k + 2] = max(min((foremost[i] - turn) / most, 1.0), 0.0)
        low[4 * k + 3] = high[4 * k + 3] = 0.0
    z = programme.maximise(rows, gain, low, high, ACCURACY)
    step = np.zeros((n, 4))
    for k in range(n):
        for c in range(3):
            # An interior point is a little off its bounds: what may not turn would.
            share = min(max(z[4 * k + c], low[4 * k + c]), high[4 * k + c])
            step[k, c] = share * trust / (contact.arm(board, items[k]) if c > 1 else 1.0)
    return step


@njit(cache=True, nogil=True, error_model="numpy")
def _move_share(board, items, before, step, share, pairs, gap):
    """Move by a share of a step; items in conflict go back. False if some stay in conflict."""
    went_back = np.zeros(board.starts.shape[0] - 1, np.bool_)
    changed, struck = ~went_back, went_back.copy()
    room = np.empty((2, contact.most_points(board.starts)), np.int64)
    place = np.empty((1, 4))
    for check in range(CHECKS):
        for k in range(items.shape[0]):
            i = items[k]
            if not changed[i] or (check > 0 and went_back[i]):
                continue
            went_back[i] = check > 0
            for c in range(4):
                place[0, c] = before[k, c] + (0.0 if check > 0 else share * step[k, c])
            contact.put(board, items[k : k + 1], place)
        if rounds.strike(board, pairs, gap, changed, struck, room) == 0:
            return True
        changed[:] = struck
    return False


@njit(cache=True, nogil=True, error_model="numpy")
def move(board, items, step, pairs, gap):
    """Move ``items`` by as much of ``step`` as leaves no conflict; False if nobody moved."""
    n = items.shape[0]
    before = np.empty((n, 4))
    for k in range(n):
        for c in range(4):
            before[k, c] = board.places[items[k], c]
    for halving in range(HALVINGS):
        if _move_share(board, items, before, step, 0.5**halving, pairs, gap):
            return True
    contact.put(board, items, before)
    return False
