"""Estimated number of rings that lie in each other, from a sample, to refuse what takes minutes."""

from __future__ import annotations

from collections.abc import Sequence

import shapely
from shapely import LinearRing

from packwork.readers.account import spend
from packwork.readers.unfit import TooRichError

MAX_NESTED = 200_000
"""Pairs of rings whose boxes meet, by estimate: two seconds' work. Chosen."""

_PAIR_NS, _RING_NS = 1e4, 150.0
"""For a pair of rings whose boxes meet, and for any pair of rings. Measured."""

_SAMPLED = 60
"""Rings whose neighbours are counted. Fewer blur the estimate. Chosen."""


def check_nesting(rings: Sequence[LinearRing]) -> None:
    """Refuse rings of which too many may lie in each other.

    Raises
    ------
    TooRichError
        If that is more than some seconds' work.

    Examples
    --------
    >>> square = LinearRing([(0, 0), (4, 0), (4, 4), (0, 4)])
    >>> check_nesting([square] * 2_000)
    Traceback (most recent call last):
    packwork.readers.unfit.TooRichError: has about ... pairs of rings in each other; simplify it
    """
    if not rings:
        return
    boxes = shapely.box(*shapely.bounds(rings).T)
    sample = boxes[:: 1 + len(boxes) // _SAMPLED]
    met = shapely.STRtree(boxes).query(sample).shape[1] - len(sample)
    pairs = met / len(sample) * len(boxes) / 2
    if pairs > MAX_NESTED:
        raise TooRichError(f"has about {pairs:,.0f} pairs of rings in each other")
    spend(_PAIR_NS * pairs + _RING_NS * len(rings) ** 2, f"has {len(rings):,} rings in one shape")
