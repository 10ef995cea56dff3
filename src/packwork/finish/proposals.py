"""Proposals of annealing: which items are turned or exchanged, and where they are put."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels.steps import Objective
from packwork.finish.objective import ForceTerm

ANGLES = 5
"""Angles of which the best is tried, by how far the moved items grow alone. More find
better ones and cost more. Tried."""

EXCHANGES = 0.5
"""Share of trials that exchange two items instead of turning one. Tried."""

SMALL_TURNED, SMALL_EXCHANGED = 0.8, 0.5
"""Shares of the items, the smallest, that are turned and exchanged: larger ones gain little.
Measured."""

ALIKE = 24
"""How many items nearest in size are considered for an exchange. Tried."""

WITH_FORCES = 0.5
"""Share of exchanges with the item that forces like best there, where there are forces. Tried."""

BEHIND, BEHIND_SHARE = 0.125, 0.7
"""Where the smallest is worth most: share of the items that are the smallest, and share of the
turns that are theirs. Larger leaves none to their neighbours. Tried."""

LOSS = 0.1
"""Logarithm of size that moved items begin with less. Tried."""


class Pools(NamedTuple):
    """Items that trials are made of, as they are now.

    ``radii``: ``(n,)`` of all; ``first``, ``share``: those that are turned first, and in which
    share of turns it is one of them; ``exchanged``: those that change places with another one.
    """

    radii: FloatArray
    first: IntArray
    share: float
    exchanged: IntArray


class Proposal(NamedTuple):
    """A trial that is to be made.

    ``moved``: ``(1,)`` item that is turned, or ``(2,)`` that change places; ``draws``:
    ``(angles, items)`` for the angles, 0 to 1; ``heat``: for what it may lose, 1 in the mean.
    """

    moved: IntArray
    draws: FloatArray
    heat: float


def pools_of(arrangement: Arrangement, smallest_counts: bool, is_forced: bool) -> Pools:
    """Items that trials are made of: small ones, which have somewhere to go.

    Those that have grown least come first where ``smallest_counts``; forces have aims with large
    ones too.
    """
    radii, everyone = arrangement.radii, np.arange(arrangement.count)
    if smallest_counts:
        by_growth = np.argsort(arrangement.places[:, 3], kind="stable")
        return Pools(radii, _some(by_growth, BEHIND), BEHIND_SHARE, everyone)
    if is_forced:
        return Pools(radii, everyone, 1.0, everyone)
    by_size = np.argsort(radii, kind="stable")
    return Pools(radii, _some(by_size, SMALL_TURNED), 1.0, _some(by_size, SMALL_EXCHANGED))


def propose(
    arrangement: Arrangement,
    pools: Pools,
    can_turn: bool,
    rng: np.random.Generator,
    force_term: ForceTerm | None,
    exchanges: float = EXCHANGES,
) -> Proposal:
    """An exchange or a turn; ``can_turn``: whether any item may; ``exchanges``: their share."""
    if arrangement.count > 1 and (not can_turn or rng.random() < exchanges):
        moved = _pick_exchange(arrangement, pools, rng, force_term)
    elif rng.random() < pools.share:
        moved = rng.choice(pools.first, size=1)
    else:
        moved = rng.integers(arrangement.count, size=1)
    return Proposal(moved, rng.random((ANGLES, len(moved))), rng.exponential())


def _some(items: IntArray, share: float) -> IntArray:
    return items[: max(round(share * len(items)), 1)]


def _pick_exchange(
    arrangement: Arrangement, pools: Pools, rng: np.random.Generator, force_term: ForceTerm | None
) -> IntArray:
    """Two items of like size that change places."""
    radii = pools.radii
    i = int(rng.choice(pools.exchanged))
    alike = smallest(np.abs(np.log(radii / radii[i])), ALIKE + 1)
    alike = alike[alike != i]
    j = int(rng.choice(alike))
    if force_term is not None and rng.random() < WITH_FORCES:
        j = int(alike[np.argmax(force_term.gains(arrangement.places, i, alike))])
    return np.array([i, j])


def destination(arrangement: Arrangement, moved: IntArray) -> FloatArray:
    """``(m, 4)``: each of one or two items at the place of the last, a little smaller than that."""
    places = arrangement.places[moved[::-1]]
    places[:, 2] = arrangement.places[moved, 2]
    sizes = arrangement.radii[moved[::-1]] / arrangement.board.arms[moved]
    places[:, 3] = np.log(sizes) - LOSS
    return places


def destinations(arrangement: Arrangement, moved: IntArray) -> FloatArray:
    """``(p, 2, 4)``: :func:`destination` of ``(p, 2)`` items, the second -1 for one alone."""
    there = np.where(moved[:, 1:] < 0, moved, moved[:, ::-1])
    places = arrangement.places[there]
    places[..., 2] = arrangement.places[moved, 2]
    places[..., 3] = np.log(arrangement.radii[there] / arrangement.board.arms[moved]) - LOSS
    return places


def smallest(values: FloatArray, count: int) -> IntArray:
    """Indices of the smallest of values ``(n,)``, in order; of equal ones the first.

    >>> smallest(np.array([3.0, 1.0, 2.0, 1.0]), 3).tolist()
    [1, 3, 2]
    """
    if count < len(values):
        among = np.flatnonzero(values <= np.partition(values, count - 1)[count - 1])
    else:
        among = np.arange(len(values))
    return among[np.argsort(values[among], kind="stable")][:count]


def at_angles(
    places: FloatArray, moved: IntArray, objective: Objective, draws: FloatArray
) -> FloatArray:
    """``(angles, items, 4)``: the places, turned evenly apart with random beginnings.

    ``draws``: of those, ``(angles, items)`` from 0 to 1. Items with a turn limit take angles
    within it; if none may turn, there is one place.
    """
    back, on = objective.backmost[moved], objective.foremost[moved]
    if (back >= on).all():
        return places[None]
    shares = (np.arange(ANGLES)[:, None] + draws) / ANGLES
    candidates = np.repeat(places[None], ANGLES, axis=0)
    is_free = np.isinf(back)
    candidates[:, is_free, 2] += 2 * np.pi * shares[:, is_free]
    bound = ~is_free
    candidates[:, bound, 2] = back[bound] + (on - back)[bound] * shares[:, bound]
    return candidates
