"""Closed chains of cubic Beziers as one array of control points, and back.

A chain of k curves is an array ``(k, 3, 2)``: each curve's start and its two handles;
its end is the next curve's start, so a chain can neither break nor stay open.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.bezier import flatten_cubic


def bernstein(steps: int) -> FloatArray:
    """Matrix ``(steps, 4)`` from a cubic's control points to points on it, end left out.

    Wang and Lu 2025, section 3.1: points = B @ control points.

    Examples
    --------
    >>> bernstein(2).tolist()
    [[1.0, 0.0, 0.0, 0.0], [0.125, 0.375, 0.375, 0.125]]
    """
    t = np.arange(steps)[:, None] / steps
    s = 1 - t
    return np.hstack([s**3, 3 * s * s * t, 3 * s * t * t, t**3])


class Chains:
    """Polygons of several chains, and the way of their gradients back to the controls.

    Examples
    --------
    >>> thirds = np.array([[[0, 0], [1, 0], [2, 0]], [[3, 0], [2, 1], [1, 1.0]]])
    >>> Chains([2], 1).points(thirds).tolist()
    [[0.0, 0.0], [3.0, 0.0]]
    """

    def __init__(self, counts: Sequence[int], steps: int) -> None:
        ends = np.cumsum(counts)
        self.starts = np.concatenate([[0], ends]).astype(np.int64) * steps
        """Index of each ring's first polygon vertex, and their number at the end."""
        self._next = np.arange(1, ends[-1] + 1)
        self._next[ends - 1] = ends - counts
        self._basis = bernstein(steps)

    def points(self, controls: FloatArray) -> FloatArray:
        """Vertices ``(n, 2)`` of the polygons of controls ``(k, 3, 2)``, all chains'."""
        ends = controls[self._next, :1]
        curves = np.concatenate([controls, ends], axis=1)
        return np.asarray(np.matmul(self._basis, curves).reshape(-1, 2))

    def gather(self, by_points: FloatArray) -> FloatArray:
        """Transpose of :meth:`points`: derivatives ``(n, 2)`` by vertices to those by controls."""
        by_vertex = by_points.reshape(len(self._next), -1, 2)
        by_curve = np.matmul(self._basis.T, by_vertex)
        by_controls: FloatArray = by_curve[:, :3].copy()
        by_controls[self._next, 0] += by_curve[:, 3]
        return by_controls


def flattened(chain: FloatArray, tolerance: float) -> list[FloatArray]:
    """Points of each curve of a chain, the first left out, within ``tolerance`` of it.

    All of them one after another are the chain's ring.

    Examples
    --------
    >>> edges = straight_chain(np.array([[0, 0], [2, 0], [0, 2.0]]))
    >>> np.concatenate(flattened(edges, 0.1)).tolist()
    [[2.0, 0.0], [0.0, 2.0], [0.0, 0.0]]
    """
    ends = np.roll(chain[:, 0], -1, axis=0)
    return [
        flatten_cubic(start, one, two, end, tolerance)
        for (start, one, two), end in zip(chain, ends, strict=True)
    ]


def straight_chain(ring: FloatArray) -> FloatArray:
    """Chain whose curves are the edges of a polygon ``(n, 2)``.

    Examples
    --------
    >>> straight_chain(np.array([[0, 0], [3, 0], [0, 3.0]]))[0].tolist()
    [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]
    """
    step = (np.roll(ring, -1, axis=0) - ring) / 3
    return np.stack([ring, ring + step, ring + 2 * step], axis=1)
