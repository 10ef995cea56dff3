"""Items of an earlier layout matched with those of a run, by their names."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from packwork.arrays import IntArray
from packwork.pipeline.job import Job
from packwork.scene.layout import Layout


def matched(now: Sequence[str], then: Sequence[str]) -> IntArray:
    """``(n,)`` which item of then each item of now is; -1 for one that is new.

    Copies of one name are taken in turn: the first for the first.

    Examples
    --------
    >>> matched(["owl", "bear", "owl", "fox"], ["bear", "owl", "cat"]).tolist()
    [1, 0, -1, -1]
    """
    places: dict[tuple[str, int], int] = {}
    seen: Counter[str] = Counter()
    for k, name in enumerate(then):
        places[name, seen[name]] = k
        seen[name] += 1
    seen.clear()
    found = []
    for name in now:
        found.append(places.get((name, seen[name]), -1))
        seen[name] += 1
    return np.array(found, dtype=np.int64)


def match_items(job: Job, earlier: Layout) -> IntArray:
    """``(n,)`` which item of an earlier layout each is; -1 for one that is new."""
    return matched([item.name for item in job.items], [item.name for item in earlier.items])


def new_items(job: Job) -> IntArray:
    """Items that an earlier layout does not have; none if there is no such layout."""
    if job.earlier is None:
        return np.arange(0)
    return np.flatnonzero(match_items(job, job.earlier) < 0)
