"""Assignment solved: at best where prices are of single items, by 2-exchange where of pairs too.

The linear one by D. F. Crouse, "On implementing 2D rectangular assignment algorithms", IEEE
Transactions on Aerospace and Electronic Systems 52 (2016), 1679-1696,
doi:10.1109/TAES.2016.140952; exchanges of pairs at falling temperatures by R. E. Burkard and F.
Rendl, "A thermodynamically motivated simulation procedure for combinatorial optimization problems",
European Journal of Operational Research 17 (1984), 169-174. At temperature 0 it is descent.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.assignment import _kernels
from packwork.assignment.problem import Assignment


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

    Parameters
    ----------
    heats
        Temperatures, one after another, in the unit of the prices: 0 makes no exchange for the
        worse, and is the last where it makes none at all.
    tries
        Exchanges tried at each for every row that may leave its column.
    at
        Columns to begin with; None for those of the rows' own numbers.

    Examples
    --------
    >>> from packwork.assignment.problem import kind_distance, neighbour_flow
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
