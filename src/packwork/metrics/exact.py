"""Coverage, overlap, excess, smallest gap compactness: exact, with no code of the solver's."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ShapeError
from packwork.geometry.distance import distance, near_pairs
from packwork.geometry.outline import Outline
from packwork.geometry.outline import regions as regions_of
from packwork.geometry.overlay import (
    Region,
    difference,
    intersection,
    part_about,
    polygon_parts,
    prepared,
    union,
    valid,
)
from packwork.threads import at_once

_Regions: TypeAlias = npt.NDArray[Any]

_FIRST_REACH = 1e-4
"""Distance looked at first for the smallest gap, as a share of the container's extent.
Larger: more pairs to measure at once; smaller: more rounds. Tried."""

_REACH_GROWTH = 4.0
"""Growth of that distance while nothing is found; as above. Tried."""


PORTION = 256
"""Regions whose gaps are measured at a time. Larger: more memory; smaller: more rounds. Chosen."""

STRIP = 1_000
"""Items whose regions are in memory at once. Larger takes memory, smaller more often what lies at
the edge of a strip."""

_FEW_PAIRS = 8
"""Pairs that are measured rather than thinned out. Larger: more slow measuring; smaller: more
rounds of asking. Chosen."""

_MOST_HALVINGS = 24
"""Times that pairs are thinned out at most: many may have one and the same distance. Chosen."""


@dataclass(frozen=True, kw_only=True)
class ExactMetrics:
    """Shares of the container's area, areas and the smallest gap.

    ``coverage``: LC: share of the container that items cover, 0 to 1.
    ``overlap``: OO: area in two or more items, over the container's area.
    ``exceeding``: EA: area in an item and not in the container, over the container's area.
    ``overlap_area``, ``outside_area``: the same two in squared canvas units.
    ``min_gap``: smallest distance between two items, or of an item from the container's edge,
    canvas units. 0 if items touch or overlap or one is not inside; infinite without items.
    ``gap_beside``: the same without pairs of which both are straight upright rectangles, whose
    coordinates are compared exactly: they may touch. None where there are no such rectangles.
    """

    coverage: float
    overlap: float
    exceeding: float
    overlap_area: float
    outside_area: float
    min_gap: float
    gap_beside: float | None = None

    @property
    def is_clean(self) -> bool:
        """Whether nothing overlaps and nothing is outside."""
        return self.overlap_area == 0 and self.outside_area == 0


def exact_metrics(outlines: Sequence[Outline], container: Outline) -> ExactMetrics:
    """Exact measures of outlines in place, silhouettes or ink alike.

    Outlines whose rings cross are repaired first. Areas are good to rounding, about
    1e-12 of the container's area.

    Raises ``ShapeError`` if the container has no area.

    Examples
    --------
    >>> def square(x, side):
    ...     return Outline.from_rings([x + side * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])])
    >>> found = exact_metrics([square(1, 2), square(2, 2)], square(0, 10))
    >>> found.overlap_area, found.coverage, found.min_gap
    (1.0, 0.07, 0.0)
    """
    boxes = np.array([outline.bounds for outline in outlines]).reshape(-1, 4)
    return metrics_by_strips(boxes, lambda some: [outlines[int(k)] for k in some], container)


def metrics_by_strips(
    boxes: FloatArray, place: Callable[[IntArray], Sequence[Outline]], container: Outline
) -> ExactMetrics:
    """Exact measures of outlines that are in memory only while they are looked at.

    ``boxes``: ``(n, 4)`` in which they lie, left, top, right and bottom, canvas units; ``place``:
    outlines by their numbers ``(m,)``.

    Examples
    --------
    >>> tiles = [Outline.box(k, 1, k + 0.5, 2) for k in range(1, 9)]
    >>> boxes = np.array([tile.bounds for tile in tiles])
    >>> whole = Outline.box(0, 0, 10, 10)
    >>> metrics_by_strips(boxes, lambda some: [tiles[k] for k in some], whole).min_gap
    0.5
    """
    whole = _container_region(container)
    looked_at = _look(boxes, lambda some: _regions(place(some)), whole)
    if looked_at.gap > 0 and looked_at.is_inside:
        covered = float(looked_at.areas.sum())
        return ExactMetrics(
            coverage=covered / whole.area, overlap=0.0, exceeding=0.0, overlap_area=0.0,
            outside_area=0.0, min_gap=looked_at.gap,
        )  # fmt: skip
    regions = _regions(place(np.arange(len(boxes))))
    pairs = _meeting_pairs(regions)
    covered, outside = _covered_and_outside(_merged(regions, pairs), whole)
    overlap = _overlap_area(regions, pairs)
    return ExactMetrics(
        coverage=covered / whole.area,
        overlap=overlap / whole.area,
        exceeding=outside / whole.area,
        overlap_area=overlap,
        outside_area=outside,
        min_gap=0.0,
    )


def exact_coverage(outlines: Sequence[Outline], container: Outline) -> float:
    """Share of the container that outlines cover, such as the ink of all items.

    Raises ``ShapeError`` if the container has no area.

    Examples
    --------
    >>> half = Outline.from_rings([[[0, 0], [1, 0], [1, 2], [0, 2]]])
    >>> exact_coverage([half, half], Outline.from_rings([[[0, 0], [2, 0], [2, 2], [0, 2]]]))
    0.5
    """
    whole = _container_region(container)
    regions = _regions(outlines)
    covered, _ = _covered_and_outside(_merged(regions, _meeting_pairs(regions)), whole)
    return covered / float(whole.area)


def _container_region(container: Outline) -> Region:
    whole = valid(container.region)
    if whole.area <= 0:
        raise ShapeError("the container has no area; give a region that can be filled")
    return prepared(whole)


def _regions(outlines: Sequence[Outline]) -> _Regions:
    found = regions_of(outlines)
    crossing = ~shapely.is_valid(found)
    found[crossing] = [valid(one) for one in found[crossing]]
    return found


def _meeting_pairs(regions: _Regions) -> IntArray:
    """Indices ``(k, 2)``, smaller first, of regions that share a point at least."""
    found = shapely.STRtree(regions).query(regions, predicate="intersects").T
    return np.asarray(found[found[:, 0] < found[:, 1]], dtype=np.int64)


def _merged(regions: _Regions, pairs: IntArray) -> _Regions:
    """Regions with those that meet united: areas of the result add up.

    Uniting groups, not everything, spares the many that meet no other.
    """
    if pairs.size == 0:
        return regions
    # Takes a while to load, and only layouts with overlaps need it.
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    links = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(regions), len(regions)))
    count, group = connected_components(links, directed=False)
    order = np.argsort(group, kind="stable")
    members = np.split(order, np.cumsum(np.bincount(group, minlength=count))[:-1])
    merged = np.empty(count, dtype=object)
    merged[:] = [regions[m[0]] if len(m) == 1 else union(regions[m]) for m in members]
    return merged


def _covered_and_outside(merged: _Regions, whole: Region) -> tuple[float, float]:
    within = shapely.covers(whole, merged)
    crossing = merged[~within]
    # Both are computed, not one taken off the other: a sliver would drown in rounding.
    near = part_about(whole, crossing)
    covered = shapely.area(merged[within]).sum() + _total(intersection(crossing, near))
    return float(covered), _total(difference(crossing, near))


def _overlap_area(regions: _Regions, pairs: IntArray) -> float:
    """Area in two or more regions: the union of what pairs share, counted once."""
    if pairs.size == 0:
        return 0.0
    shared = intersection(regions[pairs[:, 0]], regions[pairs[:, 1]])
    # Regions that only touch share points and lines, which have no part in the union.
    solid = [part for s in shared[shapely.area(shared) > 0] for part in polygon_parts(s)]
    return float(union(solid).area)


def _total(regions: _Regions) -> float:
    return float(shapely.area(regions).sum())


def smallest_gap(regions: _Regions, whole: Region) -> float:
    """Smallest distance of regions in ``whole`` from each other and its edge; 0 if some meet."""
    return _look(shapely.bounds(regions), lambda some: regions[some], whole).gap


class _Seen(NamedTuple):
    """Smallest gap of some regions, whether all are inside, and the area of each ``(n,)``.

    Of regions that meet or stick out not all may have been looked at.
    """

    gap: float
    is_inside: bool
    areas: FloatArray


def _look(boxes: FloatArray, take: Callable[[IntArray], _Regions], whole: Region) -> _Seen:
    """Gaps and areas of regions that are taken by their numbers, and that have these boxes.

    By strips across the longer side: only their regions are in memory, of several at once.
    """
    if len(boxes) == 0:
        return _Seen(math.inf, True, np.zeros(0))
    tree, rank = shapely.STRtree(shapely.box(*boxes.T)), np.empty(len(boxes), dtype=np.int64)
    order = np.argsort(max(boxes[:, 0], boxes[:, 1], key=np.ptp), kind="stable")
    rank[order] = np.arange(len(order))

    def look(begin: int, reach: float) -> _Seen:
        own = order[begin : begin + STRIP]
        grown = shapely.box(*(boxes[own] + reach * np.array([-1.0, -1.0, 1.0, 1.0])).T)
        others = np.unique(tree.query(grown)[1])
        others = others[rank[others] >= begin + STRIP]
        return _look_at(take(np.concatenate([own, others])), len(own), whole, reach)

    left, top, right, bottom = whole.bounds
    reach = _FIRST_REACH * max(right - left, bottom - top)
    while (first := look(0, reach)).gap == math.inf and first.is_inside:
        # An item inside is nearer to the edge than the extent, so this ends.
        reach *= _REACH_GROWTH
    if first.gap == 0 or not first.is_inside:
        return first
    later = [(begin, first.gap) for begin in range(STRIP, len(order), STRIP)]
    seen = [first, *at_once(look, later)]
    areas = np.concatenate([one.areas for one in seen])[rank]
    return _Seen(min(one.gap for one in seen), all(one.is_inside for one in seen), areas)


def _look_at(regions: _Regions, count: int, whole: Region, reach: float) -> _Seen:
    """The first so many of some regions; their gap to each other, to all others and to the edge.

    That is infinite beyond ``reach``: exact distances are slow, asking whether something is near
    is fast. By portions: what is asked about many times is prepared, which takes much memory; and
    what one has found spares the next most of its pairs.
    """
    # Copies: other threads may ask those that are kept, and only one may ask what is prepared.
    edge, own = prepared(whole.boundary), regions[:count]
    is_inside, areas = bool(shapely.covers(prepared(whole), own).all()), shapely.area(own)
    tree, least = shapely.STRtree(regions), math.inf
    for begin in range(0, count, PORTION):
        portion = prepared(own[begin : begin + PORTION])
        i, j = near_pairs(tree, portion, begin, count, reach)
        near_edge = portion[shapely.dwithin(edge, portion, reach)]
        first = np.concatenate([portion[i], np.full(len(near_edge), edge, dtype=object)])
        second = np.concatenate([regions[j], near_edge])
        if len(first):
            least = reach = _least_distance(first, second, reach)
    return _Seen(least, is_inside, areas)


def _least_distance(first: _Regions, second: _Regions, reach: float) -> float:
    """Smallest distance of pairs that are all within ``reach``.

    Halves the reach until few pairs are left: only those are measured.
    """
    if shapely.intersects(first, second).any():
        return 0.0
    least = 0.0
    for _ in range(_MOST_HALVINGS):
        if len(first) <= _FEW_PAIRS:
            break
        middle = (least + reach) / 2
        near = shapely.dwithin(first, second, middle)
        if near.any():
            first, second, reach = first[near], second[near], middle
        else:
            least = middle
    return min(distance(one, other) for one, other in zip(first, second, strict=True))


def compactness(outlines: Sequence[Outline]) -> dict[str, float]:
    """Share that items cover of their convex hull, smallest circle and upright box.

    Exact, of the flattened outlines in place; items that overlap count twice. All zero for
    no items.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]])])
    >>> {name: round(share, 3) for name, share in compactness([tile]).items()}
    {'hull': 1.0, 'circle': 0.637, 'box': 1.0}
    """
    if len(outlines) == 0:
        return {"hull": 0.0, "circle": 0.0, "box": 0.0}
    covered = sum(outline.area for outline in outlines)
    # The hull of a line through all points is theirs, and no geometry is made of each.
    line = shapely.linestrings(np.concatenate([outline.points for outline in outlines]))
    hull = shapely.convex_hull(line)
    left, top, right, bottom = hull.bounds
    return {
        "hull": covered / hull.area,
        "circle": float(covered / (math.pi * shapely.minimum_bounding_radius(hull) ** 2)),
        "box": covered / ((right - left) * (bottom - top)),
    }
