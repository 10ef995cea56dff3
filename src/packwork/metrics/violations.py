"""Violations: the pairs, by number, that keep a layout from its certificate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from packwork.geometry.distance import distance
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region, difference, intersection, part_about, valid


@dataclass(frozen=True)
class Violation:
    """An item that meets another or is too near to it; the container's edge if ``other`` is None.

    Parameters
    ----------
    overlap_cu2
        Area that they share, or that lies outside the container.
    gap_cu
        Their distance if they share none.
    """

    item: int
    other: int | None
    overlap_cu2: float
    gap_cu: float


def violations(
    outlines: Sequence[Outline], container: Outline, gap: float
) -> tuple[Violation, ...]:
    """Each pair nearer than ``gap``, and each item nearer than that to the edge or beyond it.

    Examples
    --------
    >>> def square(x, side):
    ...     return Outline.from_rings([x + side * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])])
    >>> found = violations([square(1, 2), square(2, 2), square(9, 2)], square(0, 10), 0.5)
    >>> [(one.item, one.other, one.overlap_cu2) for one in found]
    [(0, 1, 1.0), (2, None, 3.0)]
    """
    whole = valid(container.region)
    regions = np.empty(len(outlines), dtype=object)
    regions[:] = [valid(outline.region) for outline in outlines]
    first, second = shapely.STRtree(regions).query(regions, predicate="dwithin", distance=gap)
    pairs = [(int(i), int(j)) for i, j in zip(first, second, strict=True) if i < j]
    shapely.prepare(whole)
    edge = whole.boundary
    shapely.prepare(edge)
    near = ~shapely.covers(whole, regions) | shapely.dwithin(edge, regions, gap)
    found = [meeting(i, j, regions[i], regions[j]) for i, j in pairs]
    found += [sticking_out(int(k), regions[k], whole, gap) for k in np.flatnonzero(near)]
    return tuple(
        one for one in sorted(found, key=lambda one: one.item)
        if one.overlap_cu2 > 0 or one.gap_cu < gap
    )  # fmt: skip


def meeting(i: int, j: int, first: Region, second: Region) -> Violation:
    """Violation of the distance between two regions."""
    shared = float(intersection(first, second).area)
    return Violation(i, j, shared, 0.0 if shared > 0 else distance(first, second))


def sticking_out(k: int, one: Region, whole: Region, gap: float) -> Violation:
    """Violation of the distance of a region to the edge of another, inside it."""
    # What is nearer than asked lies within that gap.
    near = part_about(whole, one, gap)
    outside = float(difference(one, near).area)
    return Violation(k, None, outside, 0.0 if outside > 0 else distance(near.boundary, one))
