"""Preferences of items that are put one by one: near their homes, away from their kind."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, eq=False)
class Homes:
    """Points near which items had better lie.

    ``points``: ``(n, 2)``, canvas units.
    ``pull``: ``(n,)`` score that an item gives for lying the canvas' side nearer to its own.
    ``is_first``: ``(n,)`` whether it is put before all that are not, however small it is.
    """

    points: FloatArray
    pull: FloatArray
    is_first: BoolArray

    @classmethod
    def of(cls, points: FloatArray, pull: float) -> Homes:
        """Points that all items are drawn to alike."""
        return cls(points, np.full(len(points), pull), np.zeros(len(points), dtype=bool))


PRICE = 0.5
"""Score, of 1 for a place that touches others all round, that is taken off where an item of the
same kind lies. Larger mixes more and leaves more voids. Tried by eye."""

WIDTH = 0.5
"""How far that reaches: standard deviation over the side of an item's share of the container, were
its kind alone there. Larger keeps them apart over voids, smaller only side by side. Tried."""


class KindPenalty:
    """Penalty of each pixel for each kind: a Gaussian about each of its items.

    ``inside``: ``[row, col]`` the container.
    ``kinds``: ``(n,)`` of the items, from 0.

    Examples
    --------
    >>> penalty = KindPenalty(np.ones((20, 20), dtype=bool), np.array([0, 0, 1]))
    >>> penalty.add(0, 5.0, 5.0)
    >>> float(penalty.at(1)[5, 5]), float(penalty.at(2)[5, 5])
    (0.5, 0.0)
    """

    def __init__(self, inside: BoolArray, kinds: IntArray) -> None:
        counts = np.bincount(kinds)
        self._kinds = kinds
        self._widths = WIDTH * np.sqrt(np.count_nonzero(inside) / np.maximum(counts, 1))
        self._prices = np.zeros((len(counts), *inside.shape))

    def add(self, item: int, row: float, column: float) -> None:
        """Note that an item lies there."""
        kind = self._kinds[item]
        prices = self._prices[kind]
        along, across = (
            np.exp(-(((np.arange(size) - at) / self._widths[kind]) ** 2) / 2)
            for size, at in zip(prices.shape, (row, column), strict=True)
        )
        np.maximum(prices, PRICE * np.outer(along, across), out=prices)

    def at(self, item: int) -> FloatArray:
        """Penalty ``(rows, columns)`` of each pixel for an item whose origin comes to lie there."""
        return np.asarray(self._prices[self._kinds[item]])
