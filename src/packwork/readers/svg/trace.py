"""What cannot be computed from shapes alone (text, clips, masks, pictures), traced.

The clean drawing is rendered by resvg and the edge of its opacity followed.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from typing import TypeAlias

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import FloatArray
from packwork.geometry.polygon import Region
from packwork.raster.drawing import drawn_png
from packwork.readers.gate.door import document
from packwork.readers.gate.vocabulary import TRACED
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.svg.walk import Page
from packwork.readers.unfit import UnfitError

TRACE_PX = 1_000
"""Longer side of the rendering that is traced: the outline is good to about 1/10,000 of
it. Larger costs time by its square. Chosen."""

Part: TypeAlias = tuple[float, float, float, float] | tuple[()]
"""Left, top, width and height in CSS pixels; empty if nothing shows."""

_MARGIN_PX = 2
_SIMPLIFY_PX = 0.05
_OPACITIES = ("opacity", "fill-opacity", "stroke-opacity")


def needs_tracing(root: ET.Element) -> bool:
    """Whether a clean drawing uses anything beyond plain shapes.

    Examples
    --------
    >>> needs_tracing(ET.fromstring("<svg><g><text>a</text></g></svg>"))
    True
    """
    return any(element.tag in TRACED for element in root.iter())


def inked_part(root: ET.Element, page: Page) -> Part:
    """Box of what a clean drawing shows on its page, with a margin; may be empty.

    Raises
    ------
    UnfitError
        If resvg cannot render the drawing.

    Examples
    --------
    >>> root = ET.fromstring('<svg width="100" height="50"><rect width="10" height="9"/></svg>')
    >>> from packwork.readers.svg.walk import read_page
    >>> [round(side, 1) for side in inked_part(root, read_page(root))]
    [-0.2, -0.2, 10.4, 9.4]
    """
    coverage = _coverage(root, page, (0.0, 0.0, page.width, page.height))
    rows, columns = (np.flatnonzero(coverage.any(axis=axis)) for axis in (1, 0))
    if len(rows) == 0:
        return ()
    px = max(page.width, page.height) / TRACE_PX
    left, top = (float(ends[0] - _MARGIN_PX) * px for ends in (columns, rows))
    width, height = (float(np.ptp(ends) + 1 + 2 * _MARGIN_PX) * px for ends in (columns, rows))
    return left, top, width, height


def traced_ink(root: ET.Element, page: Page, part: Part) -> Region:
    """Region of a clean drawing that is more opaque than not, in CSS pixels; may be empty.

    Opacities above zero count as full: a faint shape is a shape.

    Parameters
    ----------
    part
        As ``inked_part`` gave it: what is rendered, ``TRACE_PX`` pixels long.

    Raises
    ------
    UnfitError
        If resvg cannot render the drawing.

    Examples
    --------
    >>> root = ET.fromstring('<svg width="20" height="20"><rect width="10" height="10"/></svg>')
    >>> from packwork.readers.svg.walk import read_page
    >>> round(traced_ink(root, read_page(root), (0.0, 0.0, 20.0, 20.0)).area)
    100
    """
    from packwork.readers.pictures.contours import contour_region

    if len(part) == 0:
        return Polygon()
    solid = copy.deepcopy(root)
    _make_solid(solid)
    traced = contour_region(_coverage(solid, page, part), _SIMPLIFY_PX)
    px = max(part[2:]) / TRACE_PX
    return shapely.transform(traced, lambda points: points * px + part[:2])


def _make_solid(element: ET.Element) -> None:
    """Take opacities and dashes away, except where they shape a mask, in place."""
    if element.tag == "mask":
        return
    for name in _OPACITIES:
        if element.get(name, "0").strip(" 0.%"):
            del element.attrib[name]
    element.attrib.pop("stroke-dasharray", None)
    for child in element:
        _make_solid(child)


def _coverage(root: ET.Element, page: Page, part: tuple[float, float, float, float]) -> FloatArray:
    """Opacity 0..1 of one part of the page, its longer side ``TRACE_PX`` pixels."""
    pixels = decode_picture(page_picture(root, page, part), TRACE_PX).pixels
    return np.asarray(pixels[:, :, 3], dtype=np.float64) / 255.0


def page_picture(
    root: ET.Element, page: Page, part: tuple[float, float, float, float] | None = None
) -> bytes:
    """PNG of one part of the page (left, top, width, height), or all of it.

    Its longer side is ``TRACE_PX`` pixels.

    Raises
    ------
    UnfitError
        If resvg cannot render the drawing.
    """
    part = part or (0.0, 0.0, page.width, page.height)
    left, top, width, height = part
    scale = TRACE_PX / max(width, height)
    inner = copy.copy(root)
    inner.attrib = {**root.attrib, "x": "0", "y": "0"}
    inner.attrib |= {"width": repr(page.width), "height": repr(page.height)}
    outer = ET.Element(
        "svg",
        {
            "width": str(max(1, round(width * scale))),
            "height": str(max(1, round(height * scale))),
            "viewBox": f"{left!r} {top!r} {width!r} {height!r}",
            "preserveAspectRatio": "xMinYMin slice",
        },
    )
    outer.append(inner)
    return render(outer)


def render(root: ET.Element) -> bytes:
    """PNG of a clean drawing at its own size; nothing but clean drawings may come here.

    Raises
    ------
    UnfitError
        If resvg gives up.

    Examples
    --------
    >>> render(ET.Element("svg", {"width": "2", "height": "2"}))[1:4]
    b'PNG'
    """
    try:
        return drawn_png(document(root))
    except ValueError as error:
        raise UnfitError(f"cannot be rendered ({error}); save it as plain SVG") from None
