"""Covers of many outlines: what recurs in them, as letters do in words, is simplified once."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.compaction.outer_simplify import outer_simplified
from packwork.geometry.outline import Outline

ALIKE = 1e-6
"""Difference of coordinates, in tolerances, up to which two rings are one shape. Smaller takes for
two what rounding has moved; larger would be seen in the gaps. Chosen."""

STEPS = 2
"""Tolerances of parts for each factor of 2, rounded down to them. More keep nearer to what was
asked and find less that recurs. Chosen."""

_Key: TypeAlias = tuple[int, bytes]
"""Number of a tolerance, and a ring about its first vertex."""


class Covers:
    """Outer simplifications that remember parts.

    Examples
    --------
    >>> tile = np.array([[0.0, 0], [4, 0], [4, 4], [2, 4.01], [0, 4]])
    >>> covers = Covers()
    >>> two = covers.cover(Outline.from_rings([tile, tile + (9, 0)]), 0.1)
    >>> len(covers.known), len(two.rings), bool(two.region.covers(shapely.Polygon(tile)))
    (1, 2, True)
    """

    def __init__(self) -> None:
        self.known: dict[_Key, list[FloatArray]] = {}
        """Rings of the covers of parts, about the part's first vertex."""

    def cover(self, outline: Outline, tolerance: float) -> Outline:
        """Outline with fewer vertices that holds all of ``outline``; as ``outer_simplified``."""
        if len(outline.rings) > 1 and not outline.has_holes and tolerance > 0:
            parts = [self._part(ring, tolerance) for ring in outline.rings]
            if _are_apart(parts):
                return Outline.from_rings([ring for part in parts for ring in part])
        return Outline.from_region(outer_simplified(outline.region, tolerance))

    def _part(self, ring: FloatArray, tolerance: float) -> list[FloatArray]:
        """Rings of the cover of one part."""
        level = math.floor(STEPS * math.log2(tolerance))
        tolerance = 2.0 ** (level / STEPS)
        first = ring[0]
        about = ring - first
        key = level, np.rint(about / (ALIKE * tolerance)).astype(np.int64).tobytes()
        if key not in self.known:
            cover = outer_simplified(shapely.Polygon(about), tolerance)
            self.known[key] = Outline.from_region(cover).rings
        return [one + first for one in self.known[key]]


def _are_apart(parts: list[list[FloatArray]]) -> bool:
    """Whether parts do not meet."""
    low = np.array([part[0].min(axis=0) for part in parts])
    high = np.array([part[0].max(axis=0) for part in parts])
    meets = ((low[:, None] <= high) & (low <= high[:, None])).all(axis=2)
    if np.count_nonzero(meets) == len(parts):
        return True
    solids = [shapely.Polygon(part[0], part[1:]) for part in parts]
    return bool(shapely.MultiPolygon(solids).is_valid)
