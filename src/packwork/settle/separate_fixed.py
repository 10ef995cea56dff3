"""Separation at fixed sizes: items that nearly lie clear of each other are moved apart.

Items in conflict shrink and grow back by compaction; those that do not reach their size again
are told.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.compact import compact_all
from packwork.compaction.kernels.steps import MOST_GROWTH
from packwork.compaction.objective import FixedSize
from packwork.compaction.separate import separate

ROUNDS = 20
"""Rounds in which items that were shrunk to come free may grow back. More rescue a few more
of a bad layout. Chosen."""

TRUST = 0.1
"""Bound of a move in such a round, in sides of the square of an item's share. Chosen."""


def separate_fixed(
    arrangement: Arrangement, turns: tuple[FloatArray, FloatArray], gap: float, hair: float
) -> IntArray:
    """Separate items at the sizes given; ``(m,)`` indices of those that found no room.

    ``turns``: farthest turns back and on, ``(n,)`` each, rad.

    Those stand where they were, in conflict or not: they have to be placed anew.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[9.0, 0, 0], [0, 9.0, 0]]))
    >>> two = Arrangement([box] * 2, wall, np.array([[0.0, 0, 0, 0], [1.9, 0, 0, 0]]))
    >>> still = np.zeros(2), np.zeros(2)
    >>> len(separate_fixed(two, still, 1e-3, 1e-3)), len(two.conflicts(two.pairs(1e-3), 1e-3))
    (0, 0)
    """
    first = arrangement.places.copy()
    all_items = np.arange(arrangement.count)
    separate(arrangement, gap)
    sizing = FixedSize(np.square(arrangement.board.arms), turns)
    trust = TRUST * float(np.sqrt(np.pi * np.mean(arrangement.board.arms**2)))
    for turn in range(ROUNDS):
        growth = arrangement.places[:, 3]
        if sizing.is_done(growth):
            break
        objective = sizing.objective(
            growth, min(trust / float(np.median(arrangement.radii)), MOST_GROWTH)
        )
        compact_all(arrangement, objective, turn, trust, gap, hair)
    short = np.flatnonzero(arrangement.places[:, 3] < 0)
    places = arrangement.places.copy()
    places[short] = first[short]
    places[:, 3] = 0.0
    arrangement.put(all_items, places)
    return short
