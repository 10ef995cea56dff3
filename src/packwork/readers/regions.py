"""Painted regions to outline and ink, on the page or trimmed, the last step of every reader."""

from __future__ import annotations

from typing import Literal, TypeAlias

from shapely.geometry import MultiPolygon, Polygon

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.distance import snap_rounded, without_clefts
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference
from packwork.geometry.polygon import Region, enclosed, polygon_parts, silhouette, united
from packwork.readers.reading import UnfitError, notice
from packwork.units import Unit, convert

SMALL = 1 / 3
"""Share of its page, across or down, that a drawing takes at least where the page is kept. Larger
leaves out margins that were meant, smaller keeps postage stamps. Chosen."""

Box: TypeAlias = tuple[float, float, float, float]


def canvas_box(box: Box, page: tuple[float, float], trim: bool | None, unit: Unit | None) -> Box:
    """Left, top, width and height of the canvas: the page, or the box of what is drawn on it, px.

    A page in a real unit is a sheet on which the drawing has its size and place: it stays
    unless it is to be trimmed, which leaves the drawing as large as it is. None for ``trim``
    takes what looks right, which is said.

    Examples
    --------
    >>> canvas_box((1.0, 1.0, 9.0, 2.0), (10.0, 10.0), None, None)
    (0.0, 0.0, 10.0, 10.0)
    >>> canvas_box((1.0, 1.0, 9.0, 2.0), (10.0, 10.0), True, None)
    (1.0, 1.0, 8.0, 1.0)
    """
    left, top, right, bottom = box
    taken = max((right - left) / page[0], (bottom - top) / page[1])
    is_small = trim is None and taken < SMALL
    if is_small and unit is not None:
        width, height = (convert(side, "px", unit) for side in page)
        notice(
            f"takes {taken:.0%} of its page of {width:g} x {height:g} {unit}, which is kept; "
            "--trim leaves it out and keeps the scale"
        )
    elif is_small:
        notice(f"takes {taken:.0%} of its page, which is left out; --no-trim keeps it")
    if trim or (is_small and unit is None):
        return left, top, right - left, bottom - top
    return 0.0, 0.0, *page


THIN_MM, THIN_SHARE = 1.0, 0.03
"""Width of a line, and its share of the drawing's longer side, up to which it has none. Larger
makes frames of icons lines, smaller makes lines of small drawings frames. Chosen."""


def thin_px(extent: float) -> float:
    """Width of a line up to which it has none, in a drawing of an extent, both px."""
    return min(convert(THIN_MM, "mm", "px"), THIN_SHARE * extent)


def within_lines(lines: Region) -> Region:
    """Region that lines go round, px; closed thin ones are outlines and holes in turn.

    Where lines meet, or are thick, they go round one silhouette: those of a picture would cut
    each other.

    Examples
    --------
    >>> import shapely
    >>> ring = shapely.box(0, 0, 100, 100).boundary.buffer(0.1)
    >>> round(within_lines(ring | shapely.box(30, 30, 50, 50).boundary.buffer(0.1)).area, -2)
    9600.0
    """
    whole = silhouette(lines)
    rings = [part for part in polygon_parts(lines) if part.interiors]
    left, top, right, bottom = whole.bounds
    thin = thin_px(max(right - left, bottom - top))
    if any(len(one.interiors) > 1 or 2.0 * one.area > thin * one.length for one in rings):
        return whole
    kept = enclosed([one.exterior for one in rings])
    return difference(whole, difference(silhouette(MultiPolygon(rings)), kept))


Holes: TypeAlias = Literal["fill", "keep"]
"""Whether the outline is the silhouette with its holes filled, or the ink itself."""

SPECK = 1e-6
"""Share of a region's area below which a part or a hole of it is dropped. Chosen."""

SMALLEST_EXTENT_PX = 1e-4
"""Size below which a drawing counts as a point: its digits are used up. Chosen."""

THINNEST = 1e-7
"""Least area of a drawing as a share of its squared extent. Chosen."""

MAX_POINTS = 400_000
"""Points of one outline, a container's as well, which exact measures look at many times: as a run
takes it, its files are read back. Chosen."""

NEARLY_ALL = 0.97
"""Share of its page from which a container is told to fill it. Larger misses pages with round
corners, smaller speaks of shapes drawn to the rim. Chosen."""


def clean_union(*regions: Region, speck: float = SPECK) -> Region:
    """Union of regions without specks and pinholes.

    Examples
    --------
    >>> import shapely
    >>> clean_union(shapely.box(0, 0, 1, 1), shapely.box(5, 5, 5.0001, 5.0001)).area
    1.0
    """
    whole = snap_rounded(united(regions))
    if whole.area == 0:
        raise UnfitError("paints no area; give at least one filled or stroked shape")
    left, top, right, bottom = whole.bounds
    extent = max(right - left, bottom - top)
    if extent < SMALLEST_EXTENT_PX or whole.area < THINNEST * extent**2:
        raise UnfitError(
            f"paints only {right - left:.2g} x {bottom - top:.2g} px, too little to be placed; "
            "give a larger or thicker shape"
        )
    parts = large_parts(whole, speck * whole.area)
    # What lies in a hole is smaller than it: dropped with it, so parts stay apart.
    return parts[0] if len(parts) == 1 else MultiPolygon(parts)


def large_parts(whole: Region, smallest: float) -> list[Polygon]:
    """Parts of a region that have more than an area, without holes that have less."""
    return [
        Polygon(part.exterior, [h for h in part.interiors if Polygon(h).area > smallest])
        for part in polygon_parts(whole)
        if part.area > smallest
    ]


def tell_if_full(share: float, why: str) -> None:
    """Notice that a container is nearly all of its page, which is seldom meant, and why."""
    if share > NEARLY_ALL:
        notice(f"fills {min(share, 1.0):.1%} of its page, for {why}")


def without_holes(ink: Region) -> Region:
    """Silhouette of what is drawn, bays that are all but closed filled as its holes are.

    Examples
    --------
    >>> import shapely
    >>> ring = shapely.box(0, 0, 4, 4) - shapely.box(1, 1, 3, 3)
    >>> round(without_holes(ring - shapely.box(1.9, 0, 1.900001, 2)).area, 3)
    16.0
    """
    return silhouette(without_clefts(silhouette(ink)))


def centred(ink: Region, holes: Holes) -> tuple[Outline, Outline, FloatArray]:
    """Outline and ink with the outline's centroid at the origin, and the map that did it.

    Examples
    --------
    >>> import shapely
    >>> outline, ink, place = centred(shapely.box(2, 2, 4, 6), "fill")
    >>> outline.bounds, place[:, 2].tolist()
    ((-1.0, -2.0, 1.0, 2.0), [-3.0, -4.0])
    """
    outline = Outline.from_region(without_holes(ink) if holes == "fill" else ink)
    x, y = outline.centroid
    place = affine.similarity(-float(x), -float(y), 0.0, 1.0)
    placed = outline.mapped(place)
    # One object where they are the same: measures need not ask whether one holds the other.
    return placed, Outline.from_region(ink).mapped(place) if holes == "fill" else placed, place
