"""Steps down a potential: a linear programme over the contacts of some items.

Kernels one after another, not in one: what several steps share is compiled once.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.kernels import interior_point, steps
from packwork.compaction.kernels.distances import Board
from packwork.settle.kernels import descent

ACCURACY = 0.05
"""Share of the way down that a programme may miss. Smaller costs time; larger leaves items
hanging in the middle of their room. Tried."""

Turns = tuple[FloatArray, FloatArray]
"""Bounds of the turn of every solid: backmost, foremost."""


def downward(
    board: Board, slope: FloatArray, turns: Turns, items: IntArray, pairs: IntArray,
    trust: float, gap: float, hair: float,
) -> FloatArray:  # fmt: skip
    """Change of place of ``items`` that goes down most and keeps the contacts apart, nearly.

    Parameters
    ----------
    slope
        ``(m, 2)`` what a move by one canvas unit costs, by x and y, a row for each item.
    """
    rows = steps.rows_of(board, items, pairs, trust, gap, hair)
    gain, low, high = descent.gains_and_bounds(board, slope, *turns, items, trust)
    z = _maximised(rows, gain, low, high)
    return _step(board, items, z, low, high, trust)


def inward(
    board: Board, slope: FloatArray, turns: Turns, items: IntArray, pairs: IntArray,
    trust: float, gap: float, hair: float, centre: FloatArray, weight: float,
) -> FloatArray:  # fmt: skip
    """The same where a smaller circle about ``centre`` ``(2,)`` is worth ``weight`` a unit."""
    n = len(items)
    rows = steps.rows_of(board, items, pairs, trust, gap, hair)
    circle = descent.circle_about(board, items, centre)
    rows = descent.with_circle(board, items, rows, centre, circle, trust)
    gain, low, high = np.zeros((3, 4 * n + 4))
    own = descent.gains_and_bounds(board, slope, *turns, items, trust)
    gain[: 4 * n], low[: 4 * n], high[: 4 * n] = own
    # What makes room for others may go anywhere.
    for c in range(2):
        low[c : 4 * n : 4], high[c : 4 * n : 4] = -1.0, 1.0
    gain[4 * n], low[4 * n] = -weight, -1.0
    z = _maximised(rows, gain, low, high)
    return _step(board, items, z, low, high, trust)


def _maximised(
    rows: interior_point.Rows, gain: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Nearly the best unknowns, four an item; of items that only move, two are solved for."""
    if (high - low).reshape(-1, 4)[:, 2:].any():
        return np.asarray(interior_point.maximise(rows, gain, low, high, ACCURACY))
    n = len(gain) // 4
    moves = [np.zeros(4 * (-(-n // 2))) for _ in range(3)]
    for some, four in zip(moves, (gain, low, high), strict=True):
        some[: 2 * n] = four.reshape(-1, 4)[:, :2].ravel()
    z = np.zeros((n, 4))
    found = interior_point.maximise(in_twos(rows), *moves, ACCURACY)
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


def _step(
    board: Board, items: IntArray, z: FloatArray, low: FloatArray, high: FloatArray, trust: float
) -> FloatArray:
    # An interior point is a little off its bounds: what may not turn would.
    within = np.minimum(np.maximum(z, low), high)
    return np.asarray(steps.step_of(board, items, within, trust))
