"""Labels given out so that few neighbours have the same: a colouring of fixed counts."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.local_search import improved
from packwork.assignment.problem import Assignment, kind_distance, neighbour_flow

HEATS = (*np.geomspace(0.1, 0.04, 10).tolist(), 0.0)
"""Temperatures, in conflicts. Hotter moves labels for nothing, colder leaves conflicts. Tried."""

TRIES = 100
"""Exchanges tried at each for every place. More find little more. Tried."""

STAYING = 0.45
"""Price of a label that leaves its place, in conflicts. From a half on an exchange that takes away
one conflict is not made; smaller moves labels for nothing. Derived and tried."""


def min_conflicts_order(
    labels: IntArray,
    pairs: IntArray,
    groups: IntArray,
    rng: np.random.Generator,
    sizes: FloatArray | None = None,
) -> IntArray:
    """Order in which the labels stand so that few neighbours have the same.

    How many of each there are stays. Not the fewest conflicts that there could be: that is a hard
    problem, and with four labels or more next to none are left.

    Parameters
    ----------
    labels
        ``(n,)`` one per place, at least 0.
    pairs
        ``(m, 2)`` places that are neighbours, each pair once.
    groups, sizes
        Of places and of the labels that stand there first, as those of an ``Assignment``.

    Returns
    -------
    IntArray
        ``(n,)``: place p gets ``labels[order[p]]``.

    Examples
    --------
    >>> labels, in_a_row = np.array([0, 0, 1, 1]), np.array([[0, 1], [1, 2], [2, 3]])
    >>> order = min_conflicts_order(labels, in_a_row, np.zeros(4, int), np.random.default_rng(0))
    >>> int(abs(np.diff(labels[order])).min())
    1
    """
    count = len(labels)
    if not (labels[pairs[:, 0]] == labels[pairs[:, 1]]).any():
        return np.arange(count)
    known, kinds, counts = np.unique(labels, return_inverse=True, return_counts=True)
    several = np.flatnonzero(counts > 1)
    # Those of which there is one alone are one kind, which is in conflict with none.
    numbers = np.full(len(known), len(several))
    numbers[several] = np.arange(len(several))
    same = np.eye(len(several) + 1)
    same[-1, -1] = 0.0
    problem = Assignment(
        groups,
        np.zeros(0) if sizes is None else sizes,
        STAYING,
        flow=neighbour_flow(count, pairs),
        distance=kind_distance(numbers[kinds.ravel()], same),
    )
    return improved(problem, rng, HEATS, TRIES)
