"""Exchanges of items that lower the cost of forces: 2-opt, on places.

G. Croes, "A method for solving traveling-salesman problems", Operations Research 6 (1958),
791-812, exchanges edges of a tour; ours exchanges the places of two items.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.forces.forces import Forces

PRICE = 0.1
"""What an exchange has to gain, shares of the area of the two: less does not pay for the way
that outlines then have to find together anew. Larger leaves weak forces unheard, smaller upsets
the layout for little. Tried."""

SWEEPS = 24
"""Times that all are looked at. More finds little more. Chosen."""

OFFERS = 4
"""Partners of each item that a sweep looks at, the best first. More finds a few more exchanges
in a sweep. Chosen."""

AT_ONCE = 1_000
"""Items among which partners are looked for; of more, every second or third in turn. Larger takes
more memory, by the square. Chosen."""


def exchanged(
    forces: Forces,
    places: FloatArray,
    areas: FloatArray,
    sizes: FloatArray,
    groups: IntArray,
    kinds: IntArray | None = None,
) -> IntArray:
    """Order in which items stand so that no exchange of two lowers the forces' cost by much.

    In a crowd no item comes past the others, but two may change places.

    ``places``: ``(n, 2)``; item k stands at place k first.
    ``areas``: ``(n,)`` how much each item counts, wherever it stands.
    ``sizes``: ``(n,)`` of items and of the places that they have: no item goes to a place whose
    size differs from its own by more than 1.
    ``groups``: ``(n,)`` items change places with those of one number, and never if it is negative.
    ``kinds``: ``(n,)`` items of one number are alike in all but their size, which is the place's:
    they have nothing to exchange. None if all differ.

    Returns ``(n,)``: place p gets item ``order[p]``.

    Examples
    --------
    >>> from packwork.forces.bonds import Alignment
    >>> from packwork.forces.forces import BondForce
    >>> row = BondForce(Alignment(1), np.array([1.0, 1, 0, 0]))
    >>> forces = Forces([], [row], np.zeros(4, int), 10.0)
    >>> places, same = np.array([[2.0, 1], [8, 9], [2, 9], [8, 1]]), np.zeros(4, dtype=int)
    >>> exchanged(forces, places, np.ones(4), np.zeros(4), same).tolist()
    [2, 1, 0, 3]
    """
    at = np.arange(len(places))
    parts = max(-(-len(at) // AT_ONCE), 1)
    idle = 0
    for sweep in range(SWEEPS * parts):
        some = np.arange(sweep % parts, len(at), parts)
        may = _may_exchange(sizes, groups, kinds, at, some)
        pairs = _offers(forces, places, areas, may, at, some)
        idle = 0 if _exchange(forces, places, areas, pairs, at) else idle + 1
        if idle == parts:
            break
    order = np.empty_like(at)
    order[at] = np.arange(len(at))
    return order


def _exchange(
    forces: Forces, places: FloatArray, areas: FloatArray, pairs: IntArray, at: IntArray
) -> int:
    """Exchange pairs that pay, the first first and no item twice; how many. Changes ``at``."""
    cost = forces.cost(places[at], areas).value
    busy, count = np.zeros(len(at), dtype=bool), 0
    for i, j in pairs:
        if busy[i] or busy[j]:
            continue
        at[[i, j]] = at[[j, i]]
        now = forces.cost(places[at], areas).value
        if cost - now > PRICE * (areas[i] + areas[j]):
            busy[[i, j]] = True
            cost, count = now, count + 1
        else:
            at[[i, j]] = at[[j, i]]
    return count


def _offers(
    forces: Forces,
    places: FloatArray,
    areas: FloatArray,
    may: BoolArray,
    at: IntArray,
    some: IntArray,
) -> IntArray:
    """``(m, 2)`` pairs of some items that may gain by an exchange, the most promising first."""
    changes = forces.cost_changes(places[at], areas, places[at[some]])[some]
    # Of each as if the other stood still: nearly the whole.
    change = changes + changes.T
    promised = -PRICE * (areas[some, None] + areas[some])
    change = np.where(may & (change < promised), change, np.inf)
    best = np.argsort(change, axis=1, kind="stable")[:, :OFFERS]
    gain = np.take_along_axis(change, best, axis=1)
    rows, ranks = np.nonzero(np.isfinite(gain))
    columns = best[rows, ranks]
    order = np.argsort(gain[rows, ranks], kind="stable")
    return np.asarray(np.column_stack([some[rows], some[columns]])[order])


def _may_exchange(
    sizes: FloatArray, groups: IntArray, kinds: IntArray | None, at: IntArray, some: IntArray
) -> BoolArray:
    """``(k, k)`` whether some items may go to each other's places."""
    own, group = sizes[some], groups[some]
    fits = np.abs(own[:, None] - sizes[at[some]]) <= 1
    may = fits & fits.T & (group[:, None] == group) & (group[:, None] >= 0)
    if kinds is not None:
        may &= kinds[some, None] != kinds[some]
    return np.asarray(may)
