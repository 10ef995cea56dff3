"""Allowance of an edit: sizes that items may take which it does not touch, less with each ring.

An edit takes room or leaves some. What lies beside it gives or takes most of that; with each ring
of neighbours between them items change less, and those beyond keep the sizes that they have.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.live.document import Document

BESIDE = math.log(1.5) / 2
"""Logarithm of size by which what lies beside an edit may become smaller or larger: by half of its
area. Larger covers more and leaves less as it was. Tried, decision 0055."""

FALL = 0.6
"""Factor on that with each ring farther away. Larger changes more items, smaller covers less.
Tried."""

LAST = 3
"""Stage in which items may become smaller beyond their ranges too, by half of these, and from which
sizes vary no farther: without that each edit of many covers less. Larger changes sizes that are to
stay. Tried."""

Ranges: TypeAlias = dict[int, tuple[float, float]]
"""Smallest and largest scales of items, by their numbers."""


def ranges(scale: FloatArray, rings: IntArray) -> tuple[FloatArray, FloatArray]:
    """Scales, ``(n,)`` each, between which items so many rings away may vary; -1: beyond all.

    Examples
    --------
    >>> least, most = ranges(np.ones(4), np.array([1, 2, 3, -1]))
    >>> np.square(least).round(2).tolist(), np.square(most).round(2).tolist()
    ([0.67, 0.78, 0.86, 1.0], [1.5, 1.28, 1.16, 1.0])
    """
    allowed = np.exp(np.where(rings < 0, 0.0, BESIDE * FALL ** np.maximum(rings - 1.0, 0.0)))
    return scale / allowed, scale * allowed


def widened(known: Ranges, document: Document, base: Document, rings: IntArray) -> Ranges:
    """Ranges that hold also what an edit allows about the sizes that items had before it.

    ``base``: the document before it; ``rings``: ``(n,)`` from the edit to the items as they are.
    """
    scale = document.poses.scale.copy()
    _, rows, theirs = np.intersect1d(document.ids, base.ids, return_indices=True)
    scale[rows] = base.poses.scale[theirs]
    reached = np.flatnonzero(rings >= 0)
    least, most = ranges(scale[reached], rings[reached])
    found, numbers = dict(known), document.ids[reached].tolist()
    for number, low, high in zip(numbers, least.tolist(), most.tolist(), strict=True):
        before = found.get(number, (low, high))
        found[number] = min(low, before[0]), max(high, before[1])
    return found


def within(
    document: Document,
    known: Mapping[int, tuple[float, float]],
    free: Collection[int] = (),
    stage: int = 0,
) -> Document:
    """A document whose sizes vary within ranges only, and not at all where there is none.

    ``free``: numbers of items whose sizes vary as they did; with each ``stage`` an item may grow
    beyond its range, by half of it at first, then twice as much as before, and shrink
    by half of it in the last; later ones are as that.
    """
    scales = zip(document.ids.tolist(), document.poses.scale.tolist(), strict=True)
    low, high = np.array([known.get(n, (s, s)) for n, s in scales]).reshape(-1, 2).T
    wide = high / low
    low = low / np.sqrt(wide) if stage >= LAST else low
    high = high * wide ** ((2 ** min(stage, LAST) - 1) / 2)
    is_free = np.isin(document.ids, list(free))
    smallest, largest = document.smallest, document.largest
    return replace(
        document,
        smallest=np.where(is_free, smallest, np.clip(low, smallest, largest)),
        largest=np.where(is_free, largest, np.clip(high, smallest, largest)),
    )
