"""Thousands of items of one common size, put one after another on tiles of a fine image.

First-fit decreasing where most is touched, as in ``first_fit``; but an item looks at a few tiles,
drawn by lot, in place of the whole image, so that pixels may be so fine that no exact search has to
follow. Tiles in which a smaller item found no place are passed over. Room between two items goes by
the smaller one of them, which is the later one, and the edge asks for none of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.fields.distance_transform import distance_inside
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.progress import Stop, never
from packwork.raster.coverage import TOUCHED
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_fit import _kernels
from packwork.start.first_fit.first_fit import MOST_SIZES, URGENCY
from packwork.start.first_fit.greedy_board import GRAZED
from packwork.start.first_fit.occupancy import (
    NOISE,
    NearestTaken,
    Occupancy,
    Stencil,
    covered,
    stencil_of,
)
from packwork.start.first_poses import container_image

PIXELS_EACH = 42
"""Side of an item's share of the container, pixels. More waste less room at the edges of pixels and
take longer. Tried."""

LEAST_PX, MOST_PX = 800, 4_000
"""Sides of the image at least and at most: two boards of the most take 330 MB."""

TILE_WORDS, TILE_PX = 8, 128
"""Width of a tile, in words of 64 pixels, and its height. Larger takes longer, smaller packs less,
and narrow ones take longer, too. Tried."""

FEW, OF_FEW = 250, 1_500
"""Items up to which all sizes are tried with care: tiles with a place of which the best is taken,
times items. More take longer. Tried."""

COMPARED = 5
"""Such tiles of more items at the last size; sizes before are sought with the first tile that has a
place, in a third of the time. More take longer. Tried."""

LOT = 0.5
"""How much of the order of tiles, those with most room first, is by lot. Larger looks at more tiles
without a place, smaller lays items of a size side by side. Tried."""

REACH, MOST_FRINGE = 4, 100
"""Width of the fringe in which taken pixels are counted, and how many of them. Tried."""

FIRST_SHARE, STEEPER = 0.4, 0.052
"""Share of the container that the first try's items cover, and how much more for each e times that
the largest is larger than the smallest. Any others take more tries. Measured."""

STRIDE, WIDEST, CLOSE = 1.02, 1.04, 1.006
"""Factor between the first two sizes tried, squared while all fit up to the widest, and that
between one that fits and one that does not at which the search ends. Smaller finds more. Chosen."""

SHORT = 2.5
"""By how much less all must cover, over the share that found no place. Smaller takes more tries,
larger begins from below. Measured."""

BETTER = (1.01, 1.004)
"""Larger sizes that are tried in turn then. Larger ones mostly find no place. Measured."""

MISSING = 0.03
"""Share of all areas without a place from which a size is given up. Chosen."""


LOOSE = (0.9, 0.75, 0.5, 0.3, 0.2, 0.1)
"""Shares of the items, the smallest, that go where there is most room, tried in turn. Chosen."""

MOST_LOOSE = 2_000
"""Items of which the smallest do so at most: of more, tiles are small beside the whole. Chosen."""

Pixel = TypeVar("Pixel", bound=np.generic)


class Tile(NamedTuple):
    """Part of the image in which the corner of a stencil's box may lie."""

    top: int
    word: int


@dataclass(frozen=True, eq=False)
class Tried:
    """Outcome of one size: poses, and the share of all areas that found no place."""

    factor: float
    missing: float
    poses: Poses


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
    share = float((own * scales**2).sum()) / container.outline.area
    search = _TiledSearch(container, outlines, scales, angles, own, rng, apart, margin_cu, attempts)
    first = FIRST_SHARE + STEEPER * math.log(float(scales.max() / scales.min()))
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
        # As many as the widest stencil that fits needs, its room counted in.
        self._levels = int(1.2 * max(image.shape)).bit_length()
        self._edge = Occupancy(self._inside, 0, levels=self._levels)
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
        """The same size with the smallest items where there is most room, as many as can be so.

        Where large items alone bound the size, small ones would lie in a heap.
        """
        for share in LOOSE if len(self._scales) <= MOST_LOOSE else ():
            found = self._put_all(tight.factor, stop, round(share * len(self._scales)))
            if found is None or not found.missing:
                return found or tight
        return tight

    def _put_all(self, factor: float, stop: Stop, loose: int = 0) -> Tried | None:
        """Items put one after another at one size; None if stopped.

        The last of them, ``loose`` many, go where there is most room.
        """
        scales = self._scales * factor
        board = _Board(self._edge, self._levels, self._inside, self.compared, self._rng)
        x, y = np.zeros((2, len(scales)))
        missing, all_areas = 0.0, float(self._areas.sum())
        for left, k in enumerate(np.argsort(-self._urgency, kind="stable"), loose - len(scales)):
            if stop():
                return None
            if left == 0:
                board.loosen()
            place = self._put(board, int(k), float(scales[k]))
            if place is None:
                self._urgency[k] *= URGENCY
                missing += float(self._areas[k]) / all_areas
                if missing > MISSING:
                    break
                continue
            x[k], y[k] = place
        return Tried(factor, missing, Poses(x, y, self._angles, scales))

    def _put(self, board: _Board, item: int, scale: float) -> tuple[float, float] | None:
        """Point at which an item is put, canvas units; None if it finds no place."""
        angle, px = float(self._angles[item]), scale * self._px_per_cu
        posed = self._outlines[item].mapped(similarity(0.0, 0.0, angle, px))
        narrow = stencil_of(*covered(posed, self._margin_px), REACH)
        turned = np.abs([[np.cos(angle), np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        room = np.rint(turned @ self._apart * px).astype(int)
        corner = board.put(narrow, int(room[1]), int(room[0]), float(self._areas[item]))
        if corner is None:
            return None
        row, column = np.array(corner) + narrow.origin
        return column / self._px_per_cu, row / self._px_per_cu


class _Board:
    """Bitmaps of the edge and of items, which ask for more room, and bytes of what either takes.

    That of items is larger, by what a stencil's room may reach beyond the container.
    """

    def __init__(
        self,
        edge: Occupancy,
        levels: int,
        inside: BoolArray,
        compared: int,
        rng: np.random.Generator,
    ) -> None:
        height, width = inside.shape
        self._edge, self._rng, self._pad = edge, rng, max(height, width) // 16
        padded = height + 2 * self._pad, width + 2 * self._pad
        self._items = Occupancy(np.ones(padded, dtype=bool), 0, levels=levels)
        margin = REACH + self._pad
        self._taken = np.pad(~inside, margin, constant_values=True).astype(np.uint8)
        self._words = -(-width // 64)
        self._across = -(-self._words // TILE_WORDS)
        self._tiles = [
            Tile(top, word)
            for top in range(0, height, TILE_PX)
            for word in range(0, self._words, TILE_WORDS)
        ]
        self._left = np.array([float(self._part(inside, *tile).sum()) for tile in self._tiles])
        self._free = np.empty((TILE_PX, TILE_WORDS), dtype=np.uint64)
        self._noise = NOISE * rng.random((TILE_PX, 64 * TILE_WORDS))
        # Smallest item that found no place in each: larger ones are not tried there.
        self._compared = compared
        self._failed = np.full(len(self._tiles), np.inf)
        self._clearance: NearestTaken | None = None

    def loosen(self) -> None:
        """Put all that comes from now on where there is most room."""
        m = REACH + self._pad
        self._clearance = NearestTaken(distance_inside(self._taken[m:-m, m:-m] == 0))
        self._compared = 1

    @staticmethod
    def _part(image: NDArray[Pixel], top: int, word: int) -> NDArray[Pixel]:
        """Part of an image that a tile shows."""
        return image[top : top + TILE_PX, 64 * word : 64 * (word + TILE_WORDS)]

    def put(self, stencil: Stencil, down: int, across: int, area: float) -> tuple[int, int] | None:
        """Take the pixels of an item, with room round it, at its best place; the corner there."""
        down, across = min(down, self._pad), min(across, self._pad)
        wide = stencil_of(_kernels.spread(stencil.mask, down, across), (down, across), REACH)
        boxes = wide.boxes + np.array([self._pad - down, self._pad - across, 0, 0, 0, 0])
        lowest = self._pad - down + len(wide.mask)
        fringe = (wide.fringe - wide.origin)[:: -(-len(wide.fringe) // MOST_FRINGE)]
        steps = fringe[:, 0] * self._taken.shape[1] + fringe[:, 1]
        if self._clearance is None:
            order = np.argsort(-self._left * (1 + LOT * self._rng.random(len(self._left))))
        else:
            clear = self._clearance.distances
            order = np.argsort([-self._part(clear, *tile).max() for tile in self._tiles])
        for tiles in (order[self._failed[order] > area], order):
            found = list[tuple[float, int, int]]()
            for t in tiles.tolist():
                place = self._best_in(self._tiles[t], stencil, boxes, lowest, steps)
                if place is None:
                    self._failed[t] = min(self._failed[t], area)
                    continue
                found.append(place)
                if len(found) == self._compared:
                    break
            if found:
                _, row, column = max(found)
                self._items.take(stencil.mask, row + self._pad, column + self._pad)
                top, left = row + self._pad + REACH, column + self._pad + REACH
                height, width = stencil.mask.shape
                if self._clearance is not None:
                    self._clearance.add(stencil.mask, row, column)
                self._taken[top : top + height, left : left + width] |= stencil.mask
                middle = (row + height // 2) // TILE_PX, (column + width // 2) // (64 * TILE_WORDS)
                self._left[self._across * middle[0] + middle[1]] -= stencil.mask.sum()
                return row, column
        return None

    def _best_in(
        self, tile: Tile, stencil: Stencil, boxes: IntArray, lowest: int, steps: IntArray
    ) -> tuple[float, int, int] | None:
        """Score and corner of the best place in a tile; None if there is none."""
        free = self._free[:, : min(TILE_WORDS, self._words - tile.word)]
        free[...] = _kernels.ALL
        self._items.clear(boxes, lowest, free, *tile)
        if free.any():
            self._edge.clear(stencil.boxes, len(stencil.mask), free, *tile)
        if not free.any():
            return None
        m, width = REACH + self._pad, self._taken.shape[1]
        begin, corner = (tile.top + m) * width + 64 * tile.word + m, np.zeros(2, dtype=np.int64)
        field, pull = self._noise, 0.0
        if self._clearance is not None:
            field, pull, corner = np.zeros_like(self._noise), 1.0, np.array(stencil.origin)
            part = self._part(self._clearance.distances, *tile)
            field[: part.shape[0], : part.shape[1]] = part
        score, row, column = _kernels.best_touching(
            free, self._taken, begin, steps, self._noise, field, pull, corner, pull > 0.0
        )
        return float(score), tile.top + int(row), 64 * tile.word + int(column)
