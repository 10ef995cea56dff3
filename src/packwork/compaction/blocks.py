"""Blocks of neighbouring items, for which compaction is solved one after another.

By recursive bisection along the longer side (M. Berger and S. Bokhari, "A partitioning strategy
for nonuniform problems on multiprocessors", IEEE Transactions on Computers C-36 (1987), 570-580),
cut elsewhere in each round.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray

MOST_IN_BLOCK = 128
"""Items solved together. Larger lets moves travel farther and costs more an item, smaller
the other way round. Tried."""

FRACTIONS = (0.5, 0.38, 0.62, 0.44, 0.56)
"""Where blocks are cut, round by round, so that no border lasts. Chosen."""


def blocks(positions: FloatArray, turn: int, most: int = MOST_IN_BLOCK) -> list[IntArray]:
    """Indices of items in blocks of at most ``most``, each sorted along its longer side.

    Parameters
    ----------
    positions
        ``(n, 2)``.
    turn
        Number of the round: other numbers cut elsewhere.

    Examples
    --------
    >>> line = np.column_stack([np.arange(6.0), np.zeros(6)])
    >>> [block.tolist() for block in blocks(line, 0, 3)]
    [[0, 1, 2], [3, 4, 5]]
    """
    fraction = FRACTIONS[turn % len(FRACTIONS)]
    found: list[IntArray] = []
    waiting = [np.arange(len(positions))]
    while waiting:
        items = waiting.pop()
        spans = np.ptp(positions[items], axis=0) if len(items) else np.zeros(2)
        order = np.argsort(positions[items, int(spans[1] > spans[0])], kind="stable")
        items = items[order]
        if len(items) <= most:
            found.append(items)
            continue
        cut = int(np.clip(round(fraction * len(items)), 1, len(items) - 1))
        waiting += [items[cut:], items[:cut]]
    return found


def colours(found: list[IntArray], boxes: FloatArray, reach: float) -> list[list[IntArray]]:
    """Blocks in groups of which no two come within ``reach``, in the order of their firsts.

    Greedy colouring of the graph of neighbours (D. Welsh and M. Powell, "An upper bound for the
    chromatic number of a graph", The Computer Journal 10 (1967), 85-86), without their order.

    Parameters
    ----------
    boxes
        ``(n, 4)`` left, top, right, bottom of all items.

    Examples
    --------
    >>> side_by_side = np.array([[x, 0.0, x + 1, 1.0] for x in range(4)])
    >>> [len(group) for group in colours([np.array([k]) for k in range(4)], side_by_side, 0.5)]
    [2, 2]
    """
    least = np.array([boxes[block, :2].min(axis=0) for block in found]) - reach
    most = np.array([boxes[block, 2:].max(axis=0) for block in found])
    begins_before = (least[:, None] <= most[None]).all(axis=2)
    meets = np.logical_and(begins_before, begins_before.T)
    colour = np.zeros(len(found), np.int64)
    for k in range(1, len(found)):
        taken = set(colour[:k][meets[k, :k]].tolist())
        colour[k] = next(one for one in range(k + 1) if one not in taken)
    return [[found[k] for k in np.flatnonzero(colour == one)] for one in range(colour.max() + 1)]
