"""Likeness of items by diffusion distance: where short random walks over their graph end.

Diffusion maps without the map: R. R. Coifman and S. Lafon, "Diffusion maps", Applied and
Computational Harmonic Analysis 21 (2006), 5-30. Items of one cluster are all alike by it, as walks
forget within a cluster where they began; of a continuous row those near each other are. No number
of clusters is asked for.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.assignment.graph import NeighbourGraph

STEPS = 3
"""Steps of each walk. More make clusters of chance neighbours alike too; fewer follow chance.
Tried."""


def likeness(graph: NeighbourGraph, steps: int = STEPS) -> FloatArray:
    """``(n, n)`` from 0 for walks that meet nowhere to 1: the cosine between where they end.

    Zeros for what the graph ties to nothing.

    Examples
    --------
    >>> vectors = np.array([[1.0, 0], [1, 0.1], [1, 0.2], [0, 1], [0.1, 1], [0.2, 1]])
    >>> graph = NeighbourGraph.of(vectors, np.random.default_rng(0), 2)
    >>> found = likeness(graph)
    >>> bool(found[0, 2] > 0.9), float(found[0, 3])
    (True, 0.0)
    """
    # The library of sparse matrices is needed where items are tied alone.
    from scipy.sparse import csr_array

    count = len(graph.starts) - 1
    ties = csr_array((graph.weights, graph.partners, graph.starts), shape=(count, count))
    sums = np.asarray(ties.sum(axis=1)).ravel()
    walk = ties.multiply(1 / np.where(sums > 0, sums, 1.0)[:, None]).tocsr()
    ends = walk
    for _ in range(steps - 1):
        ends = ends @ walk
    lengths = np.sqrt(np.asarray(ends.multiply(ends).sum(axis=1)).ravel())
    ends = ends.multiply(1 / np.where(lengths > 0, lengths, 1.0)[:, None]).tocsr()
    return np.asarray((ends @ ends.T).toarray())
