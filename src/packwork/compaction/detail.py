"""Arrangements of outlines simplified to a tolerance, as fine as a stage needs them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.covers import Covers
from packwork.compaction.outer_simplify import inner_simplified
from packwork.geometry.outline import Outline
from packwork.scene.pose import Poses

COARSE, FINE = 4e-3, 3e-4
"""Tolerance of the outlines that rounds work on, shares of an item's extent: first and
last. Larger is faster and wastes room (the fine one 0.1 % of the coverage). Tried."""

FINE_OF_GAP, COARSE_OF_GAP, ROUGHEST = 0.003, 0.015, 0.1
"""Tolerances of outlines as shares of the gap, where items are so small beside it that this is
more than they have anyway: every edge of theirs is then near every other. And the largest share
of an item's extent. Larger wastes room, smaller takes minutes where the padding is as wide as the
items. Tried."""


class Detail:
    """Covers of the outlines at one tolerance, finer ones inside coarser ones.

    Parameters
    ----------
    outlines
        One per item, item units; copies are simplified once.
    container
        In canvas units.
    poses
        First poses: their scales, angles and stretches are taken in.
    """

    def __init__(self, outlines: Sequence[Outline], container: Outline, poses: Poses) -> None:
        self._outlines, self._container, self._poses = outlines, container, poses

    def tolerance(self, least: float, distance_cu: float) -> float:
        """A distance in shares of the usual item's extent; no less than ``least``.

        Examples
        --------
        >>> one = np.ones(1)
        >>> tile = Outline.from_rings([np.array([[0.0, 0], [9, 0], [9, 9], [0, 9]])])
        >>> detail = Detail([tile], tile, Poses(one, one, one, 2 * one))
        >>> detail.tolerance(1e-3, 0.9), detail.tolerance(1e-3, 1e-3)
        (0.05, 0.001)
        """
        extents = [outline.extent for outline in self._outlines] * self._poses.scale
        return float(np.clip(distance_cu / np.median(extents), least, max(least, ROUGHEST)))

    def covers(self, tolerance: float, stop: Callable[[], bool] = bool) -> Detail:
        """The same with fewer vertices: ``tolerance`` in shares of each item's extent.

        Itself once ``stop``, asked before each, says so: hundreds of words take seconds.
        """
        known: dict[Outline, Outline] = {}
        covers = Covers()
        for outline in self._outlines:
            if outline not in known:
                if stop():
                    return self
                known[outline] = covers.cover_of_shape(outline, tolerance)
        outlines = [known[outline] for outline in self._outlines]
        sizes = [outline.extent for outline in self._outlines] * self._poses.scale
        slack = tolerance * float(np.median(sizes))
        container = Outline.from_region(inner_simplified(self._container.region, slack))
        return Detail(outlines, container, self._poses)

    def subset(self, items: IntArray, poses: Poses) -> Detail:
        """The same of items ``(m,)``, by their indices: of the same sizes, in other poses."""
        return Detail([self._outlines[int(k)] for k in items], self._container, poses.subset(items))

    def arrangement(self, places: FloatArray) -> Arrangement:
        """Outlines in place: ``(n, 4)`` x, y, turn and growth against the first poses."""
        own = []
        for k, outline in enumerate(self._outlines):
            matrix = self._poses.matrix(k).copy()
            matrix[:, 2] = 0.0
            own.append(outline.mapped(matrix))
        return Arrangement(own, self._container, places)
