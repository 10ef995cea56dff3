"""Parts of a nest slide together, left and then up, so that what is left over is one piece.

A search ends where nothing overlaps, with parts wherever there was room: a row may stand apart from
the others. Each part slides along an axis until it meets another one, its ground or what lies there
(bottom-left compaction, after Jakobs 1996); no angle changes, and none goes right or down.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import shapely
from shapely.geometry import polygon

from packwork.geometry.polygon import Region
from packwork.geometry.rectangles import ROUNDING
from packwork.separation.shapes import Floats

MOST_PUSHED = 2_000
"""Parts that are pushed together: so many discs of 64 corners that lay apart take 4 s."""

MOST_ROUNDS = 4
"""Rounds of both axes. Of 400 discs that lay apart, eight more brought .03 mm in 40, in three times
the time. Tried."""

SETTLED = 1e-6
"""Way of a round, over the longer side of all parts, that ends it."""


class _Sides(NamedTuple):
    """Edges that look back along an axis, and those that look ahead, and the bounds of both.

    Edges are rows (from, to, place at from, slope): from and to across the axis, place along it.
    """

    back: Floats
    ahead: Floats
    bounds: tuple[float, float, float, float]
    """Along and across: least, then largest."""


def pushed(regions: Sequence[Region], ground: Region, held: Sequence[Region] = ()) -> Floats:
    """Ways (x, y) of all parts, ``(n, 2)``, none of them positive.

    Parameters
    ----------
    regions
        Parts where they lie, apart, each with its half of the gap.
    ground
        Region that they lie in; of a strip, as much of it as they take.
    held
        What lies there and stays.
    """
    ways = np.zeros((len(regions), 2))
    if not 0 < len(regions) <= MOST_PUSHED:
        return ways
    x0, y0, x1, y1 = shapely.total_bounds([*regions, ground])
    size = float(max(x1 - x0, y1 - y0, abs(x0), abs(y0)))
    slack = ROUNDING * size
    sides = [[_sides(one, axis, slack) for one in (*regions, *held)] for axis in (0, 1)]
    walls = [_sides(ground, axis, slack).back for axis in (0, 1)]
    boxes = np.array([one.bounds for one in sides[0]])
    for _ in range(MOST_ROUNDS):
        before = ways.copy()
        for axis in (0, 1):
            _slide(sides[axis], walls[axis], boxes, ways, axis, slack)
        if np.abs(ways - before).max() <= SETTLED * size:
            break
    return ways


def _slide(
    sides: Sequence[_Sides], wall: Floats, boxes: Floats, ways: Floats, axis: int, slack: float
) -> None:
    """Slide all parts along an axis, the foremost first; boxes and ways change."""
    along, across = axis, 1 - axis
    for k in np.argsort(boxes[: len(ways), along], kind="stable"):
        one, shift = sides[k], (float(ways[k, along]), float(ways[k, across]))
        way = _room(one.back, shift, wall, (0.0, 0.0), np.inf, slack)
        box = boxes[k]
        in_way = (
            (boxes[:, across] < box[across + 2] - slack)
            & (boxes[:, across + 2] > box[across] + slack)
            & (boxes[:, along] < box[along + 2])
            & (boxes[:, along + 2] > box[along] - way)
        )
        in_way[k] = False
        near = np.flatnonzero(in_way)
        for other in near[np.argsort(-boxes[near, along + 2], kind="stable")]:
            if way <= slack or box[along] - boxes[other, along + 2] >= way:
                break
            there = (0.0, 0.0)
            if other < len(ways):
                there = float(ways[other, along]), float(ways[other, across])
            way = _room(one.back, shift, sides[other].ahead, there, way, slack)
        if slack < way < np.inf:
            ways[k, along] -= way
            boxes[k, [along, along + 2]] -= way


def _room(
    back: Floats, shift: tuple[float, float], ahead: Floats, there: tuple[float, float],
    most: float, slack: float,
) -> float:  # fmt: skip
    """Ways that edges can slide until they meet others, at most as far as given."""
    along, across = shift[0] - there[0], shift[1] - there[1]
    if not (back.size and ahead.size):
        return most
    starts, ends = back[0] + across, back[1] + across
    seen = (ends > ahead[0].min() + slack) & (starts < ahead[1].max() - slack)
    facing = (ahead[1] > starts.min() + slack) & (ahead[0] < ends.max() - slack)
    mine, other = back[:, seen, None], ahead[:, None, facing]
    low = np.maximum(mine[0] + across, other[0])
    high = np.minimum(mine[1] + across, other[1])
    first, last = (
        mine[2] + along + (at - across - mine[0]) * mine[3]
        - (other[2] + (at - other[0]) * other[3])
        for at in (low, high)
    )  # fmt: skip
    meets = (high - low > slack) & (first + last > -2.0 * slack)
    if not meets.any():
        return most
    return min(most, max(float(np.minimum(first, last)[meets].min()), 0.0))


def _sides(region: Region, axis: int, slack: float) -> _Sides:
    """Edges of a region that look back along an axis, and ahead."""
    rings = [
        np.asarray(ring.coords)[:, :2]
        for part in shapely.get_parts(region) for one in (polygon.orient(part),)
        for ring in (one.exterior, *one.interiors)
    ]  # fmt: skip
    starts = np.vstack([ring[:-1] for ring in rings])
    ends = np.vstack([ring[1:] for ring in rings])
    rise = (ends - starts)[:, 1 - axis]
    # Inside lies left of each edge: what goes down along x looks back, what goes right along y.
    looks_back = rise < 0.0 if axis == 0 else rise > 0.0
    lower = np.where((rise < 0.0)[:, None], ends, starts)
    upper = np.where((rise < 0.0)[:, None], starts, ends)
    steep = np.abs(rise) > slack
    height = np.where(steep, np.abs(rise), 1.0)
    edges = np.vstack([
        lower[:, 1 - axis], upper[:, 1 - axis], lower[:, axis],
        (upper - lower)[:, axis] / height,
    ])  # fmt: skip
    return _Sides(edges[:, steep & looks_back], edges[:, steep & ~looks_back], region.bounds)
