"""Number of curves for each ring of an outline."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray, IntArray

FEWEST = 4
"""Curves of one ring at least: with fewer, corners and ovals are out of reach. Chosen."""


def shared_curves(rings: Sequence[FloatArray], curves: int) -> IntArray:
    """Curves for each ring ``(n, 2)``: at least ``FEWEST``, the rest by length, zero for the tiny.

    Where the curves do not suffice for all, the shortest rings get none.

    Examples
    --------
    >>> square = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    >>> shared_curves([square, 3 * square], 20).tolist()
    [7, 13]
    >>> shared_curves([square, 3 * square], 6).tolist()
    [0, 6]
    """
    lengths = np.array([_length(ring) for ring in rings])
    served = np.argsort(-lengths, kind="stable")[: curves // FEWEST]
    counts = np.zeros(len(rings), dtype=np.int64)
    counts[served] = FEWEST
    spare = curves - int(counts.sum())
    wish = spare * lengths[served] / lengths[served].sum()
    counts[served] += np.floor(wish).astype(np.int64)
    left = curves - int(counts.sum())
    counts[served[np.argsort(np.floor(wish) - wish, kind="stable")[:left]]] += 1
    return counts


def _length(ring: FloatArray) -> float:
    return float(np.hypot(*(np.roll(ring, -1, axis=0) - ring).T).sum())
