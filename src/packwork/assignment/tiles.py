"""Tiles of a mosaic: one of many pictures for each cell, repeats bounded and kept apart.

A generalised assignment: cells in turn take the cheapest picture that is left, those with most to
show first; then a cell takes another, or two exchange theirs, as long as that is cheaper (local
search by 1-moves and 2-exchanges).
"""

from __future__ import annotations

from typing import final

import numpy as np

from packwork.arrays import FloatArray, IntArray

PASSES = 6
"""Passes over all cells at most. More find next to nothing. Tried."""

LEAST_GAIN = 1e-3
"""Share of the price that a pass has to save for another. Smaller takes longer. Chosen."""

NEAR_PRICE = 4.0
"""Price of a repeat that is too near, in the largest price of a tile: only where nothing else is
left."""


def choose_tiles(
    prices: FloatArray,
    cells: IntArray,
    urgency: FloatArray,
    repeats: int,
    apart: int,
    rng: np.random.Generator,
) -> IntArray:
    """``(n,)`` picture for each cell.

    Parameters
    ----------
    prices
        ``(n, m)`` of each picture in each cell.
    cells
        ``(n, 2)`` row and column of each, at least 0.
    urgency
        ``(n,)`` by which cells choose first.
    repeats
        How often one picture may be taken; ``repeats * m`` is at least ``n``.
    apart
        Rows or columns within which none comes twice, where that can be.

    Examples
    --------
    >>> prices = np.array([[0.0, 1.0, 2.0]] * 3)
    >>> cells = np.array([[0, 0], [0, 1], [0, 2]])
    >>> rng = np.random.default_rng(0)
    >>> sorted(choose_tiles(prices, cells, np.zeros(3), 1, 1, rng).tolist())
    [0, 1, 2]
    >>> choose_tiles(prices, cells, np.zeros(3), 3, 1, rng).tolist()
    [0, 1, 0]
    """
    board = _Board(prices, cells, repeats, apart)
    for cell in np.argsort(-urgency, kind="stable").tolist():
        board.put(cell, int(board.row(cell).argmin()))
    before = board.total
    for _ in range(PASSES):
        for cell in rng.permutation(len(cells)).tolist():
            board.improve(cell)
        if before - board.total <= LEAST_GAIN * abs(before):
            break
        before = board.total
    return board.chosen


@final
class _Board:
    """Pictures in cells, and what each may become."""

    def __init__(self, prices: FloatArray, cells: IntArray, repeats: int, apart: int) -> None:
        self._prices, self._repeats, self._apart = prices, repeats, apart
        self._cells = cells.tolist()
        self._near_price = NEAR_PRICE * float(prices.max())
        self._used = np.zeros(prices.shape[1], dtype=np.int64)
        self._grid = np.full(cells.max(axis=0) + 1 + 2 * apart, -1, dtype=np.int64)
        self.chosen = np.full(len(cells), -1, dtype=np.int64)
        self._paid = np.zeros(len(cells), dtype=prices.dtype)

    @property
    def total(self) -> float:
        """Price of all, repeats that are too near left out."""
        return float(self._paid.sum())

    def row(self, cell: int) -> FloatArray:
        """Prices of all pictures in a cell; infinite of those that are used up."""
        row = np.where(self._used < self._repeats, self._prices[cell], np.inf)
        row[self._near(cell)] += self._near_price
        return row

    def put(self, cell: int, picture: int) -> None:
        """Put a picture into a cell in place of what is there."""
        if (before := int(self.chosen[cell])) >= 0:
            self._used[before] -= 1
        self._used[picture] += 1
        self._set(cell, picture)

    def improve(self, cell: int) -> None:
        """Give a cell a cheaper picture, of those left or of another cell, if there is one."""
        own, near = int(self.chosen[cell]), self._near(cell)
        here = float(self._paid[cell]) + self._near_price * (own in near)
        row = self.row(cell)
        other = int(row.argmin())
        saved = here - float(row[other])
        change = self._prices[cell, self.chosen] + self._prices[:, own] - self._paid
        partner = int(change.argmin())
        swapped = self._paid[cell] - change[partner]
        theirs = int(self.chosen[partner])
        allowed = theirs not in near and own not in self._near(partner)
        if allowed and swapped > max(saved, 0.0) + _ROUNDING:
            self._set(cell, theirs)
            self._set(partner, own)
        elif saved > _ROUNDING:
            self.put(cell, other)

    def _set(self, cell: int, picture: int) -> None:
        row, column = self._cells[cell]
        self._grid[row + self._apart, column + self._apart] = picture
        self.chosen[cell], self._paid[cell] = picture, self._prices[cell, picture]

    def _near(self, cell: int) -> IntArray:
        """Pictures in the cells about one."""
        row, column = self._cells[cell]
        width = 2 * self._apart + 1
        about = self._grid[row : row + width, column : column + width].ravel()
        others = np.delete(about, len(about) // 2)
        return others[others >= 0]


_ROUNDING = 1e-9
