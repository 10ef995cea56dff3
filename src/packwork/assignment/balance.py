"""Items given out among the parts of a container until all parts fill alike."""

from __future__ import annotations

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.assignment._kernels import Blend
from packwork.assignment.local_search import improved
from packwork.assignment.problem import Assignment
from packwork.geometry.outline import Outline

STAYING = (0.3, 0.1, 0.03, 0.01)
"""Price of an item that leaves its place, one after another, in squared deviations of a value: what
gains most comes first, so that few are moved. Smaller at last moves more for nothing. Tried."""

ROUNDS, TRIES = 3, 50
"""Rounds at each, and exchanges tried in a round for every item. More find little more. Tried."""


def parts_of(container: Outline, x: FloatArray, y: FloatArray) -> IntArray:
    """``(n,)`` index of the container's part that is nearest to each point.

    Examples
    --------
    >>> tiles = [np.array([[a, 0.0], [a + 2, 0], [a + 2, 2], [a, 2]]) for a in (0, 5)]
    >>> parts_of(Outline.from_rings(tiles), np.array([1.0, 9.0]), np.ones(2)).tolist()
    [0, 1]
    """
    centres = shapely.points(x, y)
    parts = shapely.get_parts(container.region)
    return np.asarray(np.argmin([shapely.distance(part, centres) for part in parts], axis=0))


def balanced_order(
    values: FloatArray,
    parts: IntArray,
    groups: IntArray,
    sizes: FloatArray,
    rng: np.random.Generator,
) -> IntArray:
    """Order in which items stand so that the parts' means of a value are about equal.

    Where the value is the share of an item's hull that it fills, parts crowded with sketchy items
    would end emptier than the others.

    Parameters
    ----------
    values
        ``(n,)`` of items.
    parts
        ``(n,)`` number of the part in which each item stands first.
    groups, sizes
        As those of an ``Assignment``.

    Returns
    -------
    IntArray
        ``(n,)``: place p gets item ``order[p]``.

    Examples
    --------
    >>> full_or_sketchy, parts = np.array([1.0, 1, 0, 0]), np.array([0, 0, 1, 1])
    >>> rng = np.random.default_rng(0)
    >>> order = balanced_order(full_or_sketchy, parts, np.zeros(4, dtype=int), np.zeros(4), rng)
    >>> float(full_or_sketchy[order][:2].sum())
    1.0
    """
    count, spread = len(values), float(values.std())
    if spread == 0.0:
        return np.arange(count)
    counts = np.maximum(np.bincount(parts), 1)
    off = (values - values.mean()) / spread
    # The price is the squared sum of each part over how many it has.
    blend = Blend(
        np.arange(count + 1), parts.astype(np.int64), 1 / np.sqrt(counts[parts])[:, None],
        off[:, None, None], np.zeros((len(counts), 1)), np.eye(1), np.eye(1), 1.0,
    )  # fmt: skip
    order = np.arange(count)
    for staying in STAYING:
        problem = Assignment(groups, sizes, staying, blend=blend)
        order = improved(problem, rng, [0.0] * ROUNDS, TRIES, order)
    return order
