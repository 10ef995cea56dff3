"""Whether a heap is at rest, judged by plain geometry: shares no code with the pile.

Two tries to bring items lower, both exact: a linear programme over the distances of all near
pairs, again and again, and small moves and turns at random, item by item.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from scipy.optimize import linprog
from scipy.sparse import coo_matrix
from shapely import affinity

from packwork.arrays import FloatArray

STEPS = (0.01, 0.003, 0.001, 0.0003)
"""Largest moves that are tried, as shares of the canvas."""

ROUNDS = 3
"""Programmes with each of them."""

TRIES = 12
"""Random moves of each item with each of them."""


def mean_depth(regions: Sequence[shapely.Polygon]) -> float:
    """Area-weighted mean of the centroids' y."""
    areas = shapely.area(np.array(regions))
    return float(np.average(shapely.get_y(shapely.centroid(np.array(regions))), weights=areas))


def lowered_by_programmes(
    regions: Sequence[shapely.Polygon], room: shapely.Polygon, side: float
) -> list[shapely.Polygon]:
    """The same after moves that programmes find for all together, each as far as it is exact.

    The lowest go first; an item whose move would meet another stays.
    """
    now = list(regions)
    for step in STEPS:
        for _ in range(ROUNDS):
            moves = _programme(now, room, step * side)
            lowest_first = np.argsort(-shapely.get_y(shapely.centroid(np.array(now))))
            for k in lowest_first:
                others = [now[j] for j in _near(now, int(k), 3 * step * side)]
                for share in (1.0, 0.5, 0.2):
                    moved = affinity.translate(now[k], *(share * moves[k]))
                    if not shapely.contains_properly(room, moved):
                        continue
                    if not any(moved.intersects(other) for other in others):
                        now[k] = moved
                        break
    return now


def lowered_at_random(
    regions: Sequence[shapely.Polygon],
    room: shapely.Polygon,
    side: float,
    rng: np.random.Generator,
) -> list[shapely.Polygon]:
    """The same after many small moves, each of one item, each kept if it is exact and down."""
    now = list(regions)
    for step in STEPS:
        near = [_near(now, k, 4 * step * side + 0.02 * side) for k in range(len(now))]
        for k in rng.permutation(np.repeat(np.arange(len(now)), TRIES)):
            dx, dy = rng.normal(0, step * side, 2)
            turned = affinity.rotate(now[k], rng.normal(0, 200 * step), origin=now[k].centroid)
            moved = affinity.translate(turned, dx, abs(dy))
            if not shapely.contains_properly(room, moved):
                continue
            if not any(moved.intersects(now[j]) for j in near[k]):
                now[k] = moved
    return now


def _near(regions: Sequence[shapely.Polygon], k: int, reach: float) -> list[int]:
    boxes = shapely.bounds(np.array(regions))
    left, top, right, bottom = boxes[k] + (-reach, -reach, reach, reach)
    hit = (boxes[:, 0] < right) & (boxes[:, 2] > left) & (boxes[:, 1] < bottom)
    hit &= boxes[:, 3] > top
    return [int(j) for j in np.flatnonzero(hit) if j != k]


def _programme(
    regions: Sequence[shapely.Polygon], room: shapely.Polygon, step: float
) -> FloatArray:
    """``(n, 2)`` moves that bring the mean lowest and keep each pair's nearest points apart."""
    n, shapes = len(regions), np.array(regions)
    tree = shapely.STRtree(shapes)
    first, second = tree.query(shapes, predicate="dwithin", distance=3 * step)
    pairs = [(i, j) for i, j in zip(first, second, strict=True) if i < j]
    entries: list[tuple[int, int, float]] = []
    limits: list[float] = []

    def keep(line: shapely.LineString, items: Sequence[tuple[int, float]]) -> None:
        ends = shapely.get_coordinates(line)
        gap = float(np.hypot(*(ends[1] - ends[0])))
        normal = (ends[1] - ends[0]) / max(gap, 1e-12)
        for item, sign in items:
            entries.extend((len(limits), 2 * item + c, sign * normal[c]) for c in (0, 1))
        limits.append(gap)

    for i, j in pairs:
        keep(shapely.shortest_line(shapes[i], shapes[j]), [(i, 1.0), (j, -1.0)])
    for i in np.flatnonzero(shapely.dwithin(shapes, room.boundary, 3 * step)):
        keep(shapely.shortest_line(shapes[i], room.boundary), [(int(i), 1.0)])
    rows, columns, values = zip(*entries, strict=True)
    matrix = coo_matrix((values, (rows, columns)), shape=(len(limits), 2 * n))
    cost = np.zeros(2 * n)
    cost[1::2] = -shapely.area(shapes)
    found = linprog(cost, A_ub=matrix.tocsr(), b_ub=limits, bounds=(-step, step))
    return np.zeros((n, 2)) if found.x is None else found.x.reshape(n, 2)
