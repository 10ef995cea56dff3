"""Dashes along a polyline."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.budget.expansion import MAX_DASHES

_DOT = 1e-9
"""Length of a dash without any, as a share of the line's: it has a direction then, which
square caps need."""


def dashed(
    line: FloatArray, is_closed: bool, dashes: Sequence[float], offset: float
) -> list[FloatArray]:
    """Open polylines ``(k, 2)`` of the dashes along a polyline.

    On a closed one a dash that ends where another begins goes on in it.

    Parameters
    ----------
    line
        ``(n, 2)``, not closed by repetition.
    dashes
        Lengths of dashes and gaps in turn, an even number of them, not all zero.
    offset
        Where in the pattern the line begins.

    Examples
    --------
    >>> line = np.array([[0.0, 0.0], [10.0, 0.0]])
    >>> [part[:, 0].tolist() for part in dashed(line, False, (3.0, 2.0), 1.0)]
    [[0.0, 2.0], [4.0, 7.0], [9.0, 10.0]]
    """
    path = np.concatenate([line, line[:1]]) if is_closed else line
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    length = float(along[-1])
    period = sum(dashes)
    if length == 0 or length / period * len(dashes) > MAX_DASHES:
        return [path]
    spans = _spans(length, dashes, offset % period)
    parts = [_between(path, along, begin, end) for begin, end in spans]
    if is_closed and len(parts) > 1 and spans[0][0] == 0 and spans[-1][1] == length:
        parts[0] = np.concatenate([parts.pop(), parts[0][1:]])
    return parts


def _spans(length: float, dashes: Sequence[float], offset: float) -> list[tuple[float, float]]:
    """Where along the line each dash begins and ends."""
    period = sum(dashes)
    turns = int(np.ceil((length + offset) / period))
    ends = np.cumsum(np.tile(np.asarray(dashes, dtype=np.float64), turns)) - offset
    begins = np.concatenate([[-offset], ends[:-1]])[::2]
    ends = ends[::2]
    shows = (ends >= 0) & (begins < length) & ((ends > 0) | (begins == ends))
    begins, ends = np.maximum(begins[shows], 0.0), np.minimum(ends[shows], length)
    return list(zip(begins.tolist(), ends.tolist(), strict=True))


def _between(path: FloatArray, along: FloatArray, begin: float, end: float) -> FloatArray:
    if begin == end:
        dot = _DOT * float(along[-1])
        begin, end = max(0.0, begin - dot), min(float(along[-1]), end + dot)
    first, last = np.searchsorted(along, begin, "right"), np.searchsorted(along, end, "left")
    near = slice(max(0, int(first) - 1), int(last) + 1)
    ends = np.column_stack(
        [np.interp([begin, end], along[near], path[near, axis]) for axis in (0, 1)]
    )
    return np.concatenate([ends[:1], path[first:last], ends[1:]])
