"""Narrow places of parts that a round tool, as a router's bit, cannot enter: told, not mended.

What is outside of a part and stays uncut is its closing (dilation, then erosion by the tool's
radius) less the part.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass

import shapely

from packwork.geometry.overlay import buffered, difference, polygon_parts
from packwork.geometry.polygon import Region
from packwork.phrasing import MOST_NAMED, enumerated, number_of
from packwork.uses.nested import SheetPart

_LOG = logging.getLogger("packwork")

FITTING = 0.999
"""Share of its radius with which the tool is tried: a hole as wide as the tool is cut. Chosen."""

THINNEST = 0.01
"""Half the width, over the tool's radius, below which what stays uncut is nothing. Larger overlooks
blunt corners, smaller tells of flattened curves. Chosen."""

QUADRANT = 32
"""Pieces of each quarter of the tool's edge."""


@dataclass(frozen=True)
class Unreached:
    """Narrow places, each by a point (x, y) in it, and corners that stay round, of a part."""

    narrow: tuple[tuple[float, float], ...]
    corners: int


def unreached(region: Region, diameter: float) -> Unreached:
    """Places around a region, and in its holes, that a tool of a diameter cannot enter.

    Examples
    --------
    >>> square = shapely.box(0, 0, 40, 40)
    >>> slotted = square - shapely.box(18, 10, 22, 40) - shapely.box(5, 5, 8, 8)
    >>> unreached(slotted, 6.0)
    Unreached(narrow=((6.5, 6.5), (20.0, 24.62)), corners=0)
    >>> unreached(square - shapely.box(10, 10, 30, 30), 6.0)
    Unreached(narrow=(), corners=4)
    """
    radius = FITTING * diameter / 2.0
    closed = buffered(region, radius, quad_segs=QUADRANT)
    closed = buffered(closed, -radius, quad_segs=QUADRANT)
    narrow, corners = list[tuple[float, float]](), 0
    for piece in polygon_parts(buffered(difference(closed, region), -THINNEST * radius)):
        mouth = difference(buffered(piece, 2.0 * THINNEST * radius), closed)
        is_hole = mouth.area < THINNEST**2 * radius**2
        if is_hole or piece.area > radius**2:
            at = piece.representative_point()
            narrow.append((round(at.x, 2), round(at.y, 2)))
        else:
            corners += 1
    return Unreached(tuple(sorted(narrow)), corners)


def tell_unreached(parts: Sequence[SheetPart], diameter: float, unit: str) -> None:
    """Name each part with places that the tool cannot enter, in a line of the log."""
    told = dict.fromkeys((one.item, one.scale) for one in parts)
    for item, scale in told:
        region = shapely.transform(item.ink.region, lambda points, by=scale: points * by)
        left, _, _, bottom = region.bounds
        # From the lower left corner, y up, as programs for machines show it.
        moved = shapely.transform(region, lambda at: (at - (left, bottom)) * (1.0, -1.0))  # noqa: B023
        found = unreached(moved, diameter)
        said = []
        if found.narrow:
            places = enumerated([f"({x:g}, {y:g})" for x, y in found.narrow], MOST_NAMED)
            many = number_of(len(found.narrow), "narrow place")
            said.append(f"does not enter {many}, at {places} {unit} from the lower left corner")
        if found.corners:
            said.append(f"leaves {number_of(found.corners, 'inner corner')} round")
        if said:
            _LOG.warning("%s: a tool of %g %s %s", item.name, diameter, unit, "; it ".join(said))
