"""Mixing of labels among places until few neighbours have the same: a colouring of fixed counts.

By exchanges that take most conflicts away, the min-conflicts heuristic (S. Minton, M. Johnston,
A. Philips and P. Laird, "Minimizing conflicts: a heuristic repair method for constraint
satisfaction and scheduling problems", Artificial Intelligence 58 (1992), 161-205).
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray

SWEEPS = 12
"""Times that all places in conflict are looked at. More finds little more. Tried."""


def mixed(
    labels: IntArray, pairs: IntArray, groups: IntArray, sizes: FloatArray | None = None
) -> IntArray:
    """Order in which the labels stand so that few neighbours have the same.

    Two labels change places as long as that takes conflicts away; how many of each there
    are stays. Not the fewest conflicts that there could be: that is a hard problem, and
    with four labels or more next to none are left.

    Parameters
    ----------
    labels
        ``(n,)`` one per place, at least 0.
    pairs
        ``(m, 2)`` places that are neighbours, each pair once.
    groups
        ``(n,)`` labels move only among places of one number, and never from or to
        places of a negative one.
    sizes
        ``(n,)`` of places, and of the labels that stand there first: no label moves to a
        place whose size differs from its own by more than 1.

    Returns
    -------
    IntArray
        ``(n,)``: place p gets ``labels[order[p]]``.

    Examples
    --------
    >>> labels, in_a_row = np.array([0, 0, 1, 1]), np.array([[0, 1], [1, 2], [2, 3]])
    >>> labels[mixed(labels, in_a_row, np.zeros(4, dtype=int))].tolist()
    [1, 0, 1, 0]
    """
    order = np.arange(len(labels))
    if len(pairs) == 0:
        return order
    table = _ConflictTable(labels, pairs)
    for _ in range(SWEEPS):
        before = table.conflicts
        for place in np.flatnonzero(table.same > 0):
            if table.same[place] == 0 or groups[place] < 0:
                continue
            allowed = (groups == groups[place]) & (table.labels != table.labels[place])
            if sizes is not None:
                allowed &= np.abs(sizes[order] - sizes[place]) <= 1
                allowed &= np.abs(sizes[order[place]] - sizes) <= 1
            other = table.best_exchange(int(place), allowed)
            if other is not None:
                table.exchange(int(place), other)
                order[place], order[other] = order[other], order[place]
        if table.conflicts in (0, before):
            break
    return order


class _ConflictTable:
    """Label of each place, and how many of its neighbours have the same."""

    def __init__(self, labels: IntArray, pairs: IntArray) -> None:
        self.labels = labels.copy()
        both = np.concatenate([pairs, pairs[:, ::-1]])
        self._from, self._to = both[np.argsort(both[:, 0], kind="stable")].T
        self._begins = np.searchsorted(self._from, np.arange(len(labels) + 1))
        self.same = self._beside(self.labels[self._from])

    @property
    def conflicts(self) -> int:
        """Pairs of neighbours with the same label."""
        return int(self.same.sum()) // 2

    def best_exchange(self, place: int, allowed: BoolArray) -> int | None:
        """Place, of those allowed ``(n,)``, whose exchange removes most conflicts, if any does."""
        label = self.labels[place]
        around = self._around(place)
        here = np.bincount(self.labels[around], minlength=int(self.labels.max()) + 1)
        change = here[self.labels] + self._beside(label) - self.same[place] - self.same
        # Neighbours that change places keep each other: counted twice above.
        change[around] -= 2
        change = np.where(allowed, change, 0)
        best = int(np.argmin(change))
        return best if change[best] < 0 else None

    def exchange(self, a: int, b: int) -> None:
        """Let two places change their labels."""
        self.labels[[a, b]] = self.labels[[b, a]]
        self.same = self._beside(self.labels[self._from])

    def _around(self, place: int) -> IntArray:
        return np.asarray(self._to[self._begins[place] : self._begins[place + 1]])

    def _beside(self, label: IntArray | np.int64) -> IntArray:
        """Per place, how many of its neighbours have a label (one, or one for each edge)."""
        hits = self.labels[self._to] == label
        return np.bincount(self._from, weights=hits, minlength=len(self.labels)).astype(np.int64)
