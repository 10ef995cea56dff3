"""SVGs to containers: what the drawing covers, on its page."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import shapely

from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region, silhouette
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.pictures.mask import mask_of_pixels
from packwork.readers.regions import clean_union
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.ink import Ink
from packwork.readers.svg.trace import TRACE_PX, page_picture
from packwork.readers.svg.walk import Page
from packwork.readers.unfit import naming
from packwork.scene.container import Container

WHOLE_PAGE = 0.999
"""Share of the page from which a drawing counts as painted all over. Chosen."""


def container_of_svg(data: bytes, name: str, source: str, side: float) -> Container:
    """Container of an SVG's bytes, its canvas the page, scaled to ``side``.

    Filled shapes count, with their holes and parts, and of shapes drawn as lines the
    inside. Where that is the whole page, as with a white sheet behind the drawing, its
    picture is taken for a mask: dark is inside. Without a page the canvas is the
    region's box.

    Raises
    ------
    ReadError
        If it is no SVG, passes a limit or paints nothing.

    Examples
    --------
    >>> data = b'<svg viewBox="0 0 20 10"><rect width="10" height="10"/></svg>'
    >>> container = container_of_svg(data, "half", "half.svg", 600.0)
    >>> container.width, container.height, container.outline.bounds
    (600.0, 300.0, (0.0, 0.0, 300.0, 300.0))
    """
    with naming(source):
        drawing = read_drawing(data)
        region = _inside(drawing.ink)
        left, top, right, bottom = region.bounds
        if drawing.page is not None:
            left, top, right, bottom = 0.0, 0.0, drawing.page.width, drawing.page.height
            if region.area > WHOLE_PAGE * (right * bottom):
                region = _dark_part(drawing.root, drawing.page)
        return placed_container(name, source, region, (left, top, right - left, bottom - top), side)


def placed_container(
    name: str,
    source: str,
    region: Region,
    canvas: tuple[float, float, float, float],
    side: float,
) -> Container:
    """Container of a region on its canvas, both scaled to ``side``.

    Parameters
    ----------
    canvas
        Left, top, width and height in the region's units.

    Examples
    --------
    >>> box = shapely.box(1, 1, 2, 2)
    >>> placed_container("a", "a", box, (0, 0, 4, 2), 8.0).outline.bounds
    (2.0, 2.0, 4.0, 4.0)
    """
    left, top, width, height = canvas
    scale = side / max(width, height)
    moved = shapely.transform(region, lambda points: (points - (left, top)) * scale)
    return Container(name, source, Outline.from_region(moved), width * scale, height * scale)


def _inside(ink: Ink) -> Region:
    inside = [ink.fills] if ink.fills.area > 0 else []
    if ink.lines.area > 0:
        inside.append(silhouette(ink.lines))
    return clean_union(*inside)


def _dark_part(root: ET.Element, page: Page) -> Region:
    """What is dark on a page that is painted all over, in CSS pixels."""
    pixels = decode_picture(page_picture(root, page), TRACE_PX).pixels
    traced = mask_of_pixels(pixels)
    return shapely.transform(traced.region, lambda points: points * (page.width / traced.width))
