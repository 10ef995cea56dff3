"""Compaction: the best small step of some items by a linear programme over their contacts.

Z. Li and V. Milenkovic (1995, see :mod:`packwork.compaction`): positions of polygons as unknowns,
contacts as linear constraints, solved again about each new layout. That sizes grow and items turn
in the same programme is as in the adaptive shrinking cell of S. Torquato and Y. Jiao, "Dense
packings of the Platonic and Archimedean solids", Nature 460 (2009), 876-879,
doi:10.1038/nature08239, and in "Robust algorithm to generate a diverse class of dense disordered
and ordered sphere packings via linear programming", Physical Review E 82 (2010), 061302,
doi:10.1103/PhysRevE.82.061302; where their cell shrinks round particles, our items grow in a
container that stays.

Ours differs from both: constraints bind vertices to edges and corners that they see, no no-fit
polygons are made; each step is checked in exact geometry and cut until no conflict is left; and
programmes are over blocks of neighbours, by recursive bisection along the longer side (M. Berger
and S. Bokhari, "A partitioning strategy for nonuniform problems on multiprocessors", IEEE
Transactions on Computers C-36 (1987), 570-580), cut elsewhere in each round.

Programmes are over items that move and turn, or only move: half as many unknowns.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels import broad_phase, interior_point
from packwork.compaction.kernels.steps import TRAVEL, Objective
from packwork.compaction.kernels.trials import Rounds, Trial, attempt
from packwork.threads import at_once

NONE = np.empty(0, np.int64)
"""No items."""


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

    The arrangement, changed in place, has no conflicts and gets none. Blocks are cut elsewhere in
    each ``turn``. ``trust``: bound of each move, and of turns and growths at an item's farthest
    vertex; ``gap``: least distance that the check asks for, ``hair`` the part of it that was not
    asked for. ``stop`` is asked before each group of blocks that are moved at once.
    """
    boxes = arrangement.board.boxes
    # What stands still is looked at from as far as two items come nearer; what moves, farther.
    # Where items repeat, one block at a time: on the other side any two may be neighbours.
    reach = gap + 2 * TRAVEL * trust if arrangement.lattice is None else np.inf
    for group in disjoint_groups(blocks(arrangement.places[:, :2], turn), boxes, reach):
        if stop():
            return
        near = [broad_phase.nearby(boxes, items, gap + TRAVEL * trust) for items in group]
        calls = [
            (arrangement, objective, items, about, trust, gap, hair)
            for items, about in zip(group, near, strict=True)
        ]
        at_once(_compact_block, calls)


def _compact_block(
    arrangement: Arrangement,
    objective: Objective,
    items: IntArray,
    near: IntArray,
    trust: float,
    gap: float,
    hair: float,
) -> None:
    """Move some items, of which no others than ``near`` ones are near, as far as it goes."""
    board = arrangement.board
    plain = Trial(NONE, np.empty((0, 0, 4)), items, near, np.empty((0, 4)))
    rounds = Rounds(trust, np.full(1, trust), np.full(1, np.inf))
    attempt(board, objective, plain, rounds, np.inf, -np.inf, gap, hair)


MOST_IN_BLOCK = 128
"""Items solved together. Larger lets moves travel farther and costs more an item. Tried."""

FRACTIONS = (0.5, 0.38, 0.62, 0.44, 0.56)
"""Where blocks are cut, round by round, so that no border lasts. Chosen."""


def blocks(positions: FloatArray, turn: int, most: int = MOST_IN_BLOCK) -> list[IntArray]:
    """Indices of items in blocks of at most ``most``, each sorted along its longer side.

    ``positions``: ``(n, 2)``; ``turn``: number of the round, others are cut elsewhere.

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


def disjoint_groups(found: list[IntArray], boxes: FloatArray, reach: float) -> list[list[IntArray]]:
    """Blocks in groups of which no two come within ``reach``, in the order of their firsts.

    Greedy colouring of the graph of neighbours (D. Welsh and M. Powell, "An upper bound for the
    chromatic number of a graph", The Computer Journal 10 (1967), 85-86), without their order.
    ``boxes``: ``(n, 4)`` left, top, right, bottom.

    >>> row = np.array([[x, 0.0, x + 1, 1.0] for x in range(4)])
    >>> [len(group) for group in disjoint_groups([np.array([k]) for k in range(4)], row, 0.5)]
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


def maximised(
    rows: interior_point.Rows, gain: FloatArray, low: FloatArray, high: FloatArray, accuracy: float
) -> FloatArray:
    """Nearly the best unknowns, four an item; of items that only move, two are solved for."""
    if (high - low).reshape(-1, 4)[:, 2:].any():
        return np.asarray(interior_point.maximise(rows, gain, low, high, accuracy))
    n = len(gain) // 4
    moves = [np.zeros(4 * (-(-n // 2))) for _ in range(3)]
    for some, four in zip(moves, (gain, low, high), strict=True):
        some[: 2 * n] = four.reshape(-1, 4)[:, :2].ravel()
    z = np.zeros((n, 4))
    found = interior_point.maximise(in_twos(rows), *moves, accuracy)
    z[:, :2] = found[: 2 * n].reshape(-1, 2)
    return z.ravel()


def in_twos(rows: interior_point.Rows) -> interior_point.Rows:
    """Rows in which two items that only move, one after another, count as one with four unknowns.

    The Newton matrix is half as long and its band half as wide.

    Examples
    --------
    >>> both = np.array([[1.0, 2, 0, 0, 3, 4, 0, 0]])
    >>> rows = interior_point.Rows(np.array([0]), np.array([3]), both, np.ones(1))
    >>> two = in_twos(rows)
    >>> two.first.tolist(), two.second.tolist(), two.coefficients.tolist()
    ([0], [1], [[1.0, 2.0, 0.0, 0.0, 0.0, 0.0, 3.0, 4.0]])
    """
    first, second = rows.first, rows.second
    is_one = (second < 0) | (first // 2 == second // 2)
    coefficients = np.zeros_like(rows.coefficients)
    every = np.arange(len(first))
    for c in range(2):
        coefficients[every, 2 * (first % 2) + c] = rows.coefficients[:, c]
        touched = np.flatnonzero(second >= 0)
        behind = np.where(is_one, 0, 4) + 2 * (second % 2) + c
        coefficients[touched, behind[touched]] = rows.coefficients[touched, 4 + c]
    return interior_point.Rows(
        first // 2, np.where(is_one, -1, second // 2), coefficients, rows.limits
    )
