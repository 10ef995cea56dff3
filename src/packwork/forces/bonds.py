"""Forces between the items of a group: alignment, balance, togetherness, homes, similarity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.forces import _kernels
from packwork.forces.field import ItemGroup

NARROW = 0.1
"""Share of the canvas' side by which an item has to lie off the line of an alignment to be drawn
to it as strongly as by a direction. Smaller aligns better and covers less. Tried."""


def _about(points: FloatArray, areas: FloatArray, side: float) -> tuple[FloatArray, FloatArray]:
    """Area times squared distance from the centre of mass over twice the side."""
    off = points - np.average(points, axis=0, weights=areas)
    # The centre moves too, but its part of the slope sums up to nothing.
    return areas * (off**2).sum(axis=1) / (2 * side), areas[:, None] * off / side


def _about_elsewhere(
    points: FloatArray, areas: FloatArray, side: float, places: FloatArray
) -> FloatArray:
    """Change of the sum of :func:`_about` if one item lay elsewhere, ``(n, m)``."""
    centre = np.average(points, axis=0, weights=areas)
    before, after = ((at - centre) for at in (points, places))
    change = (after**2).sum(axis=1) - (before**2).sum(axis=1)[:, None]
    # The centre follows, by the item's share of all area.
    follows = areas[:, None] / areas.sum() * _squares(points, places)
    return np.asarray(areas[:, None] * (change - follows) / (2 * side))


def _alone(off: FloatArray, side: float) -> FloatArray:
    """Squared distance over twice the side."""
    return np.asarray((off**2).sum(axis=1) / (2 * side))


def _squares(points: FloatArray, places: FloatArray) -> FloatArray:
    """``(n, m)`` squared distances."""
    return np.asarray(((places - points[:, None]) ** 2).sum(axis=2))


@dataclass(frozen=True)
class Alignment:
    """Centroids to one line: spread across it costs.

    ``axis``: 0 for a column (one x for all), 1 for a row (one y).

    Examples
    --------
    >>> two = ItemGroup(np.array([[0.0, 0], [4, 2]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> parts, slopes = Alignment(1)(two)
    >>> parts.tolist(), slopes.tolist()
    ([0.5, 0.5], [[0.0, -1.0], [0.0, 1.0]])
    """

    axis: int

    def __call__(self, group: ItemGroup) -> tuple[FloatArray, FloatArray]:
        """Spread across the line."""
        across = group.points * (np.arange(2) == self.axis)
        return _about(across, group.areas, NARROW * group.side)

    def changes(self, group: ItemGroup, places: FloatArray) -> FloatArray:
        """Changes ``(n, m)``, area times canvas units, by items at each of places ``(m, 2)``."""
        across, there = (at * (np.arange(2) == self.axis) for at in (group.points, places))
        return _about_elsewhere(across, group.areas, NARROW * group.side, there)

    def alone(self, points: FloatArray, anchor: FloatArray, side: float) -> FloatArray:
        """``(m,)`` heights, canvas units, of points ``(m, 2)``: by distance from the line."""
        return _alone((points - anchor) * (np.arange(2) == self.axis), NARROW * side)


@dataclass(frozen=True)
class TogetherBond:
    """Copies of one thing to each other: their spread costs.

    ``is_one``: whether all of the group are to lie together, and not each kind by itself.

    Examples
    --------
    >>> two = ItemGroup(np.array([[0.0, 0], [4, 0]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> TogetherBond()(two)[1].tolist()
    [[-0.2, 0.0], [0.2, 0.0]]
    """

    is_one: bool = False

    def __call__(self, group: ItemGroup) -> tuple[FloatArray, FloatArray]:
        """Spread of each kind about its own centre of mass."""
        kinds: IntArray = np.zeros_like(group.kinds) if self.is_one else group.kinds
        parts, slopes = np.zeros(len(kinds)), np.zeros((len(kinds), 2))
        for kind in np.unique(kinds):
            own = kinds == kind
            parts[own], slopes[own] = _about(group.points[own], group.areas[own], group.side)
        return parts, slopes

    def changes(self, group: ItemGroup, places: FloatArray) -> FloatArray:
        """Changes ``(n, m)``, area times canvas units, by items at each of places ``(m, 2)``."""
        kinds: IntArray = np.zeros_like(group.kinds) if self.is_one else group.kinds
        found = np.zeros((len(kinds), len(places)))
        for kind in np.unique(kinds):
            own = kinds == kind
            found[own] = _about_elsewhere(group.points[own], group.areas[own], group.side, places)
        return found

    def alone(self, points: FloatArray, anchor: FloatArray, side: float) -> FloatArray:
        """``(m,)`` heights, canvas units, of points ``(m, 2)``: by distance from the others."""
        return _alone(points - anchor, side)


@dataclass(frozen=True, eq=False)
class Home:
    """Each item of the group to a place of its own: distance from it costs.

    ``places``: ``(n, 2)`` one for each of the group; NaN for an item that has none.

    Examples
    --------
    >>> two = ItemGroup(np.array([[0.0, 0], [4, 2]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> Home(np.array([[1.0, 0], [np.nan, np.nan]]))(two)[1].tolist()
    [[-0.1, 0.0], [0.0, 0.0]]
    """

    places: FloatArray

    def __call__(self, group: ItemGroup) -> tuple[FloatArray, FloatArray]:
        """Area times squared distance from home over twice the side."""
        off = np.nan_to_num(group.points - self.places)
        parts = group.areas * (off**2).sum(axis=1) / (2 * group.side)
        return parts, group.areas[:, None] * off / group.side

    def changes(self, group: ItemGroup, places: FloatArray) -> FloatArray:
        """Changes ``(n, m)``, area times canvas units, by items at each of places ``(m, 2)``."""
        before = (np.nan_to_num(group.points - self.places) ** 2).sum(axis=1)
        after = np.nan_to_num(_squares(self.places, places))
        return np.asarray(group.areas[:, None] * (after - before[:, None]) / (2 * group.side))

    def alone(self, points: FloatArray, anchor: FloatArray, side: float) -> FloatArray:
        """``(m,)`` zeros at points ``(m, 2)``, canvas units: each item has a place of its own."""
        return np.zeros(len(points))


@dataclass(frozen=True, eq=False)
class Balance:
    """Centre of mass of the group to a point or an axis.

    ``point``: ``(2,)`` canvas units; NaN where that coordinate does not matter.

    Examples
    --------
    >>> two = ItemGroup(np.array([[0.0, 0], [4, 2]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> Balance(np.array([1.0, np.nan]))(two)[1].tolist()
    [[0.1, 0.0], [0.1, 0.0]]
    """

    point: FloatArray

    def __call__(self, group: ItemGroup) -> tuple[FloatArray, FloatArray]:
        """Whole area times squared distance of the centre of mass over twice the side."""
        off = np.nan_to_num(np.average(group.points, axis=0, weights=group.areas) - self.point)
        # A moment is shared by all that make it, by their areas.
        parts = group.areas * (off @ off) / (2 * group.side)
        return parts, group.areas[:, None] * off / group.side

    def changes(self, group: ItemGroup, places: FloatArray) -> FloatArray:
        """Changes ``(n, m)``, area times canvas units, by items at each of places ``(m, 2)``."""
        whole = group.areas.sum()
        off = np.nan_to_num(np.average(group.points, axis=0, weights=group.areas) - self.point)
        counts = np.logical_not(np.isnan(self.point))
        shift = (group.areas / whole)[:, None, None] * (places - group.points[:, None]) * counts
        after = ((off + shift) ** 2).sum(axis=2)
        return np.asarray(whole * (after - off @ off) / (2 * group.side))

    def alone(self, points: FloatArray, anchor: FloatArray, side: float) -> FloatArray:
        """``(m,)`` heights, canvas units, of points ``(m, 2)``: by distance from point or axis."""
        return _alone(np.nan_to_num(points - self.point), side)


SIMILARITY_REACH = 1.1
"""Reach of a tie, over the side of a square of an item's mean area: next neighbours feel it most.
Larger draws whole clusters together and apart, and covers less. Tried."""


@dataclass(frozen=True, eq=False)
class SimilarityBond:
    """Each two items drawn together or apart, as a Gaussian of their distance.

    All count alike, whatever their sizes.

    ``ties``: ``(n, n)`` symmetric, zeros on the diagonal: positive for those that are to be
    neighbours, negative for those that are not.

    Examples
    --------
    >>> two = ItemGroup(np.array([[0.0, 0], [1, 0]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> [SimilarityBond(np.array([[0.0, s], [s, 0]]))(two)[1].round(3).tolist() for s in (1, -1)]
    [[[-0.066, 0.0], [0.066, 0.0]], [[0.066, 0.0], [-0.066, 0.0]]]
    """

    ties: FloatArray

    def __call__(self, group: ItemGroup) -> tuple[FloatArray, FloatArray]:
        """Less where like items lie near, more where unlike ones do."""
        points = np.ascontiguousarray(group.points)
        parts, slopes = np.zeros(len(points)), np.zeros((len(points), 2))
        order = np.argsort(points[:, 0], kind="stable")
        _kernels.add_ties(points, order, self.ties, _reach(group), parts, slopes)
        unit = float(group.areas.mean()) / group.side
        return unit * parts, unit * slopes

    def changes(self, group: ItemGroup, places: FloatArray) -> FloatArray:
        """Changes ``(n, m)``, area times canvas units, by items at each of places ``(m, 2)``."""
        reach = _reach(group)
        here, there = (self.ties @ _felt(group.points, at, reach) for at in (group.points, places))
        unit = float(group.areas.mean()) / group.side * reach**2
        return np.asarray(unit * (np.diagonal(here)[:, None] - there))

    def alone(self, points: FloatArray, anchor: FloatArray, side: float) -> FloatArray:
        """``(m,)`` zeros at points ``(m, 2)``: all others are as many like as unlike ones."""
        return np.zeros(len(points))


def _reach(group: ItemGroup) -> float:
    return SIMILARITY_REACH * float(np.sqrt(group.areas.mean()))


def _felt(points: FloatArray, places: FloatArray, reach: float) -> FloatArray:
    """``(n, m)`` how much of each point is felt at each of some places."""
    squares = ((places - points[:, None]) ** 2).sum(axis=2)
    return np.asarray(np.exp(-0.5 * squares / reach**2))
