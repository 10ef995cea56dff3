"""An SVG's bytes to the regions it paints: computed where shapes tell, else traced."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass

import shapely
from shapely.geometry import Polygon

from packwork.geometry.polygon import Region, polygon_parts
from packwork.readers.gate import admit
from packwork.readers.patterns import check_tiles
from packwork.readers.svg_ink import Ink, drawing_box, painted_ink
from packwork.readers.svg_trace import inked_part, needs_tracing, traced_ink
from packwork.readers.svg_walk import Page, Painted, painted_shapes, read_page
from packwork.readers.unfit import UnfitError

SPECK = 1e-6
"""Share of a region's area below which a part or a hole of it is dropped. Chosen."""

SMALLEST_EXTENT_PX = 1e-4
"""Size below which a drawing counts as a point: its digits are used up. Chosen."""

THINNEST = 1e-7
"""Least area of a drawing as a share of its squared extent. Chosen."""


@dataclass(frozen=True, eq=False)
class Drawing:
    """An SVG that has been through the gate, and what it paints.

    Parameters
    ----------
    root
        The clean tree.
    page
        What viewers show, if the file says so.
    ink
        In CSS pixels, right and down from the page's corner.
    """

    root: ET.Element
    page: Page | None
    ink: Ink


def read_drawing(data: bytes) -> Drawing:
    """Drawing of an SVG file's bytes.

    Raises
    ------
    UnfitError
        If it is no SVG, passes a limit or paints nothing.

    Examples
    --------
    >>> drawing = read_drawing(b'<svg viewBox="0 0 9 9"><rect width="4" height="2"/></svg>')
    >>> drawing.ink.fills.area
    8.0
    """
    root = admit(data)
    page = read_page(root)
    shapes = painted_shapes(root, page)
    if not needs_tracing(root):
        return Drawing(root, page, painted_ink(shapes))
    if page is None:
        page = _framed(root, shapes)
    # Twice: the tiles must suit the page to find the ink, and the ink to look closer.
    check_tiles(root, shapes, max(page.width, page.height))
    part = inked_part(root, page)
    check_tiles(root, shapes, max(part[2:], default=0.0))
    return Drawing(root, page, Ink(traced_ink(root, page, part), Polygon(), is_cut=True))


def clean_union(*regions: Region, speck: float = SPECK) -> Region:
    """Union of regions without specks and pinholes.

    Raises
    ------
    UnfitError
        If nothing is left, or what is left is too small or too thin to be placed.

    Examples
    --------
    >>> clean_union(shapely.box(0, 0, 1, 1), shapely.box(5, 5, 5.0001, 5.0001)).area
    1.0
    """
    united = shapely.union_all([p for region in regions for p in polygon_parts(region)])
    if united.area == 0:
        raise UnfitError("paints no area; give at least one filled or stroked shape")
    left, top, right, bottom = united.bounds
    extent = max(right - left, bottom - top)
    if extent < SMALLEST_EXTENT_PX or united.area < THINNEST * extent**2:
        raise UnfitError(
            f"paints only {right - left:.2g} x {bottom - top:.2g} px, too little to be placed; "
            "give a larger or thicker shape"
        )
    smallest = speck * united.area
    parts = [
        Polygon(part.exterior, [h for h in part.interiors if Polygon(h).area > smallest])
        for part in polygon_parts(united)
        if part.area > smallest
    ]
    return parts[0] if len(parts) == 1 else shapely.union_all(parts)


def _framed(root: ET.Element, shapes: list[Painted]) -> Page:
    """Page round the shapes of a drawing that states none; the root is told of it."""
    box = drawing_box(shapes)
    if box is None:
        raise UnfitError("states no size; give its <svg> a viewBox")
    left, top = float(box[0]), float(box[1])
    width, height = float(box[2] - box[0]), float(box[3] - box[1])
    root.attrib |= {"viewBox": f"{left!r} {top!r} {width!r} {height!r}"}
    for name in ("width", "height"):
        root.attrib.pop(name, None)
    page = read_page(root)
    if page is None:
        raise UnfitError("states no size; give its <svg> a viewBox")
    return page
