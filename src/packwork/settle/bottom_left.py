"""Bottom-left placement: discs one after another to the lowest free place.

B. Baker, E. Coffman and R. Rivest, "Orthogonal packings in two dimensions", SIAM Journal on
Computing 9 (1980), 846-855, doi:10.1137/0209064, place rectangles as far down, then as far left
as they go. Ours takes discs for items and any height for "down", and fills holes, too: candidates
are the free pixels and the places at which a disc touches two others. Discs that no other can come
to touch are forgotten, so that the work for each is that of the pile's surface and its holes.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from packwork.arrays import BoolArray, FloatArray, Image, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.fields.distance_transform import distance_inside, distance_to
from packwork.progress import Stop, never
from packwork.raster.coverage import TOUCHED, coverage
from packwork.settle.kernels.circle_packing import ROUNDING

HeightOf = Callable[[FloatArray, int], FloatArray]
"""Heights ``(m,)`` of an item at points ``(m, 2)``."""

PIXELS_ACROSS = 16.0
"""Pixels across the mean disc. More finds places in smaller voids and takes longer. Tried."""

MOST_PIXELS = 2**20
"""Pixels of the image of free room at most. Chosen."""

STEPS = 3
"""Parts of a pixel to which a place by a wall is refined. More takes longer, fewer leave
gaps that the rounds have to close. Chosen."""

AT_ONCE = 16
"""Places that are looked at together; of pixels, then twice as many, and so on. Chosen."""

SURE_PX, NEAR_PX = 1.0, 3.0
"""Pixels by which room, and by which nearness to it, may be misjudged: room is known at pixels'
centres, and places are sought about them. Derived: half a diagonal, three halves and rounding."""

EVERY = 200
"""Discs that are placed between two looks at what can be forgotten, reports and looks for a stop: a
second's work at most. More makes each place slower, fewer looks more often. Chosen."""

AROUND_GAP = 1 + 1e-3
"""Factor on the gap, so that what touches passes the check. Larger leaves gaps. Chosen."""


class FreeRoom:
    """Free room of an arrangement, in which discs find their lowest places.

    ``arrangement``: whose container is the room.
    ``standing``: ``(m,)`` indices of items that are in it already.
    ``gap``: least distance of two discs, and of a disc and the edge.
    """

    def __init__(self, arrangement: Arrangement, standing: IntArray, gap: float) -> None:
        self._gap = gap * AROUND_GAP
        left, top, right, bottom = arrangement.container.bounds
        width, height = right - left, bottom - top
        wanted = PIXELS_ACROSS / (2 * float(np.mean(arrangement.radii)) + gap)
        self._px_per_cu = min(wanted, np.sqrt(MOST_PIXELS / (width * height)))
        shape = int(height * self._px_per_cu) + 2, int(width * self._px_per_cu) + 2
        self._corner = np.array([left, top])

        def image(points: FloatArray, starts: IntArray) -> Image:
            return coverage((points - self._corner) * self._px_per_cu, starts, shape, np.float32)

        free = image(arrangement.container.points, arrangement.container.starts) > 1 - TOUCHED
        if len(standing):
            free &= image(*arrangement.rings(standing)) < TOUCHED
        self._wall = distance_inside(free) / self._px_per_cu
        rows, columns = np.indices(shape)
        pixels = np.column_stack([columns.ravel(), rows.ravel()]) + 0.5
        self._points = self._corner + pixels / self._px_per_cu
        self._largest = float(arrangement.radii.max())
        # Room beyond that of the largest disc is not needed.
        self._most = self._largest + self._gap + 2 / self._px_per_cu
        self._room = np.minimum(self._wall.ravel(), self._most)
        self._lowest: dict[int, IntArray] = {}
        self._discs = np.empty((0, 3))
        self._pairs = np.empty((0, 2), dtype=np.int64)

    def place(self, radius: float, item: int, kind: int, heights: HeightOf) -> FloatArray | None:
        """Lowest centre ``(2,)`` for a disc; None if it fits nowhere. It then stands there.

        ``item``: whose heights count.
        ``kind``: items of one number have the same ones.
        """
        if kind not in self._lowest:
            # Of room alone: heights above a coast of many edges take time.
            room = np.flatnonzero(self._wall.ravel() > self._gap)
            lowest_first = np.argsort(heights(self._points[room], item), kind="stable")
            self._lowest[kind] = room[lowest_first]
        found = [self._by_pixel(radius, item, kind, heights), self._by_pair(radius, item, heights)]
        centres = [centre for centre in found if centre is not None]
        if not centres:
            return None
        centre = min(centres, key=lambda point: float(heights(point[None], item)[0]))
        self._occupy(centre, radius)
        return centre

    def forget(self, least: float) -> None:
        """Forget pixels without room for discs of a radius or more, and discs that none can touch.

        No place changes: one that such a disc would rule out, or give, has no room by its pixel.
        """
        px = 1 / self._px_per_cu
        has_room = self._room >= least + self._gap - SURE_PX * px
        self._lowest = {kind: order[has_room[order]] for kind, order in self._lowest.items()}
        away = distance_to(has_room.reshape(self._wall.shape)).ravel() * px
        reach = self._discs[:, 2] + self._largest + self._gap + NEAR_PX * px
        is_kept = away[self._pixels(self._discs[:, :2])[0]] <= reach
        pairs = self._pairs[is_kept[self._pairs].all(axis=1)]
        self._pairs = (np.cumsum(is_kept) - 1)[pairs]
        self._discs = self._discs[is_kept]

    def _by_pixel(
        self, radius: float, item: int, kind: int, heights: HeightOf
    ) -> FloatArray | None:
        """The lowest pixel with room, and the lowest place about it on a finer grid."""
        best = self._lowest_pixel(radius + self._gap, self._lowest[kind])
        if best is None:
            return None
        here = self._points[best]
        ticks = np.arange(-STEPS, STEPS + 1) / STEPS / self._px_per_cu
        grid = np.column_stack([np.repeat(ticks, len(ticks)), np.tile(ticks, len(ticks))])
        points = np.vstack([here, here + grid])
        is_free = self._is_free(points, radius)
        is_free[0] = True
        free = points[is_free]
        return np.asarray(free[np.argmin(heights(free, item))])

    def _lowest_pixel(self, reach: float, pixels: IntArray) -> int | None:
        """The first of some pixels with so much room."""
        first, some = 0, AT_ONCE
        while first < len(pixels):
            fitting = np.flatnonzero(self._room[pixels[first : first + some]] >= reach)
            if len(fitting):
                return int(pixels[first + fitting[0]])
            first, some = first + some, 2 * some
        return None

    def _by_pair(self, radius: float, item: int, heights: HeightOf) -> FloatArray | None:
        rings = self._discs + np.array([0.0, 0.0, radius + self._gap])
        points = _crossings(rings[self._pairs[:, 0]], rings[self._pairs[:, 1]])
        if len(points) == 0:
            return None
        pixels, off = self._pixels(points)
        # Room changes by no more than the way, so a look at the pixel drops most places.
        points = points[self._room[pixels] + off >= radius + self._gap]
        order = np.argsort(heights(points, item), kind="stable")
        for first in range(0, len(order), AT_ONCE):
            some = points[order[first : first + AT_ONCE]]
            free = np.flatnonzero(self._is_free(some, radius))
            if len(free):
                return np.asarray(some[free[0]])
        return None

    def _pixels(self, points: FloatArray) -> tuple[IntArray, FloatArray]:
        """Pixel in which each point lies, and how far from its centre."""
        columns, rows = np.floor((points - self._corner) * self._px_per_cu).astype(np.int64).T
        shape = self._wall.shape
        rows, columns = np.clip(rows, 0, shape[0] - 1), np.clip(columns, 0, shape[1] - 1)
        pixels = rows * shape[1] + columns
        return pixels, np.hypot(*(points - self._points[pixels]).T)

    def _is_free(self, points: FloatArray, radius: float) -> BoolArray:
        """Mask of the points whose disc touches neither the edge nor another disc."""
        pixels, off = self._pixels(points)
        reach = radius + self._gap
        is_free = np.asarray(self._wall.ravel()[pixels] - off >= reach)
        if len(self._discs):
            between = points[:, None] - self._discs[:, :2]
            least = (self._discs[:, 2] + reach) * (1 - ROUNDING)
            is_free &= (np.hypot(between[..., 0], between[..., 1]) >= least).all(axis=1)
        return is_free

    def _occupy(self, centre: FloatArray, radius: float) -> None:
        apart = np.hypot(*(self._discs[:, :2] - centre).T) - self._discs[:, 2] - radius
        near = np.flatnonzero(apart < 2 * (self._largest + self._gap))
        new = np.column_stack([near, np.full(len(near), len(self._discs))])
        self._pairs = np.vstack([self._pairs, new])
        self._discs = np.vstack([self._discs, [*centre, radius]])
        self._take_room(centre, radius)

    def _take_room(self, centre: FloatArray, radius: float) -> None:
        """Less room about a disc, as far as it can be felt."""
        rows, columns = self._wall.shape
        reach = (radius + self._most) * self._px_per_cu
        x, y = (centre - self._corner) * self._px_per_cu
        top, bottom = max(int(y - reach), 0), min(int(y + reach) + 2, rows)
        left, right = max(int(x - reach), 0), min(int(x + reach) + 2, columns)
        away = np.hypot(
            np.arange(left, right)[None] + 0.5 - x, np.arange(top, bottom)[:, None] + 0.5 - y
        )
        window = self._room.reshape(rows, columns)[top:bottom, left:right]
        np.minimum(window, away / self._px_per_cu - radius, out=window)


def _crossings(a: FloatArray, b: FloatArray) -> FloatArray:
    """``(m, 2)`` points in which rings cross, pair by pair, ``(k, 3)`` x, y and radius each."""
    between = b[:, :2] - a[:, :2]
    far = np.maximum(np.hypot(between[:, 0], between[:, 1]), 1e-300)
    along = (a[:, 2] ** 2 - b[:, 2] ** 2 + far**2) / (2 * far)
    across = a[:, 2] ** 2 - along**2
    do_cross = across >= 0
    unit = (between / far[:, None])[do_cross]
    foot = a[do_cross, :2] + unit * along[do_cross, None]
    aside = np.column_stack([-unit[:, 1], unit[:, 0]]) * np.sqrt(across[do_cross])[:, None]
    return np.vstack([foot + aside, foot - aside])


def bottom_left(
    arrangement: Arrangement,
    items: IntArray,
    standing: IntArray,
    heights: HeightOf,
    kinds: IntArray,
    gap: float,
    tell: Callable[[IntArray], None] = lambda _: None,
    stop: Stop = never,
) -> IntArray:
    """Put items ``(m,)``, in this order, to their lowest places; indices of those without one.

    Each is taken for the disc about its origin that holds it, so the arrangement gets no
    conflicts.

    ``standing``: ``(k,)`` indices of items that stay where they are; all others count as not there.
    ``kinds``: ``(n,)`` items of one number have the same heights.
    ``tell``: called with the items that have a place by now, from time to time.
    ``stop``: asked as often; those that follow then get no place.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> box = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = box.mapped(np.array([[9.0, 0, 0], [0, 9.0, 0]]))
    >>> two = Arrangement([box] * 2, wall, np.zeros((2, 4)))
    >>> both, none = np.arange(2), np.arange(0)
    >>> def depth(points, item):
    ...     return -points[:, 1]
    >>> left = bottom_left(two, both, none, depth, np.zeros(2, int), 0.1)
    >>> len(left), bool((two.places[:, 1] > 7).all()), len(two.conflicts(two.pairs(1.0), 0.1))
    (0, True, 0)
    """
    room = FreeRoom(arrangement, standing, gap)
    radii = arrangement.radii[items]
    least = np.minimum.accumulate(radii[::-1])[::-1]
    has_place = np.zeros(len(items), dtype=bool)
    for n, k in enumerate(items):
        if n and n % EVERY == 0:
            tell(np.concatenate([standing, items[has_place]]))
            if stop():
                break
            room.forget(float(least[n]))
        centre = room.place(float(radii[n]), int(k), int(kinds[k]), heights)
        if centre is None:
            continue
        has_place[n] = True
        place = arrangement.places[k].copy()
        place[:2] = centre
        arrangement.put(np.array([k]), place[None])
    return np.asarray(items[~has_place])
