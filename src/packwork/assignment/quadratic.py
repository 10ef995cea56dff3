"""Quadratic assignment: which item comes to which place, and exchanges that make it cheaper.

T. C. Koopmans and M. Beckmann, "Assignment problems and the location of economic activities",
Econometrica 25 (1957), 53-76: a flow between facilities times the distance between their locations,
summed over all pairs, and a price of each facility at each location. Ours has a third kind of
price, of weighted sums over all (what is seen of neighbours from afar, means of parts). A
permutation has two sides: its *rows*, between which the flow is sparse, are the places or the
items, as suits; its *columns* are the others.

Solved at best where prices are of single items (D. F. Crouse, "On implementing 2D rectangular
assignment algorithms", IEEE Transactions on Aerospace and Electronic Systems 52 (2016), 1679-1696,
doi:10.1109/TAES.2016.140952), else by exchanges of pairs at falling temperatures (R. E. Burkard and
F. Rendl, "A thermodynamically motivated simulation procedure for combinatorial optimization
problems", European Journal of Operational Research 17 (1984), 169-174); at 0 that is descent.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment import _kernels
from packwork.assignment._kernels import Blend, DistancePrices, FlowPrices


def neighbour_flow(count: int, pairs: IntArray, weights: FloatArray | float = 1.0) -> FlowPrices:
    """Flow between each of ``(m, 2)`` pairs of rows.

    Examples
    --------
    >>> neighbour_flow(3, np.array([[0, 1], [1, 2]])).partners.tolist()
    [1, 0, 2, 1]
    """
    both = np.concatenate([pairs, pairs[:, ::-1]])
    order = np.lexsort(both.T[::-1])
    each = np.tile(np.broadcast_to(np.asarray(weights, dtype=np.float64), len(pairs)), 2)
    begins = np.searchsorted(both[order, 0], np.arange(count + 1)).astype(np.int64)
    return FlowPrices(begins, both[order, 1].astype(np.int64), each[order])


def kind_distance(kinds: IntArray, between: FloatArray) -> DistancePrices:
    """Distance ``between[kind, kind]`` of columns of ``(n,)`` kinds."""
    return DistancePrices(kinds, between, np.zeros((len(kinds), 0)))


def same_kind(kinds: IntArray) -> DistancePrices:
    """Distance 1 between columns of one of ``(n,)`` kinds, however many; of negative ones 0."""
    return kind_distance(kinds, NOTHING)


def point_distance(points: FloatArray) -> DistancePrices:
    """Euclidean distance of columns at ``(n, 2)`` points."""
    return DistancePrices(np.zeros(len(points), np.int64), np.zeros((1, 1)), points)


NOTHING, NO_ONE = np.zeros((0, 0)), np.zeros(0, np.int64)
NO_FLOW, NO_DISTANCE = (
    FlowPrices(NO_ONE, NO_ONE, np.zeros(0)),
    DistancePrices(NO_ONE, NOTHING, NOTHING),
)
NO_BLEND = Blend(
    NO_ONE, NO_ONE, NOTHING, np.zeros((0, 0, 0)), NOTHING, NOTHING, NOTHING, 1.0
)  # fmt: skip


class Assignment(NamedTuple):
    """Prices of a permutation of n rows, and which exchanges are allowed.

    What is not given costs nothing and forbids nothing.

    ``groups``: ``(n,)`` rows exchange columns with those of one number, and never if it is
    negative.
    ``sizes``: ``(n,)`` of rows, and of columns: no row comes to a column whose size differs from
    its own by more than 1.
    ``staying``: price of a row in any column but that of its own number.
    ``rows``, ``columns``: ``(n, s)`` features: the squared difference is the price of a row in a
    column. Of a product of two such nothing else depends on the permutation.
    """

    groups: IntArray
    sizes: FloatArray = np.zeros(0)
    staying: float = 0.0
    rows: FloatArray = NOTHING
    columns: FloatArray = NOTHING
    flow: FlowPrices = NO_FLOW
    distance: DistancePrices = NO_DISTANCE
    blend: Blend = NO_BLEND

    def mixtures(self, at: IntArray) -> FloatArray:
        """``(j, c)`` mixtures where row k has column ``at[k]``."""
        blend = self.blend
        mixed = np.zeros_like(blend.wanted)
        if len(mixed) == 0:
            return mixed
        rows = np.repeat(np.arange(len(at)), np.diff(blend.starts))
        parts = np.einsum("mp,mpc->mc", blend.weights, blend.features[at[rows]])
        np.add.at(mixed, blend.mixtures, parts)
        return mixed

    def random_pairs(self, count: int, rng: np.random.Generator) -> IntArray:
        """``(count, 2)`` pairs of rows of one group each; none where no row may leave."""
        members = np.argsort(self.groups, kind="stable")
        members = members[self.groups[members] >= 0]
        if len(members) == 0:
            return np.zeros((0, 2), np.int64)
        numbers = self.groups[members]
        begins, ends = (np.searchsorted(numbers, numbers, side) for side in ("left", "right"))
        first = rng.integers(0, len(members), count)
        second = rng.integers(begins[first], ends[first])
        return np.column_stack([members[first], members[second]])


def cheapest(prices: FloatArray) -> IntArray:
    """``(m,)`` column of each row, all different, such that ``(m, n)`` prices sum to the least.

    Examples
    --------
    >>> cheapest(np.array([[1.0, 2.0], [1.0, 5.0]])).tolist()
    [1, 0]
    """
    # Takes a tenth of a second to load, and most runs do without.
    from scipy.optimize import linear_sum_assignment

    return np.asarray(linear_sum_assignment(prices)[1], dtype=np.int64)


def improved(
    problem: Assignment,
    rng: np.random.Generator,
    heats: Iterable[float],
    tries: int,
    at: IntArray | None = None,
) -> IntArray:
    """``(n,)`` column of each row after exchanges of random pairs.

    ``heats``: temperatures, one after another, in the unit of the prices: 0 makes no exchange for
    the worse, and is the last where it makes none at all.
    ``tries``: exchanges tried at each for every row that may leave its column.
    ``at``: columns to begin with; None for those of the rows' own numbers.

    Examples
    --------
    >>> from packwork.assignment.quadratic import kind_distance, neighbour_flow
    >>> in_a_row, kinds = np.array([[0, 1], [1, 2], [2, 3]]), np.array([0, 0, 1, 1])
    >>> alike = Assignment(
    ...     np.zeros(4, int),
    ...     flow=neighbour_flow(4, in_a_row), distance=kind_distance(kinds, np.eye(2)))
    >>> kinds[improved(alike, np.random.default_rng(0), [0.0], 20)].tolist() in (
    ...     [0, 1, 0, 1], [1, 0, 1, 0])
    True
    """
    at = np.arange(len(problem.groups)) if at is None else at.astype(np.int64)
    mixed = problem.mixtures(at)
    many = tries * int((problem.groups >= 0).sum())
    for heat in heats:
        pairs = problem.random_pairs(many, rng)
        made, _ = _kernels.exchange(
            at, pairs, rng.random(len(pairs)), float(heat), *problem[1:], mixed
        )
        if heat == 0.0 and made == 0:
            break
    return at
