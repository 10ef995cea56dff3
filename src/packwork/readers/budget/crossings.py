"""Numbers of edges that cross and of rings in each other, from samples, to refuse scribbles."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from shapely import LinearRing

from packwork.arrays import BoolArray, FloatArray
from packwork.readers.reading import SHAPES_NS, TooRichError, spend

_PAIR_NS, _RING_NS = 1e4, 150.0
"""For a pair of rings whose boxes meet, and for any pair of rings. Measured."""

MAX_NESTED = SHAPES_NS / _PAIR_NS
"""Pairs of rings whose boxes meet, by estimate, where no budget is counted either."""

_SAMPLED_RINGS = 60
"""Rings whose neighbours are counted. Fewer blur the estimate. Chosen."""


def check_nesting(rings: Sequence[LinearRing]) -> None:
    """Refuse rings of which too many may lie in each other: more than some seconds' work.

    >>> square = LinearRing([(0, 0), (4, 0), (4, 4), (0, 4)])
    >>> check_nesting([square] * 2_000)
    Traceback (most recent call last):
    packwork.readers.reading.TooRichError: has about ... pairs of rings in each other; simplify it
    """
    if not rings:
        return
    boxes = shapely.box(*shapely.bounds(rings).T)
    sample = boxes[:: 1 + len(boxes) // _SAMPLED_RINGS]
    met = shapely.STRtree(boxes).query(sample).shape[1] - len(sample)
    pairs = met / len(sample) * len(boxes) / 2
    if pairs > MAX_NESTED:
        raise TooRichError(f"has about {pairs:,.0f} pairs of rings in each other")
    spend(_PAIR_NS * pairs + _RING_NS * len(rings) ** 2, f"has {len(rings):,} rings in one shape")


_ALL_NS = 2 * SHAPES_NS
"""For all the crossings that one allowance lets pass, where no budget is counted either."""

_CROSSING_NS, _UNION_NS = 2e5, 2e4
"""For a place where a shape crosses itself, and one where united shapes cross. Measured."""

MAX_CROSSINGS, MAX_UNION_CROSSINGS = int(_ALL_NS / _CROSSING_NS), int(_ALL_NS / _UNION_NS)
"""Places where the shapes of a drawing may cross themselves, and each other, by estimate."""

_SAMPLED, _COMPARED, _COMPARED_SHARE = 60, 5_000, 0.04
"""Edges whose crossings are counted for the estimate, and those they are met with: so many
at least, and that share of many. Fewer blur the estimate, more cost as much as reading. Chosen."""

_ON_ONE = 4
"""Edges on one line, itself counted, up to which they are borders that shapes share, or a drawing
made twice. Chosen."""

_FREE = 2_000
"""Crossings for which no estimate is worth its time. Chosen."""


class Allowance:
    """Crossings that may still be resolved, of all rings that are spent together.

    >>> Allowance(20_000).spend([np.random.default_rng(0).random((5000, 2))])
    Traceback (most recent call last):
    packwork.readers.reading.TooRichError: crosses itself about ... times; ...
    """

    def __init__(self, most: float) -> None:
        self._most = most
        self._spent = 0.0

    def spend(self, rings: Sequence[FloatArray]) -> None:
        """Take off what closed rings ``(n, 2)`` need, by estimate."""
        if sum(len(ring) for ring in rings) ** 2 / 2 <= _FREE:
            return
        met = estimated_crossings(rings)
        self._spent += met
        if self._spent > self._most:
            raise TooRichError(f"crosses itself about {self._spent:,.0f} times")
        spend(_ALL_NS / self._most * met, f"crosses itself about {self._spent:,.0f} times")


def estimated_crossings(rings: Sequence[FloatArray]) -> float:
    """Number of crossings of closed rings ``(n, 2)`` with themselves and each other.

    Edges that lie on many others count as crossing each.

    >>> bow_tie = np.array([[0, 0], [2, 2], [2, 0], [0, 2.0]])
    >>> estimated_crossings([bow_tie])
    1.0
    >>> square = np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])
    >>> [estimated_crossings([np.tile(square, (times, 1))]) for times in (3, 9)]
    [0.0, 162.0]
    """
    starts = np.concatenate(rings)
    ends = np.concatenate([part for ring in rings for part in (ring[1:], ring[:1])])
    count = len(starts)
    others = slice(None, None, 1 + int(count // max(_COMPARED, _COMPARED_SHARE * count)))
    sample = slice(None, None, 1 + count // _SAMPLED)
    met = _crossings(starts[sample], ends[sample], starts[others], ends[others])
    share = met / (len(starts[sample]) * len(starts[others]))
    return share * count**2 / 2


def _crossings(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> int:
    """Number of times that an edge ``a`` to ``b`` and an edge ``c`` to ``d`` cross inside both.

    Or are the same one, where many are.
    """
    first, second = np.nonzero(_boxes_meet(a, b, c, d))
    a, b, c, d = a[first], b[first], c[second], d[second]
    parts = (_sides(a, b, c) * _sides(a, b, d) < 0) & (_sides(c, d, a) * _sides(c, d, b) < 0)
    is_same = ((a == c) & (b == d)).all(axis=1) | ((a == d) & (b == c)).all(axis=1)
    times = np.bincount(first[is_same & (a != b).any(axis=1)])
    return int(np.count_nonzero(parts) + times[times > _ON_ONE].sum())


def _boxes_meet(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> BoolArray:
    """``[k, m]``: whether the boxes of two edges have a point in common."""
    low, high = np.minimum(a, b), np.maximum(a, b)
    other_low, other_high = np.minimum(c, d), np.maximum(c, d)
    meet = np.ones((len(a), len(c)), dtype=bool)
    for axis in (0, 1):
        meet &= low[:, None, axis] <= other_high[None, :, axis]
        meet &= high[:, None, axis] >= other_low[None, :, axis]
    return meet


def _sides(a: FloatArray, b: FloatArray, p: FloatArray) -> FloatArray:
    """Sign of the side of ``a`` to ``b`` on which ``p`` lies."""
    way, off = b - a, p - a
    return np.sign(way[:, 0] * off[:, 1] - way[:, 1] * off[:, 0])
