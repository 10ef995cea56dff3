"""Changes that a command makes, and how much of a session is stale by them."""

from __future__ import annotations

from dataclasses import dataclass, fields
from enum import IntEnum

import numpy as np

from packwork.arrays import BoolArray, IntArray
from packwork.live.document import Document
from packwork.scene.pose import Poses


class Stale(IntEnum):
    """Degree of staleness: the part to be made anew, from nothing to everything."""

    NOTHING = 0
    DRAWING = 1
    """Names, colours, art: what is looked at, not what is in the way."""
    RULES = 2
    """What is held, ranges of sizes, options that all keep already."""
    POSES = 3
    """Where some items are."""
    ITEMS = 4
    """Which items there are, or their outlines."""
    EVERYTHING = 5
    """The container, a wider gap between all, what pulls at all."""


@dataclass(frozen=True, eq=False)
class Change:
    """Difference of two documents.

    Parameters
    ----------
    items
        Numbers of the items that changed, came or went.
    """

    stale: Stale
    items: IntArray

    @classmethod
    def between(cls, before: Document, after: Document) -> Change:
        """Difference of two documents."""
        is_pulled = any(
            getattr(after.options, name) != getattr(before.options, name)
            for name in ("force", "evenness")
        )
        is_tighter = is_pulled or after.options.padding > before.options.padding
        if before.container is not after.container or is_tighter:
            return cls(Stale.EVERYTHING, np.union1d(before.ids, after.ids))
        if not np.array_equal(before.ids, after.ids):
            return cls(Stale.ITEMS, np.setxor1d(before.ids, after.ids))
        outlines = [
            a.outline is not b.outline for a, b in zip(before.items, after.items, strict=True)
        ]
        if any(outlines):
            return cls(Stale.ITEMS, after.ids[np.array(outlines)])
        if (moved := differing(before.poses, after.poses)).any():
            return cls(Stale.POSES, after.ids[moved])
        ruled = (before.held != after.held).any(axis=1) | (before.options != after.options)
        ruled |= (before.smallest != after.smallest) | (before.largest != after.largest)
        if ruled.any():
            return cls(Stale.RULES, after.ids[ruled])
        drawn = [a is not b for a, b in zip(before.items, after.items, strict=True)]
        drawn_or_weighed = np.array(drawn, dtype=bool) | (before.weights != after.weights)
        stale = Stale.DRAWING if drawn_or_weighed.any() else Stale.NOTHING
        return cls(stale, after.ids[drawn_or_weighed])


def differing(before: Poses, after: Poses) -> BoolArray:
    """``(n,)`` which poses are not the same, bit for bit; both of as many items.

    Examples
    --------
    >>> differing(Poses([1, 2], [5, 5]), Poses([1, 3], [5, 5])).tolist()
    [False, True]
    """
    columns = [getattr(before, c.name) != getattr(after, c.name) for c in fields(Poses)]
    return np.asarray(np.logical_or.reduce(columns))
