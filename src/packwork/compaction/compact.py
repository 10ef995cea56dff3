"""Compaction: the best small step of some items by a linear programme over their contacts.

Z. Li and V. Milenkovic, "Compaction and separation algorithms for non-convex polygons and their
applications", European Journal of Operational Research 84 (1995), 539-561,
doi:10.1016/0377-2217(95)00021-H: positions of polygons as unknowns, contacts as linear
constraints, solved again about each new layout. That sizes grow and items turn in the same
programme is as in the adaptive shrinking cell of S. Torquato and Y. Jiao, "Dense packings of the
Platonic and Archimedean solids", Nature 460 (2009), 876-879, doi:10.1038/nature08239, and in
"Robust algorithm to generate a diverse class of dense disordered and ordered sphere packings via
linear programming", Physical Review E 82 (2010), 061302, doi:10.1103/PhysRevE.82.061302; where
their cell shrinks round particles, our items grow in a container that stays.

Ours differs from both: constraints bind vertices to edges and corners that they see, no no-fit
polygons are made; programmes are over blocks of neighbours; and each step is checked in exact
geometry and cut until no conflict is left.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from packwork.arrays import IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.blocks import blocks, colours
from packwork.compaction.kernels import distances
from packwork.compaction.kernels.steps import TRAVEL, Objective
from packwork.compaction.kernels.trials import Rounds, Trial, attempt
from packwork.threads import at_once

NONE = np.empty(0, np.int64)
"""No items."""


def compact(
    arrangement: Arrangement,
    objective: Objective,
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
    items
        ``(m,)`` indices of those that move, neighbours near each other in the list.
    trust
        Bound of each move, and of turns and growths at an item's farthest vertex.
    gap
        Least distance that the check asks for.
    hair
        The part of it that was not asked for.
    """
    near = distances.nearby(arrangement.board.boxes, items, gap + TRAVEL * trust)
    return _compacted(arrangement, objective, items, near, trust, gap, hair)


def compact_all(
    arrangement: Arrangement,
    objective: Objective,
    turn: int,
    trust: float,
    gap: float,
    hair: float,
    stop: Callable[[], bool] = bool,
) -> None:
    """Move all items by blocks of neighbours, those at once that do not touch.

    Parameters
    ----------
    turn
        Number of the round: others are cut elsewhere.
    stop
        Asked before each group of blocks that are moved at once; True leaves the others.
    """
    boxes = arrangement.board.boxes
    # What stands still is looked at from as far as two items come nearer; what moves, farther.
    reach = gap + 2 * TRAVEL * trust
    for group in colours(blocks(arrangement.places[:, :2], turn), boxes, reach):
        if stop():
            return
        near = [distances.nearby(boxes, items, gap + TRAVEL * trust) for items in group]
        calls = [
            (arrangement, objective, items, about, trust, gap, hair)
            for items, about in zip(group, near, strict=True)
        ]
        at_once(_compacted, calls)


def _compacted(
    arrangement: Arrangement,
    objective: Objective,
    items: IntArray,
    near: IntArray,
    trust: float,
    gap: float,
    hair: float,
) -> bool:
    """Move some items, of which no others than ``near`` ones are near; False if nowhere."""
    board = arrangement.board
    plain = Trial(NONE, np.empty((0, 0, 4)), items, near, np.empty((0, 4)))
    rounds = Rounds(trust, np.full(1, trust), np.full(1, np.inf))
    return bool(attempt(board, objective, plain, rounds, np.inf, -np.inf, gap, hair) > -np.inf)
