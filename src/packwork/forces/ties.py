"""A bond between neighbours: like ones closer, unlike ones farther, none beyond its reach."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray
from packwork.forces import _kernels
from packwork.forces.field import ItemGroup

REACH = 1.1
"""Reach of a tie, over the side of a square of an item's mean area: next neighbours feel it most.
Larger draws whole clusters together and apart, and covers less. Tried."""


@dataclass(frozen=True, eq=False)
class Ties:
    """Each two items drawn together or apart, as a Gaussian of their distance.

    All count alike, whatever their sizes.

    Parameters
    ----------
    ties
        ``(n, n)`` symmetric, zeros on the diagonal: positive for those that are to be neighbours,
        negative for those that are not.

    Examples
    --------
    >>> two = ItemGroup(np.array([[0.0, 0], [1, 0]]), np.ones(2), np.zeros(2, int), 10.0)
    >>> [Ties(np.array([[0.0, s], [s, 0]]))(two)[1].round(3).tolist() for s in (1, -1)]
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
    return REACH * float(np.sqrt(group.areas.mean()))


def _felt(points: FloatArray, places: FloatArray, reach: float) -> FloatArray:
    """``(n, m)`` how much of each point is felt at each of some places."""
    squares = ((places - points[:, None]) ** 2).sum(axis=2)
    return np.asarray(np.exp(-0.5 * squares / reach**2))
