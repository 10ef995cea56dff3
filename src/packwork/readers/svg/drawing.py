"""An SVG's bytes to the regions it paints: computed where shapes tell, else traced."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass

from shapely.geometry import Polygon

from packwork.readers.gate.door import admit
from packwork.readers.svg.ink import Ink, drawing_box, painted_ink
from packwork.readers.svg.patterns import check_tiles
from packwork.readers.svg.trace import inked_part, needs_tracing, traced_ink
from packwork.readers.svg.walk import Page, Painted, painted_shapes, read_page
from packwork.readers.unfit import UnfitError


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
    return Drawing(root, page, Ink(traced_ink(root, page, part), Polygon(), Polygon(), is_cut=True))


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
