"""Forces between the items of a group: alignment, balance, keeping together, keeping near home."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.forces.field import Group


def _about(points: FloatArray, areas: FloatArray, side: float) -> tuple[FloatArray, FloatArray]:
    """Area times squared distance from the centre of mass over twice the side."""
    off = points - np.average(points, axis=0, weights=areas)
    # The centre moves too, but its part of the slope sums up to nothing.
    return areas * (off**2).sum(axis=1) / (2 * side), areas[:, None] * off / side


@dataclass(frozen=True)
class Alignment:
    """Centroids to one line: spread across it costs.

    Parameters
    ----------
    axis
        0 for a column (one x for all), 1 for a row (one y).

    Examples
    --------
    >>> two = Group(np.array([[0.0, 0], [4, 2]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> parts, slopes = Alignment(1)(two)
    >>> parts.tolist(), slopes.tolist()
    ([0.05, 0.05], [[0.0, -0.1], [0.0, 0.1]])
    """

    axis: int

    def __call__(self, group: Group) -> tuple[FloatArray, FloatArray]:
        """Spread across the line."""
        across = group.points * (np.arange(2) == self.axis)
        return _about(across, group.areas, group.side)


@dataclass(frozen=True)
class Together:
    """Copies of one thing to each other: their spread costs.

    Parameters
    ----------
    is_one
        Whether all of the group are to lie together, and not each kind by itself.

    Examples
    --------
    >>> two = Group(np.array([[0.0, 0], [4, 0]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> Together()(two)[1].tolist()
    [[-0.2, 0.0], [0.2, 0.0]]
    """

    is_one: bool = False

    def __call__(self, group: Group) -> tuple[FloatArray, FloatArray]:
        """Spread of each kind about its own centre of mass."""
        kinds: IntArray = np.zeros_like(group.kinds) if self.is_one else group.kinds
        parts, slopes = np.zeros(len(kinds)), np.zeros((len(kinds), 2))
        for kind in np.unique(kinds):
            own = kinds == kind
            parts[own], slopes[own] = _about(group.points[own], group.areas[own], group.side)
        return parts, slopes


@dataclass(frozen=True, eq=False)
class Home:
    """Each item of the group to a place of its own: distance from it costs.

    Parameters
    ----------
    places
        ``(n, 2)`` one for each of the group; NaN for an item that has none.

    Examples
    --------
    >>> two = Group(np.array([[0.0, 0], [4, 2]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> Home(np.array([[1.0, 0], [np.nan, np.nan]]))(two)[1].tolist()
    [[-0.1, 0.0], [0.0, 0.0]]
    """

    places: FloatArray

    def __call__(self, group: Group) -> tuple[FloatArray, FloatArray]:
        """Area times squared distance from home over twice the side."""
        off = np.nan_to_num(group.points - self.places)
        parts = group.areas * (off**2).sum(axis=1) / (2 * group.side)
        return parts, group.areas[:, None] * off / group.side


@dataclass(frozen=True, eq=False)
class Balance:
    """Centre of mass of the group to a point or an axis.

    Parameters
    ----------
    point
        ``(2,)`` canvas units; NaN where that coordinate does not matter.

    Examples
    --------
    >>> two = Group(np.array([[0.0, 0], [4, 2]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> Balance(np.array([1.0, np.nan]))(two)[1].tolist()
    [[0.1, 0.0], [0.1, 0.0]]
    """

    point: FloatArray

    def __call__(self, group: Group) -> tuple[FloatArray, FloatArray]:
        """Whole area times squared distance of the centre of mass over twice the side."""
        off = np.nan_to_num(np.average(group.points, axis=0, weights=group.areas) - self.point)
        # A moment is shared by all that make it, by their areas.
        parts = group.areas * (off @ off) / (2 * group.side)
        return parts, group.areas[:, None] * off / group.side
