"""Similarity of items by their vectors: neighbour graph, diffusion distance, clusters.

The fuzzy neighbour graph is that of L. McInnes, J. Healy and J. Melville, "UMAP: Uniform manifold
approximation and projection for dimension reduction" (2018), arXiv:1802.03426: weights fall from 1
at an item's nearest neighbour, so fast that they sum to the logarithm of how many there are. Ours
are multiplied by the cosine, so that what is unlike pulls nothing, and scaled to a sum of 1 for
each item, so that none pulls harder than others.

Diffusion maps without the map: R. R. Coifman and S. Lafon, "Diffusion maps", Applied and
Computational Harmonic Analysis 21 (2006), 5-30. Items of one cluster are all alike by it, as walks
forget within a cluster where they began; of a continuous row those near each other are. No number
of clusters is asked for.

Spherical k-means: I. S. Dhillon and D. S. Modha, "Concept decompositions for large sparse text data
using clustering", Machine Learning 42 (2001), 143-175; begun as D. Arthur and S. Vassilvitskii,
"k-means++" (SODA 2007, 1027-1035).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray

NEIGHBOURS = 12
"""Neighbours of each item in the graph. Fewer follow chance, more blur what is alike. Chosen."""

MOST_PARTNERS = 48
"""Partners of each item among copies. More take longer. Chosen."""

HALVINGS = 40
"""Bisections for the rate at which weights fall. Derived: they end below any difference."""

AT_ONCE = 512
"""Rows of distances held at a time. More take more memory. Chosen."""


@dataclass(frozen=True, eq=False)
class NeighbourGraph:
    """Neighbour graph with weights, as rows of a sparse symmetric matrix.

    ``starts``: ``(n + 1,)``: partners of item k lie from ``starts[k]`` to before ``starts[k + 1]``.
    ``partners``, ``weights``: ``(m,)``.
    """

    starts: IntArray
    partners: IntArray
    weights: FloatArray

    @classmethod
    def of(
        cls, vectors: FloatArray, rng: np.random.Generator, most: int = NEIGHBOURS
    ) -> NeighbourGraph:
        """Graph of ``(n, d)`` vectors by their angles: the cosine distance.

        Items of one vector, as copies of a thing, are neighbours of each other and of all copies
        of its neighbours, or of some of them by chance where there are many.

        Examples
        --------
        >>> vectors = np.array([[1.0, 0], [1, 0.1], [0, 1], [0.1, 1]])
        >>> NeighbourGraph.of(vectors, np.random.default_rng(0), 1).partners.tolist()
        [1, 0, 3, 2]
        """
        things, which = np.unique(unit_rows(vectors), axis=0, return_inverse=True)
        which = which.ravel()
        count, neighbours = len(vectors), min(most, len(things) - 1)
        nearest, weights = np.zeros((len(things), 0), np.int64), np.zeros((len(things), 0))
        if neighbours > 0:
            nearest, away = _nearest(things, neighbours)
            # What is unlike pulls nothing, be it the nearest; nor does what has no vector.
            weights = _falling(away) * np.maximum(1.0 - away, 0.0)
        copies = [np.flatnonzero(which == k) for k in range(len(things))]
        rows, columns, values = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)], [np.zeros(0)]
        for k, own in enumerate(copies):
            others = zip(weights[k], nearest[k], strict=True)
            near = [(1.0, own), *((weight, copies[other]) for weight, other in others)]
            candidates = np.concatenate([ones for _, ones in near])
            # What has many copies pulls no harder than what has one.
            pulls = np.concatenate([np.full(len(ones), w / len(ones)) for w, ones in near])
            for item in own:
                taken = np.flatnonzero((candidates != item) & (pulls > 0))
                if len(taken) > MOST_PARTNERS:
                    shares = pulls[taken] / pulls[taken].sum()
                    taken = np.sort(rng.choice(taken, MOST_PARTNERS, replace=False, p=shares))
                rows.append(np.full(len(taken), item))
                columns.append(candidates[taken])
                values.append(pulls[taken])
        joined = np.concatenate(rows), np.concatenate(columns), np.concatenate(values)
        return cls._symmetric(count, *joined)

    def means(self, values: FloatArray) -> FloatArray:
        """``(n, s)`` weighted means of ``(n, s)`` values over partners; 0 of what has none.

        Examples
        --------
        >>> pair = NeighbourGraph(np.array([0, 1, 2]), np.array([1, 0]), np.array([0.5, 0.5]))
        >>> pair.means(np.array([[3.0], [5.0]])).ravel().tolist()
        [5.0, 3.0]
        """
        rows = np.repeat(np.arange(len(values)), np.diff(self.starts))
        sums, total = np.zeros_like(values), np.zeros(len(values))
        np.add.at(sums, rows, self.weights[:, None] * values[self.partners])
        np.add.at(total, rows, self.weights)
        return np.asarray(sums / np.where(total > 0, total, 1.0)[:, None])

    @classmethod
    def _symmetric(
        cls, count: int, rows: IntArray, columns: IntArray, weights: FloatArray
    ) -> NeighbourGraph:
        """Fuzzy union of a graph and its mirror image, each row then scaled to 1 and halved."""
        # The library of sparse matrices is needed here alone.
        from scipy.sparse import coo_array

        if len(rows) == 0:
            return cls(np.zeros(count + 1, np.int64), np.zeros(0, np.int64), np.zeros(0))
        one = coo_array((weights, (rows, columns)), shape=(count, count)).tocsr()
        union = (one + one.T - one * one.T).tocsr()
        sums = np.maximum(np.asarray(union.sum(axis=1)).ravel(), 1e-12)
        scaled = union.multiply(1 / sums[:, None]).tocsr()
        both = (0.5 * (scaled + scaled.T)).tocsr()
        both.sort_indices()
        return cls(
            both.indptr.astype(np.int64), both.indices.astype(np.int64), both.data.astype(float)
        )


def unit_rows(vectors: FloatArray) -> FloatArray:
    """Vectors of length 1 each, about their common mean where that leaves none empty.

    Examples
    --------
    >>> unit_rows(np.array([[3.0, 4.0], [0.0, 0.0]])).tolist()
    [[0.6, 0.8], [0.0, 0.0]]
    """
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.where(lengths > 0, lengths, 1.0))


def _nearest(units: FloatArray, neighbours: int) -> tuple[IntArray, FloatArray]:
    """``(n, k)`` nearest others, nearest first, and their cosine distances."""
    count = len(units)
    found = np.empty((count, neighbours), dtype=np.int64)
    away = np.empty((count, neighbours))
    for begin in range(0, count, AT_ONCE):
        rows = slice(begin, min(begin + AT_ONCE, count))
        distances = np.maximum(1.0 - units[rows] @ units.T, 0.0)
        distances[np.arange(distances.shape[0]), np.arange(rows.start, rows.stop)] = np.inf
        order = np.argsort(distances, axis=1, kind="stable")[:, :neighbours]
        found[rows] = order
        away[rows] = np.take_along_axis(distances, order, axis=1)
    return found, away


def _falling(away: FloatArray) -> FloatArray:
    """Weights that fall from 1 at the nearest, each row to the sum of log2(k), or 1 if larger."""
    beyond = away - away[:, :1]
    wanted = max(np.log2(away.shape[1]), 1.0)
    low, high = np.zeros(len(away)), np.full(len(away), max(float(beyond.max()), 1e-12) * 64)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        weights = np.exp(-beyond / np.maximum(middle, 1e-300)[:, None])
        is_much = weights.sum(axis=1) > wanted
        high, low = np.where(is_much, middle, high), np.where(is_much, low, middle)
    return np.asarray(np.exp(-beyond / np.maximum(high, 1e-300)[:, None]))


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
