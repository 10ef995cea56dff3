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
