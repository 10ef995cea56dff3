"""Clusters of vectors by their directions: spherical k-means.

I. S. Dhillon and D. S. Modha, "Concept decompositions for large sparse text data using clustering",
Machine Learning 42 (2001), 143-175; begun as D. Arthur and S. Vassilvitskii, "k-means++" (SODA
2007, 1027-1035).
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.graph import unit_rows

STARTS = 8
"""First centres that are tried. More find a little more. Chosen."""


def clusters(vectors: FloatArray, count: int, rng: np.random.Generator) -> IntArray:
    """``(n,)`` number of each vector's cluster, the largest one 0.

    Examples
    --------
    >>> vectors = np.array([[1.0, 0], [0, 1], [1, 0.1], [0.1, 1], [1, 0.2]])
    >>> clusters(vectors, 2, np.random.default_rng(0)).tolist()
    [0, 1, 0, 1, 0]
    """
    # Needed where items are to be told apart by colour alone.
    from scipy.cluster.vq import ClusterError, kmeans2

    units = unit_rows(vectors)
    count = min(count, len(np.unique(units, axis=0)))
    best, least = np.zeros(len(units), dtype=np.int64), np.inf
    for _ in range(STARTS):
        try:
            first = _apart(units, count, rng)
            centres, numbers = kmeans2(units, first, minit="matrix", missing="raise")
        except ClusterError:
            continue
        away = float(((units - centres[numbers]) ** 2).sum())
        if away < least:
            best, least = numbers, away
    order = np.argsort(-np.bincount(best, minlength=count), kind="stable")
    return np.asarray(np.argsort(order)[best])


def _apart(units: FloatArray, count: int, rng: np.random.Generator) -> FloatArray:
    """First centres: each by chance, likelier the farther it is from those before."""
    chosen = [int(rng.integers(len(units)))]
    away = ((units - units[chosen[0]]) ** 2).sum(axis=1)
    while len(chosen) < count:
        chosen.append(int(rng.choice(len(units), p=away / away.sum())))
        away = np.minimum(away, ((units - units[chosen[-1]]) ** 2).sum(axis=1))
    return units[chosen]
