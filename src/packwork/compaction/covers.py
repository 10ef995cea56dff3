"""Covers of many outlines: what recurs in them, as letters do in words, is simplified once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.compaction.outer_simplify import outer_simplified
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline

ALIKE = 1e-6
"""Difference of coordinates, in tolerances, up to which two rings are one shape. Smaller takes for
two what rounding has moved; larger would be seen in the gaps. Chosen."""

STEPS = 2
"""Tolerances of parts for each factor of 2, rounded down to them. More keep nearer to what was
asked and find less that recurs. Chosen."""

_Shape: TypeAlias = tuple[bytes, bytes]
"""Starts and points of an outline of extent 1, in parts of the tolerance."""

_Key: TypeAlias = tuple[int | bytes, ...]
"""Number of a tolerance, and the rings of a part about its first vertex."""


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
        self._scaled: dict[_Shape, tuple[float, Outline]] = {}

    def cover_of_shape(self, outline: Outline, tolerance: float) -> Outline:
        """Cover of an outline, ``tolerance`` in its extents; what differs in size is made once.

        Always called with one tolerance.

        Examples
        --------
        >>> tile = np.array([[0.0, 0], [4, 0], [4, 4], [2, 4.01], [0, 4]])
        >>> one, two = (Outline.from_rings([size * tile]) for size in (1, 3))
        >>> covers = Covers()
        >>> small, large = covers.cover_of_shape(one, 0.02), covers.cover_of_shape(two, 0.02)
        >>> bool(np.allclose(3 * small.points, large.points)), large.region.covers(two.region)
        (True, True)
        """
        extent = outline.extent
        if tolerance <= 0:
            return self.cover(outline, tolerance)
        shape = np.rint(outline.points / (ALIKE * tolerance * extent)).astype(np.int64)
        key = outline.starts.tobytes(), shape.tobytes()
        if key not in self._scaled:
            self._scaled[key] = extent, self.cover(outline, tolerance * extent)
        first, cover = self._scaled[key]
        # There and back would move vertices by a rounding.
        return cover if extent == first else cover.mapped(similarity(0.0, 0.0, 0.0, extent / first))

    def cover(self, outline: Outline, tolerance: float) -> Outline:
        """Outline with fewer vertices that holds all of ``outline``; as ``outer_simplified``."""
        if len(outline.rings) > 1 and tolerance > 0:
            parts = [self._part(rings, tolerance) for rings in outline.parts]
            if _are_apart(parts):
                return Outline.from_rings([ring for part in parts for ring in part])
        return Outline.from_region(outer_simplified(outline.region, tolerance))

    def _part(self, rings: Sequence[FloatArray], tolerance: float) -> list[FloatArray]:
        """Rings of the cover of one part: its own ring, then those of its holes."""
        level = math.floor(STEPS * math.log2(tolerance))
        tolerance = 2.0 ** (level / STEPS)
        first = rings[0][0]
        about = [ring - first for ring in rings]
        alike = (np.rint(ring / (ALIKE * tolerance)).astype(np.int64).tobytes() for ring in about)
        key = level, *alike
        if key not in self.known:
            cover = outer_simplified(shapely.Polygon(about[0], about[1:]), tolerance)
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
