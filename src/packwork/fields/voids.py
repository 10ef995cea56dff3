"""Voids: the largest empty circle about each pixel, and relocation of items into the largest.

From a Euclidean distance transform; after each disc only a window round it is updated. This is the
one loop of everything that is put where there is most room: discs of a start, trapped items between
levels, items that separation finds no place for, bottlenecks of a finish. (Fillers, which go into
many voids at once at the turn that fits, look at all maxima: ``start/voids.py``.)
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.fields.distance_transform import distance_inside


class Clearance:
    """Radius of the largest free disc about each pixel's centre; ``free``: where there is room.

    What repeats over the plane is taken away at all ``shifts`` ``(s, 2)``, px, too; nothing is put
    into a ``margin`` of pixels at the image's edge, where the repeats are seen.

    >>> room = Clearance(np.ones((9, 9), dtype=bool))
    >>> room.largest()
    (4.5, 4.5, 4.5)
    >>> room.occupy(4.5, 4.5, 3.0)
    >>> room.largest()[2] < 4.5
    True
    """

    def __init__(self, free: BoolArray, shifts: FloatArray | None = None, margin: int = 0) -> None:
        self._radius = distance_inside(free)
        self._radius[~free] = -np.inf
        self._shifts = [(0.0, 0.0), *([] if shifts is None else shifts.tolist())]
        if margin:
            inner = self._radius[margin:-margin, margin:-margin].copy()
            self._radius[:] = -np.inf
            self._radius[margin:-margin, margin:-margin] = inner
        # Of each row the largest: to look through all of them for each of many takes long.
        self._rows = self._radius.max(axis=1)
        self._largest: tuple[float, float, float] | None = None

    def largest(self) -> tuple[float, float, float]:
        """Pixel coordinates ``(x, y)`` of the roomiest place and its radius (may be < 0)."""
        if self._largest is None:
            row = int(np.argmax(self._rows))
            column = int(np.argmax(self._radius[row]))
            self._largest = column + 0.5, row + 0.5, float(self._radius[row, column])
        return self._largest

    def largest_among(self, pixels: IntArray) -> tuple[float, float, float]:
        """Like :meth:`largest`, of pixels ``(n,)`` alone, ``row * columns + column`` each.

        >>> Clearance(np.ones((3, 9), dtype=bool)).largest_among(np.array([9, 10]))
        (1.5, 1.5, 1.5)
        """
        radii = self._radius.ravel()[pixels]
        best = int(np.argmax(radii))
        row, column = divmod(int(pixels[best]), self._radius.shape[1])
        return column + 0.5, row + 0.5, float(radii[best])

    def occupy(self, x: float, y: float, radius: float) -> None:
        """Take a disc away; only the pixels it can concern are looked at."""
        room = max(self.largest()[2], 0.0)
        for right, down in self._shifts:
            self._occupy(x + right, y + down, radius, radius + room + 1)
        self._largest = None

    def _occupy(self, x: float, y: float, radius: float, reach: float) -> None:
        rows, columns = self._radius.shape
        top, bottom = max(int(y - reach), 0), min(int(y + reach) + 1, rows)
        left, right = max(int(x - reach), 0), min(int(x + reach) + 1, columns)
        if top >= bottom or left >= right:
            return
        away = np.hypot(
            np.arange(left, right)[None, :] + 0.5 - x, np.arange(top, bottom)[:, None] + 0.5 - y
        )
        window = self._radius[top:bottom, left:right]
        np.minimum(window, away - radius, out=window)
        self._rows[top:bottom] = self._radius[top:bottom].max(axis=1)


class Void(NamedTuple):
    """Centre and radius of the largest empty circle left for an item, px; below 0 for no room."""

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
    """Void of each item in turn, beside what earlier ones have taken away from ``room``.

    ``taken_px``: radius that an item takes of a void of a given radius; ``least_px``: radius of the
    smallest void that is used: the first item without one ends the search, unless it was bound to
    some pixels; ``among``: pixels ``(m,)`` that an item is bound to, None for any; ``preferred``:
    pixels that items not bound to any take as long as they fit there.

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
