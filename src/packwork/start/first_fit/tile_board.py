"""Bitmaps of an image in tiles: an item finds its place in a few of them, and takes its pixels."""

from __future__ import annotations

import math
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from packwork.arrays import BoolArray, IntArray
from packwork.fields.distance_transform import distance_inside
from packwork.start.first_fit.kernels import row_bits, touching
from packwork.start.first_fit.occupancy import (
    NOISE,
    NearestTaken,
    Occupancy,
    Stencil,
    stencil_of,
)

TILE_WORDS, TILE_PX = 8, 128
"""Width of a tile, in words of 64 pixels, and its height. Larger takes longer, smaller packs less,
and narrow ones take longer, too. Tried."""

LOT = 0.5
"""How much of the order of tiles, those with most room first, is by lot. Larger looks at more tiles
without a place, smaller lays items of a size side by side. Tried."""

REACH, MOST_FRINGE = 4, 100
"""Width of the fringe in which taken pixels are counted, and how many of them. Tried."""

BLOCK_PX = 64
"""Side of the squares by which is told where no edge is. Divides tiles."""

Pixel = TypeVar("Pixel", bound=np.generic)


class Tile(NamedTuple):
    """Part of the image in which the corner of a stencil's box may lie."""

    top: int
    word: int


class TileBoard:
    """Bitmaps of the edge and of items, which ask for more room, and bytes of what either takes.

    That of items is larger, by what a stencil's room may reach beyond the container.
    """

    def __init__(
        self,
        edge: Occupancy,
        inside: BoolArray,
        compared: int,
        rng: np.random.Generator,
    ) -> None:
        height, width = inside.shape
        self._edge, self._rng, self._pad = edge, rng, max(height, width) // 16
        padded = height + 2 * self._pad, width + 2 * self._pad
        self._items = Occupancy(np.ones(padded, dtype=bool), 0)
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
        self._compared = compared
        # Smallest item that found no place in each: larger ones are tried there last.
        self._failed = np.full(len(self._tiles), np.inf)
        self._bare = _sums_of_full(inside)
        self._clearance: NearestTaken | None = None
        self._roomiest = np.zeros(len(self._tiles))

    def loosen(self) -> None:
        """Put all that comes from now on where there is most room."""
        m = REACH + self._pad
        self._clearance = NearestTaken(distance_inside(self._taken[m:-m, m:-m] == 0))
        self._compared = 1
        self._roomiest = np.array([self._room_in(t) for t in range(len(self._tiles))])

    def _room_in(self, tile: int) -> float:
        """Largest distance of a tile's pixels to what is taken; 0 unless loosened."""
        clear = self._clearance
        return float(self._part(clear.distances, *self._tiles[tile]).max()) if clear else 0.0

    @staticmethod
    def _part(image: NDArray[Pixel], top: int, word: int) -> NDArray[Pixel]:
        """Part of an image that a tile shows."""
        return image[top : top + TILE_PX, 64 * word : 64 * (word + TILE_WORDS)]

    def put(self, stencil: Stencil, down: int, across: int, area: float) -> tuple[int, int] | None:
        """Take the pixels of an item, with room round it, at its best place; the corner there."""
        down, across = min(down, self._pad), min(across, self._pad)
        wide = stencil_of(row_bits.spread(stencil.mask, down, across), (down, across), REACH)
        boxes = wide.boxes + np.array([self._pad - down, self._pad - across, 0, 0, 0, 0])
        lowest = self._pad - down + len(wide.mask)
        fringe = (wide.fringe - wide.origin)[:: -(-len(wide.fringe) // MOST_FRINGE)]
        steps = fringe[:, 0] * self._taken.shape[1] + fringe[:, 1]
        if self._clearance is None:
            order = np.argsort(-self._left * (1 + LOT * self._rng.random(len(self._left))))
        else:
            order = np.argsort(-self._roomiest)
        is_fresh = self._failed[order] > area
        rest = order[~is_fresh]
        for tiles in (order[is_fresh], rest[np.argsort(-self._failed[rest])]):
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
                self.take(stencil.mask, row, column)
                return row, column
        return None

    def take(self, mask: BoolArray, row: int, column: int) -> None:
        """Take the pixels of an item whose box lies there."""
        self._items.take(mask, row + self._pad, column + self._pad)
        top, left = row + self._pad + REACH, column + self._pad + REACH
        height, width = mask.shape
        self._taken[top : top + height, left : left + width] |= mask
        middle = (row + height // 2) // TILE_PX, (column + width // 2) // (64 * TILE_WORDS)
        self._left[self._across * middle[0] + middle[1]] -= mask.sum()
        if self._clearance is not None:
            reach = math.ceil(self._clearance.farthest)
            self._clearance.add(mask, row, column)
            for t, (first, word) in enumerate(self._tiles):
                is_near = row - reach < first + TILE_PX and first < row + height + reach
                before = 64 * word < column + width + reach
                if is_near and before and column - reach < 64 * (word + TILE_WORDS):
                    self._roomiest[t] = self._room_in(t)

    def _is_inside(self, tile: Tile, height: int, width: int) -> bool:
        """Whether no stencil so large whose corner lies in a tile meets the edge."""
        top, left = tile.top // BLOCK_PX, tile.word * 64 // BLOCK_PX
        bottom = -(-(tile.top + TILE_PX + height) // BLOCK_PX)
        right = -(-(64 * (tile.word + TILE_WORDS) + width) // BLOCK_PX)
        sums = self._bare
        if bottom >= sums.shape[0] or right >= sums.shape[1]:
            return False
        full = sums[bottom, right] - sums[top, right] - sums[bottom, left] + sums[top, left]
        return bool(full == (bottom - top) * (right - left))

    def _best_in(
        self, tile: Tile, stencil: Stencil, boxes: IntArray, lowest: int, steps: IntArray
    ) -> tuple[float, int, int] | None:
        """Score and corner of the best place in a tile; None if there is none."""
        free = self._free[:, : min(TILE_WORDS, self._words - tile.word)]
        free[...] = row_bits.ALL
        if not self._items.clear(boxes, lowest, free, *tile):
            return None
        is_inner = self._is_inside(tile, *stencil.mask.shape)
        if not (is_inner or self._edge.clear(stencil.boxes, len(stencil.mask), free, *tile)):
            return None
        m, width = REACH + self._pad, self._taken.shape[1]
        begin, corner = (tile.top + m) * width + 64 * tile.word + m, np.zeros(2, dtype=np.int64)
        field, pull = self._noise, 0.0
        if self._clearance is not None:
            field, pull, corner = np.zeros_like(self._noise), 1.0, np.array(stencil.origin)
            part = self._part(self._clearance.distances, *tile)
            field[: part.shape[0], : part.shape[1]] = part
        score, row, column = touching.best_touching(
            free, self._taken, begin, steps, 0, self._noise, field, pull, corner, pull > 0.0
        )
        return float(score), tile.top + int(row), 64 * tile.word + int(column)


def _sums_of_full(inside: BoolArray) -> IntArray:
    """``(rows + 1, columns + 1)`` how many whole squares above and left of each are inside."""
    rows, columns = (side // BLOCK_PX for side in inside.shape)
    cut = inside[: rows * BLOCK_PX, : columns * BLOCK_PX]
    full = cut.reshape(rows, BLOCK_PX, columns, BLOCK_PX).all(axis=(1, 3))
    return np.pad(full.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
