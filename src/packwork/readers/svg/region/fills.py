"""Filled regions of closed rings by fill rule, without set operations where rings do not touch.

Then nothing has to be cut: how often the others go round a ring tells whether it is an
edge of the region, which makes a compound path some thirty times cheaper.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from shapely.geometry import LinearRing, MultiLineString, Polygon

from packwork.arrays import BoolArray, FloatArray
from packwork.geometry.polygon import FillRule, Region, enclosed, region, signed_area
from packwork.readers.budget.crossings import Allowance
from packwork.readers.budget.nesting import check_nesting

_MANY = 2_000


def filled(rings: Sequence[FloatArray], rule: FillRule, allowance: Allowance) -> Region:
    """Region that closed rings fill under ``rule``; valid, possibly empty.

    Parameters
    ----------
    rings
        Each ``(n, 2)``.
    rule
        SVG's word.
    allowance
        For crossings.

    Raises
    ------
    TooRichError
        If they cross each other too often to be resolved, or too many lie in each other.

    Examples
    --------
    >>> square = np.array([[0, 0], [4, 0], [4, 4], [0, 4.0]])
    >>> filled([square, square / 4 + 1], "evenodd", Allowance(9)).area
    15.0
    >>> filled([square, square / 4 + 1], "nonzero", Allowance(9)).area
    16.0
    """
    kept = [LinearRing(ring) for ring in rings if len(ring) >= 3]
    is_large = sum(len(ring) for ring in rings) > _MANY
    if is_large:
        # Before crossings are looked for one by one, which may take as long.
        allowance.spend(rings)
        check_nesting(kept)
    together = MultiLineString(kept)
    if not kept or not together.is_simple:
        if not is_large:
            allowance.spend(rings)
        return region(rings, rule)
    if len(kept) == 1:
        return Polygon(kept[0])
    if rule == "nonzero":
        kept = [ring for ring, is_edge in zip(kept, _are_edges(kept), strict=True) if is_edge]
    return enclosed(kept)


def _are_edges(rings: Sequence[LinearRing]) -> BoolArray:
    """Which of several rings part what is wound about from what is not.

    They neither cross nor touch, so the winding number is the same all along a ring.
    """
    faces = shapely.polygons(rings)
    signs = np.array([np.sign(signed_area(shapely.get_coordinates(ring))) for ring in rings])
    corners = shapely.points([ring.coords[0] for ring in rings])
    inner, outer = shapely.STRtree(faces).query(corners, predicate="within")
    is_other = inner != outer
    around = np.bincount(inner[is_other], signs[outer[is_other]], minlength=len(rings))
    return np.asarray((around != 0) != (around + signs != 0))
