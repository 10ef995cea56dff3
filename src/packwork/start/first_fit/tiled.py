"""Thousands of items of one common size, put one after another on tiles of a fine image.

First-fit decreasing where most is touched, as in ``first_fit``; but an item looks at a few tiles,
drawn by lot, in place of the whole image, so that pixels may be so fine that no exact search has to
follow. Tiles in which a smaller item found no place come last. Room between two items goes by the
smaller one of them, which is the later one, and the edge asks for none of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.progress import Stop, never
from packwork.raster.coverage import TOUCHED
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_fit.first_fit import MOST_SIZES, URGENCY
from packwork.start.first_fit.greedy_board import GRAZED
from packwork.start.first_fit.occupancy import (
    Occupancy,
    Stencil,
    covered,
    stencil_of,
)
from packwork.start.first_fit.tile_board import REACH, TileBoard
from packwork.start.first_poses import container_image

PIXELS_EACH = 42
"""Side of an item's share of the container, pixels. More waste less room at the edges of pixels and
take longer. Tried."""

LEAST_PX, MOST_PX = 800, 4_000
"""Sides of the image at least and at most: two boards of the most take 150 MB."""

FEW, OF_FEW = 250, 1_500
"""Items up to which all sizes are tried with care: tiles with a place of which the best is taken,
times items. More take longer. Tried."""

COMPARED = 3
"""Such tiles of more items at the last size; sizes before are sought with the first tile that has a
place, in a third of the time. More take longer. Tried."""

FIRST_SHARE, STEEPER = 0.46, 0.07
"""Share of the container that the first try's items cover, and how much more for each e times that
there are more of them than of alike ones of as much entropy. Any others take more tries.
Measured."""

STRIDE, WIDEST, CLOSE = 1.012, 1.04, 1.006
"""Factor between the first two sizes tried, squared while all fit up to the widest, and that
between one that fits and one that does not at which the search ends. Smaller finds more. Chosen."""

SHORT = 1.5
"""By how much less all must cover, over the share that found no place. Smaller takes more tries,
larger begins from below. Measured."""

BETTER = (1.006, 1.003)
"""Larger sizes that are tried in turn then. Larger ones mostly find no place. Measured."""

MISSING = 0.015
"""Share of all areas without a place from which a size is given up. Chosen."""


LOOSE, FEWER = 0.9, 0.75
"""Share of the items, the smallest, that go where there is most room at first, and of those that
found a place there how many do next. More take longer, fewer leave some in heaps. Tried."""

MOST_LOOSE = 2_000
"""Items of which the smallest do so at most: of more, tiles are small beside the whole. Chosen."""


@dataclass(frozen=True, eq=False)
class Tried:
    """Outcome of one size: poses, the order, and the share of all areas that found no place."""

    factor: float
    missing: float
    poses: Poses
    order: IntArray


def tiled_fit(
    container: Container,
    outlines: Sequence[Outline],
    scales: FloatArray,
    angles: FloatArray,
    rng: np.random.Generator,
    *,
    apart: tuple[float, float] = (0.0, 0.0),
    margin_cu: float = 0.0,
    attempts: int = 1,
    tell: Callable[[Poses], None] = lambda poses: None,
    stop: Stop = never,
) -> Poses | None:
    """Poses at the largest common factor found at which nothing overlaps; None if there is none.

    ``scales``, ``angles``: ``(n,)`` in proportion, and radians.
    ``apart``: room that an item keeps along and across itself from those that are no smaller, item
    units.
    ``margin_cu``: room that all keep from each other and from the edge, canvas units.
    ``attempts``: orders tried for each size of few items; of many, one.
    ``tell``: told of what lies where after each size that fits.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = tile.mapped(similarity(50.0, 50.0, 0.0, 50.0))
    >>> container = Container("", "", wall, 100.0, 100.0)
    >>> rng = np.random.default_rng(0)
    >>> poses = tiled_fit(container, [tile] * 4, np.ones(4), np.zeros(4), rng)
    >>> bool(49 < 2 * poses.scale[0] <= 50), len(set(zip(poses.x, poses.y)))
    (True, 4)
    """
    own = np.array([outline.area for outline in outlines])
    areas = own * scales**2
    share = float(areas.sum()) / container.outline.area
    search = _TiledSearch(container, outlines, scales, angles, own, rng, apart, margin_cu, attempts)
    parts = areas / areas.sum()
    first = FIRST_SHARE + STEEPER * (math.log(len(parts)) + float(parts @ np.log(parts)))
    best = _largest(search, math.sqrt(first / share), tell, stop)
    if best is not None and len(outlines) > FEW:
        # Sizes were sought in haste.
        search.compared = COMPARED
        for times in BETTER:
            finer = search.best_at(times * best.factor, stop)
            if finer is not None and not finer.missing:
                best = finer
                tell(best.poses)
                break
    return None if best is None else search.loosened(best, stop).poses


def _largest(
    search: _TiledSearch, factor: float, tell: Callable[[Poses], None], stop: Stop
) -> Tried | None:
    """The largest size found at which nothing is missing, beginning with one."""
    stride = STRIDE
    best: Tried | None = None
    lost: Tried | None = None
    for _ in range(MOST_SIZES):
        found = search.best_at(factor, stop)
        if found is None:
            break
        if found.missing:
            lost = found
        else:
            best = found
            tell(found.poses)
        if lost is None:
            factor, stride = factor * stride, min(stride**2, WIDEST)
            continue
        # What would have fitted, were as much left bare.
        factor = lost.factor * math.sqrt(max(1 - SHORT * lost.missing, 0.5))
        if best is not None:
            if lost.factor <= best.factor * CLOSE:
                break
            if factor <= best.factor:
                factor = math.sqrt(best.factor * lost.factor)
            factor = min(max(factor, best.factor * CLOSE), lost.factor / math.sqrt(CLOSE))
    return best


class _TiledSearch:
    """Items, their room and the image, the same for all sizes."""

    def __init__(
        self,
        container: Container,
        outlines: Sequence[Outline],
        scales: FloatArray,
        angles: FloatArray,
        own: FloatArray,
        rng: np.random.Generator,
        apart: tuple[float, float],
        margin_cu: float,
        attempts: int,
    ) -> None:
        each = math.sqrt(container.outline.area / len(outlines)) / container.side
        side = min(max(round(PIXELS_EACH / each), LEAST_PX), MOST_PX)
        image, self._px_per_cu = container_image(container, side)
        self._inside: BoolArray = image > 1 - TOUCHED
        self._edge = Occupancy(self._inside, 0)
        self._outlines, self._scales, self._angles = outlines, scales, angles
        self._areas, self._rng, self._apart = own * scales**2, rng, apart
        self._margin_px = margin_cu / 2 * self._px_per_cu + GRAZED
        self._urgency = self._areas.copy()
        self.compared = OF_FEW // len(outlines) if len(outlines) <= FEW else 1
        self._attempts = max(1, min(attempts, FEW // len(outlines)))

    def best_at(self, factor: float, stop: Stop) -> Tried | None:
        """The best of some attempts at one size, in which what had no place comes earlier."""
        best: Tried | None = None
        for _ in range(self._attempts):
            found = self._put_all(factor, stop)
            if found is None or (best is not None and best.missing <= found.missing):
                continue
            best = found
            if not found.missing:
                break
        return best

    def loosened(self, tight: Tried, stop: Stop) -> Tried:
        """The same with the last items where there is most room, as many as can be so.

        Where large items alone bound the size, small ones would lie in a heap.
        """
        count = len(self._scales)
        if count > MOST_LOOSE:
            return tight
        stencils = [self._stencil(k, tight.factor) for k in range(count)]
        loose = round(LOOSE * count)
        while loose:
            kept, board, poses = count - loose, self._board(), tight.poses
            for k in tight.order[:kept]:
                place = np.array([poses.y[k], poses.x[k]]) * self._px_per_cu
                board.take(stencils[k].mask, *(np.rint(place).astype(int) - stencils[k].origin))
            board.loosen()
            x, y = poses.x.copy(), poses.y.copy()
            for found, k in enumerate(tight.order[kept:]):
                if stop():
                    return tight
                put = self._put(board, k, tight.factor, stencils[k])
                if put is None:
                    loose = int(FEWER * found)
                    break
                x[k], y[k] = put
            else:
                return replace(tight, poses=Poses(x, y, self._angles, poses.scale))
        return tight

    def _board(self) -> TileBoard:
        return TileBoard(self._edge, self._inside, self.compared, self._rng)

    def _put_all(self, factor: float, stop: Stop) -> Tried | None:
        """Items put one after another at one size; None if stopped."""
        board, order = self._board(), np.argsort(-self._urgency, kind="stable")
        x, y = np.zeros((2, len(order)))
        missing, all_areas = 0.0, float(self._areas.sum())
        for k in order:
            if stop():
                return None
            place = self._put(board, k, factor, self._stencil(k, factor))
            if place is None:
                self._urgency[k] *= URGENCY
                missing += float(self._areas[k]) / all_areas
                if missing > MISSING:
                    break
                continue
            x[k], y[k] = place
        poses = Poses(x, y, self._angles, factor * self._scales)
        return Tried(factor, missing, poses, order)

    def _stencil(self, item: int, factor: float) -> Stencil:
        """Pixels that an item takes at a size."""
        px = factor * float(self._scales[item]) * self._px_per_cu
        posed = similarity(0.0, 0.0, float(self._angles[item]), px)
        return stencil_of(*covered(self._outlines[item].mapped(posed), self._margin_px), REACH)

    def _put(
        self, board: TileBoard, item: int, factor: float, stencil: Stencil
    ) -> tuple[float, float] | None:
        """Point at which an item is put, canvas units; None if it finds no place."""
        angle = float(self._angles[item])
        px = factor * float(self._scales[item]) * self._px_per_cu
        turned = np.abs([[np.cos(angle), np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        room = np.rint(turned @ self._apart * px).astype(int)
        corner = board.put(stencil, int(room[1]), int(room[0]), float(self._areas[item]))
        if corner is None:
            return None
        row, column = np.array(corner) + stencil.origin
        return column / self._px_per_cu, row / self._px_per_cu
