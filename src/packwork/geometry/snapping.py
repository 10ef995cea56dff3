"""Regions whose rings keep a distance from themselves that rounding cannot take away.

Snap rounding (J. Hobby, "Practical segment intersection with finite precision output",
Computational Geometry 13 (1999), 199-214), repeated until it changes nothing (D. Halperin and E.
Packer, "Iterated snap rounding", Computational Geometry 23 (2002), 209-225), of those regions alone
whose minimum clearance asks for it: the smallest distance by which a vertex may move before rings
meet. An outline that all but touches itself would cross itself once it is turned or written.
"""

from __future__ import annotations

import shapely

from packwork.geometry.bezier import FLATTENING
from packwork.geometry.distance import is_clear
from packwork.geometry.overlay import Region, buffered, polygon_parts, quiet, union, valid

STEP = 1e-7
"""Clearance that regions keep at least, and the grid's step, as shares of their extent: a two
hundredth of what readers follow curves to. Larger moves vertices farther; smaller drowns in the
digits of files. Chosen."""

CLEFT = FLATTENING
"""Width of a bay's mouth, as a share of the extent, below which it counts as closed: what readers
follow curves to. Larger fills bays that can be seen, smaller leaves mouths that a file's last
digits close. Derived."""

MOST_ROUNDS = 8
"""Times that a region is snapped at most; two have been enough for all that was tried. Chosen."""


def snap_rounded(shape: Region, step: float = STEP) -> Region:
    """The region itself if its rings keep clear of each other, else one whose rings do.

    Each vertex is within a few steps, shares of the extent, of where it was; empty if nothing is as
    wide as a step. A region that is not valid is repaired.

    >>> nearly = shapely.Polygon([(0, 0), (4, 0), (4, 4), (2, 1e-12), (0, 4)])
    >>> snap_rounded(nearly).geom_type, snap_rounded(nearly).area
    ('MultiPolygon', 8.0)
    >>> box = shapely.box(0, 0, 1, 1)
    >>> snap_rounded(box) is box
    True
    """
    shape = valid(shape)
    left, top, right, bottom = shape.bounds if shape.area > 0 else (0.0, 0.0, 0.0, 0.0)
    least = step * max(right - left, bottom - top)
    for _ in range(MOST_ROUNDS):
        if not least > 0 or is_clear(shape, least / 2):
            break
        # A region that says it lies on the grid is not looked at again.
        with quiet():
            loose = shapely.set_precision(shape, 0.0, mode="pointwise")
            snapped = shapely.set_precision(loose, least)
        shape = union(polygon_parts(snapped))
    return shape


def without_clefts(shape: Region, width: float = CLEFT) -> Region:
    """A region without holes, bays filled whose mouths are narrower than ``width`` of its extent.

    Of a valid region without such bays it is the region itself.

    >>> ring = shapely.box(0, 0, 4, 4) - shapely.box(1, 1, 3, 3)
    >>> slit = ring - shapely.box(1.9, 0, 1.900001, 2)
    >>> round(without_clefts(slit).area, 3)
    16.0
    """
    left, top, right, bottom = shape.bounds
    least = width * max(right - left, bottom - top)
    if is_clear(shape, least):
        return shape
    grown = buffered(shape, least / 2, join_style="mitre")
    bays = [shapely.Polygon(hole) for part in polygon_parts(grown) for hole in part.interiors]
    if not bays:
        return shape
    return snap_rounded(union([shape, *(buffered(bay, least, join_style="mitre") for bay in bays)]))
