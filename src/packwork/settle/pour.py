"""Emitters: items that come in one after another while the others settle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.progress import Stop
from packwork.settle.settle import FIRST_TRUST, Settling

STILL = 0.02
"""Mean way of a round, in its bounds, below which nothing makes way any more for the next item.
Larger gives up on slow heaps, smaller waits in vain. Chosen."""

AWAY = 1e3
"""Where items wait, in sides of the container's box: far from all others. Chosen."""


@dataclass(frozen=True, eq=False)
class Source:
    """Source of a pour's items.

    ``points``: ``(m, 2)`` places of their origins, canvas units; earlier ones are preferred within
    each of ``ranks``.
    ``ranks``: ``(m,)`` places of a lower rank come first.
    ``every``: rounds between one item and the next; 0 for all at once.
    """

    points: FloatArray
    ranks: IntArray
    every: int


class Spout:
    """Finds free places of a source for discs.

    ``region``: room that a disc has to lie in.
    ``gap``: least distance to keep.
    ``rng``: chooses among places of one rank.
    """

    def __init__(
        self, source: Source, region: shapely.Geometry, gap: float, rng: np.random.Generator
    ) -> None:
        points = shapely.points(source.points)
        shapely.prepare(region)
        inside = shapely.contains(region, points)
        room = np.where(inside, shapely.distance(region.boundary, points), -1.0)
        self._source, self._room, self._gap, self._rng = source, room, gap, rng

    def place(self, radius: float, discs: FloatArray) -> FloatArray | None:
        """Free centre ``(2,)``, canvas units, for a disc among others ``(k, 3)``: x, y, radius."""
        points = self._source.points
        is_free = self._room >= radius + self._gap
        for x, y, other in discs:
            apart = np.hypot(points[:, 0] - x, points[:, 1] - y)
            is_free &= apart >= radius + other + self._gap
        free = np.flatnonzero(is_free)
        if len(free) == 0:
            return None
        best = free[self._source.ranks[free] == self._source.ranks[free].min()]
        return np.asarray(points[self._rng.choice(best)])


def pour(
    settling: Settling,
    spout: Spout,
    queue: IntArray,
    every: int,
    tell: Callable[[FloatArray], None],
    stop: Stop,
) -> tuple[IntArray, int]:
    """Let items in while all go down; indices of those that found no way in, and rounds taken.

    ``settling``: its arrangement holds all items; none is active at first.
    ``queue``: ``(m,)`` indices of items, in the order in which they come.
    ``every``: rounds between one item and the next.
    """
    arrangement = settling.arrangement
    _send_away(settling)
    settling.active = np.arange(0)
    waiting = list(queue)
    rounds = 0
    while waiting and not stop():
        is_in = rounds % every == 0 and _let_in(settling, spout, int(waiting[0]))
        if is_in:
            waiting.pop(0)
        gained = settling.round(FIRST_TRUST, rounds) if len(settling.active) else 0.0
        rounds += 1
        tell(arrangement.places)
        if not is_in and rounds % every == 0 and settling.is_still(gained, STILL * FIRST_TRUST):
            break
    return np.array(waiting, dtype=np.int64), rounds


def _send_away(settling: Settling) -> None:
    arrangement = settling.arrangement
    left, top, right, bottom = arrangement.container.bounds
    places = arrangement.places.copy()
    places[:, 0] = left - AWAY * (right - left + bottom - top)
    arrangement.put(np.arange(arrangement.count), places)


def _let_in(settling: Settling, spout: Spout, item: int) -> bool:
    """Put an item to a free place of the spout; False if there is none."""
    arrangement = settling.arrangement
    radii, active = arrangement.radii, settling.active
    discs = np.column_stack([arrangement.places[active, :2], radii[active]])
    centre = spout.place(float(radii[item]), discs)
    if centre is None:
        return False
    place = arrangement.places[item].copy()
    place[:2] = centre
    arrangement.put(np.array([item]), place[None])
    settling.active = np.sort(np.append(active, item))
    return True
