"""Programmes over items that move and turn, or only move: half as many unknowns."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.compaction.kernels import interior_point


def maximised(
    rows: interior_point.Rows, gain: FloatArray, low: FloatArray, high: FloatArray, accuracy: float
) -> FloatArray:
    """Nearly the best unknowns, four an item; of items that only move, two are solved for."""
    if (high - low).reshape(-1, 4)[:, 2:].any():
        return np.asarray(interior_point.maximise(rows, gain, low, high, accuracy))
    n = len(gain) // 4
    moves = [np.zeros(4 * (-(-n // 2))) for _ in range(3)]
    for some, four in zip(moves, (gain, low, high), strict=True):
        some[: 2 * n] = four.reshape(-1, 4)[:, :2].ravel()
    z = np.zeros((n, 4))
    found = interior_point.maximise(in_twos(rows), *moves, accuracy)
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
