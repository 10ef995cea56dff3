"""Balance of items among the parts of a container, by exchanges, until all parts fill alike."""

from __future__ import annotations

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.outline import Outline

ENOUGH = 1e-3
"""Standard deviation of the parts' means at which exchanging stops. Smaller costs more
exchanges, none of which shows. Chosen."""

OFFERED = 48
"""Items of a part that are offered to the others, those that would change most first.
Fewer find poorer exchanges among many items. Chosen."""


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


def balanced(values: FloatArray, parts: IntArray, groups: IntArray, sizes: FloatArray) -> IntArray:
    """Order in which items stand so that the parts' means of a value are about equal.

    The one exchange that brings the means closest is made again and again: where the
    value is the share of an item's hull that it fills, parts crowded with sketchy items
    would end emptier than the others.

    Parameters
    ----------
    values
        ``(n,)`` of items.
    parts
        ``(n,)`` number of the part in which each item stands first.
    groups
        ``(n,)`` items change places only with others of one number, and never if it is
        negative.
    sizes
        ``(n,)`` items change places only if theirs differ by 1 at most.

    Returns
    -------
    IntArray
        ``(n,)``: place p gets item ``order[p]``.

    Examples
    --------
    >>> full_or_sketchy, parts = np.array([1.0, 1, 0, 0]), np.array([0, 0, 1, 1])
    >>> order = balanced(full_or_sketchy, parts, np.zeros(4, dtype=int), np.zeros(4))
    >>> full_or_sketchy[order].tolist()
    [0.0, 1.0, 1.0, 0.0]
    """
    order = np.arange(len(values))
    counts = np.maximum(np.bincount(parts), 1)
    for _ in range(len(values)):
        off = values[order] - values.mean()
        excess = np.bincount(parts, weights=off)
        if np.sqrt(np.mean((excess / counts) ** 2)) <= ENOUGH:
            break
        worst = int(np.argmax(excess**2 / counts))
        here = np.flatnonzero((parts == worst) & (groups >= 0))
        here = here[np.argsort(-off[here] * np.sign(excess[worst]), kind="stable")][:OFFERED]
        gain = off[None, :] - off[here, None]
        change = (2 * gain * excess[worst] + gain**2) / counts[worst]
        change += (-2 * gain * excess[parts] + gain**2) / counts[parts]
        allowed = (parts != worst) & (groups[here, None] == groups)
        allowed &= np.abs(sizes[order[here], None] - sizes[order]) <= 1
        change[~allowed] = 0.0
        place, other = np.unravel_index(int(np.argmin(change)), change.shape)
        if change[place, other] >= 0 or not len(here):
            break
        a = here[place]
        order[[a, other]] = order[[other, a]]
    return order
