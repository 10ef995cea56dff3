"""SVGs to containers: what the drawing covers, on its page."""

from __future__ import annotations

import shapely

from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region
from packwork.readers.regions import clean_union, silhouette
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.ink import Ink
from packwork.readers.unfit import naming
from packwork.scene.container import Container


def container_of_svg(data: bytes, name: str, source: str, side: float) -> Container:
    """Container of an SVG's bytes, its canvas the page, scaled to ``side``.

    Filled areas count, with their holes and parts; in a line drawing, which has none,
    the inside of the outermost lines does. Without a page the canvas is the region's box.

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
    if ink.fills.area > 0:
        return clean_union(ink.fills)
    return silhouette(clean_union(ink.strokes))
