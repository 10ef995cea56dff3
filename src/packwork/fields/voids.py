"""Relocation into voids: the largest empty circle for each item in turn, which the item takes.

The one loop of everything that is put where there is most room: discs of a start, trapped items
between levels, items that separation finds no place for, bottlenecks of a finish. (Fillers, which
go into many voids at once at the turn that fits, look at all maxima: ``start/voids.py``.)
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

import numpy as np

from packwork.arrays import IntArray
from packwork.fields.clearance import Clearance


class Void(NamedTuple):
    """Place of one item: centre and radius of the largest empty circle that was left, px.

    The radius is below 0 if no room was left.
    """

    item: int
    x: float
    y: float
    radius: float


def largest_voids(
    room: Clearance,
    items: Iterable[int],
    taken_px: Callable[[int, float], float],
    *,
    least_px: float = -np.inf,
    among: Callable[[int], IntArray | None] | None = None,
    preferred: IntArray | None = None,
) -> Iterator[Void]:
    """Void of each item in turn, beside what earlier ones have taken.

    Parameters
    ----------
    room
        Where there is room; what items take is taken away from it.
    items
        Indices, in the order in which they choose.
    taken_px
        Radius that an item takes of a void of a given radius.
    least_px
        Radius of the smallest void that is used: the first item without one ends the search,
        unless it was bound to some pixels.
    among
        Pixels ``(m,)``, ``row * columns + column``, that an item is bound to; None for any.
    preferred
        Pixels that items not bound to any take as long as they fit there.

    Examples
    --------
    >>> room = Clearance(np.ones((10, 30), dtype=bool))
    >>> [(void.item, void.radius) for void in largest_voids(room, [7, 5], lambda *_: 4.0)]
    [(7, 4.5), (5, 4.5)]
    """
    for item in items:
        pixels = None if among is None else among(int(item))
        spot = room.largest() if pixels is None else room.largest_among(pixels)
        if pixels is None and preferred is not None:
            nearer = room.largest_among(preferred)
            spot = nearer if nearer[2] >= taken_px(int(item), nearer[2]) else spot
        x, y, radius = spot
        if radius < least_px:
            if pixels is None:
                return
            continue
        room.occupy(x, y, taken_px(int(item), radius))
        yield Void(int(item), x, y, radius)
