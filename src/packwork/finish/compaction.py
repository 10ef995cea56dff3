"""Rounds of small best steps: items make room for each other and grow into it."""

from __future__ import annotations

import numpy as np

from packwork.arrays import IntArray
from packwork.finish import _kernels
from packwork.finish._kernels import ACCURACY, RETURN_WEIGHT, TRAVEL, Wishes
from packwork.finish.arrangement import Arrangement
from packwork.finish.contact import _kernels as contact
from packwork.finish.programme import _kernels as programme


def compact(
    arrangement: Arrangement,
    wishes: Wishes,
    items: IntArray,
    trust: float,
    gap: float,
    hair: float,
) -> bool:
    """Move some items by the best step for them all, as far as it goes; False if nowhere.

    The arrangement has no conflicts and gets none.

    Parameters
    ----------
    arrangement
        Changed in place.
    wishes
        Bounds and worths of all items.
    items
        Those that move, neighbours near each other in the list.
    trust
        Bound of each move, and of turns and growths at an item's farthest vertex.
    gap
        Least distance that the check asks for.
    hair
        The part of it that nobody asked for.
    """
    board = arrangement.board
    pairs = contact.pairs_of(board.boxes, items, gap + TRAVEL * trust)
    # One after another, not in one kernel: what several steps share is compiled once.
    rows = _kernels.rows_of(board, items, pairs, trust, gap, hair)
    z = programme.maximise(rows, *_kernels.freedoms(board, wishes, items, trust), ACCURACY)
    step = _kernels.step_of(board, items, z, trust)
    return bool(_kernels.settle(board, items, step, pairs, gap, trust) >= 0)


def worth(arrangement: Arrangement, wishes: Wishes, items: IntArray) -> float:
    """What some items are worth together; less for those out of their bounds.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> one = Arrangement([box], box, np.zeros((1, 4)))
    >>> free = np.full(1, 9.0)
    >>> areas = Wishes(-free, free, -free, free, 2 * np.full(1, box.area), 2.0, np.zeros((1, 2)))
    >>> worth(one, areas, np.array([0]))
    4.0
    """
    growth = arrangement.places[items, 3]
    value = wishes.weights[items] * np.exp(wishes.power * growth)
    below = np.maximum(wishes.smallest[items] - growth, 0.0)
    above = np.maximum(growth - wishes.largest[items], 0.0)
    return float((value / wishes.power - RETURN_WEIGHT * value * (below + above)).sum())
