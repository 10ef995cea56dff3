"""Closed chains of cubic Beziers: as one array of control points, and without small loops.

A chain of k curves is an array ``(k, 3, 2)``: each curve's start and its two handles;
its end is the next curve's start, so a chain can neither break nor stay open.

Loops are small knots that no pixel of a fit could see. A loop round a cut between two curves is
trimmed where they cross, and the crossing is their new cut; that of a single curve goes away as its
handles shorten. Both change the region by less than the loop.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.bezier import flatten_cubic


def bernstein(steps: int) -> FloatArray:
    """Matrix ``(steps, 4)`` from a cubic's control points to points on it, end left out.

    Wang and Lu 2025, section 3.1: points = B @ control points.

    >>> bernstein(2).tolist()
    [[1.0, 0.0, 0.0, 0.0], [0.125, 0.375, 0.375, 0.125]]
    """
    t = np.arange(steps)[:, None] / steps
    s = 1 - t
    return np.hstack([s**3, 3 * s * s * t, 3 * s * t * t, t**3])


class Chains:
    """Polygons of several chains, and the way of their gradients back to the controls.

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

    >>> straight_chain(np.array([[0, 0], [3, 0], [0, 3.0]]))[0].tolist()
    [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]
    """
    step = (np.roll(ring, -1, axis=0) - ring) / 3
    return np.stack([ring, ring + step, ring + 2 * step], axis=1)


MOST_ROUNDS = 12
"""Rounds after which a chain is given up; most need one. Chosen."""

SHORTER = 0.85
"""Factor on the handles of a curve that crosses itself, in each round: smaller bends the
curve more than it must, larger takes more rounds. Chosen."""


class Crossing(NamedTuple):
    """Crossing of curve ``one`` at ``t_one`` and curve ``two`` at ``t_two``, no earlier."""

    one: int
    t_one: float
    two: int
    t_two: float


def without_loops(chain: FloatArray, tolerance: float) -> FloatArray | None:
    """The chain with its small loops cut off; None if it crosses itself otherwise.

    ``tolerance``: of the flattening in which crossings are looked for.

    >>> from packwork.fit.chains import straight_chain
    >>> chain = straight_chain(np.array([[0, 0], [4, 0], [2, 4.2]]))
    >>> chain[1, 2], chain[2, 1] = [1.6, 4.2], [2.4, 4.2]
    >>> shapely.LinearRing(np.concatenate(flattened(chain, 0.01))).is_simple
    False
    >>> mended = without_loops(chain, 0.01)
    >>> shapely.LinearRing(np.concatenate(flattened(mended, 0.01))).is_simple
    True
    """
    chain = chain.copy()
    for _ in range(MOST_ROUNDS):
        curves = flattened(chain, tolerance)
        if shapely.LinearRing(np.concatenate(curves)).is_simple:
            return chain
        if not _cut_off(chain, crossings(curves)):
            return None
    return None


def crossings(curves: list[FloatArray]) -> list[Crossing]:
    """Proper crossings of a closed chain's flattened curves ``(n, 2)``, along the chain."""
    ends = np.concatenate(curves)
    begins = np.roll(ends, 1, axis=0)
    edges = shapely.linestrings(np.stack([begins, ends], axis=1))
    a, b = shapely.STRtree(edges).query(edges, predicate="intersects")
    gap = b - a
    apart = (gap > 1) & (gap < len(ends) - 1)
    a, b = a[apart], b[apart]
    order = np.lexsort((b, a))
    a, b = a[order], b[order]
    u, v = _meeting(begins[a], ends[a] - begins[a], begins[b], ends[b] - begins[b])
    of, at = _parameters([len(curve) for curve in curves])
    lengths = np.array([len(curve) for curve in curves])[of]
    return [
        Crossing(
            int(of[i]), float(at[i] + p / lengths[i]), int(of[j]), float(at[j] + q / lengths[j])
        )
        for i, j, p, q in zip(a, b, u, v, strict=True)
    ]


def _parameters(lengths: list[int]) -> tuple[IntArray, FloatArray]:
    """Curve that each edge belongs to, and its parameter at the edge's start."""
    of = np.repeat(np.arange(len(lengths)), lengths)
    t = np.concatenate([np.arange(n) / n for n in lengths])
    return of, t


def _meeting(
    p: FloatArray, r: FloatArray, q: FloatArray, s: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Shares u, v of the edges p + u r and q + v s where they meet; 1/2 if parallel."""
    turn = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    across = q - p
    parallel = turn == 0
    safe = np.where(parallel, 1.0, turn)
    u = (across[:, 0] * s[:, 1] - across[:, 1] * s[:, 0]) / safe
    v = (across[:, 0] * r[:, 1] - across[:, 1] * r[:, 0]) / safe
    return (
        np.clip(np.where(parallel, 0.5, u), 0, 1),
        np.clip(np.where(parallel, 0.5, v), 0, 1),
    )


def _cut_off(chain: FloatArray, found: list[Crossing]) -> bool:
    """Mend in place what can be; False if any crossing is not a small loop's."""
    count = len(chain)
    touched: set[int] = set()
    for one, t_one, two, t_two in found:
        if touched & {one, two}:
            continue
        touched |= {one, two}
        if one == two:
            _shorten(chain, one)
        elif two == one + 1:
            _trim(chain, one, t_one, two, t_two)
        elif (one, two) == (0, count - 1):
            _trim(chain, two, t_two, one, t_one)
        else:
            return False
    return bool(touched)


def _shorten(chain: FloatArray, k: int) -> None:
    start, end = chain[k, 0], chain[(k + 1) % len(chain), 0]
    chain[k, 1] = start + SHORTER * (chain[k, 1] - start)
    chain[k, 2] = end + SHORTER * (chain[k, 2] - end)


def _trim(chain: FloatArray, before: int, t_before: float, after: int, t_after: float) -> None:
    """Join two neighbours where they cross; what they did beyond is gone."""
    end = chain[(after + 1) % len(chain), 0]
    head = _split(np.vstack([chain[before], chain[after, :1]]), t_before)[0]
    tail = _split(np.vstack([chain[after], end[None]]), t_after)[1]
    chain[before, 1:] = head[1:3]
    chain[after] = tail[:3]
    chain[after, 0] = 0.5 * (head[3] + tail[0])


def _split(curve: FloatArray, t: float) -> tuple[FloatArray, FloatArray]:
    """A cubic's two halves at ``t`` (de Casteljau)."""
    rows = [curve]
    while len(rows[-1]) > 1:
        rows.append(rows[-1][:-1] + t * np.diff(rows[-1], axis=0))
    return np.array([row[0] for row in rows]), np.array([row[-1] for row in reversed(rows)])
