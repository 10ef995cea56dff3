"""Pictures of clean drawings by resvg."""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.raster.drawing import drawn_png
from packwork.readers.gate.door import document
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.coordinates import Page

TRACE_PX = 1_000
"""Longer side of the rendering that is traced: the outline is good to about 1/10,000 of
it. Larger costs time by its square. Chosen."""

FIND_PX = 250
"""Longer side of the rendering in which the ink of a drawing, or of a text, is looked for. Larger
costs time, smaller loses specks between its pixels. Chosen."""

_MARGIN_PX = 2
_SEEN = 0.5 / 255

View: TypeAlias = tuple[float, float, float, float]
"""Left, top, width and height in CSS pixels."""


def coverage(root: ET.Element, page: Page, part: View, longest_px: int) -> FloatArray:
    """Opacity 0..1 of one part of the page, its longer side ``longest_px`` pixels.

    Raises
    ------
    UnfitError
        If resvg cannot render the drawing.

    Examples
    --------
    >>> from packwork.readers.svg_syntax.coordinates import read_page
    >>> root = ET.fromstring('<svg width="20" height="20"><rect width="10" height="10"/></svg>')
    >>> float(coverage(root, read_page(root), (0.0, 0.0, 20.0, 20.0), 4).sum())
    4.0
    """
    picture = page_picture(root, page, part, longest_px)
    pixels = decode_picture(picture, longest_px).pixels
    return np.asarray(pixels[:, :, 3], dtype=np.float64) / 255.0


def inked(opacity: FloatArray, part: View) -> View | None:
    """Box of what a picture of a part shows, with a margin of two pixels; None if nothing.

    Examples
    --------
    >>> picture = np.zeros((10, 20)); picture[4, 8] = 1.0
    >>> inked(picture, (0.0, 0.0, 2.0, 1.0))
    (0.6..., 0.2, 0.5, 0.5)
    """
    shown = opacity > _SEEN
    rows, columns = (np.flatnonzero(shown.any(axis=axis)) for axis in (1, 0))
    if len(rows) == 0:
        return None
    px = max(part[2:]) / max(opacity.shape)
    left, top = part[0] + (columns[0] - _MARGIN_PX) * px, part[1] + (rows[0] - _MARGIN_PX) * px
    width, height = ((np.ptp(ends) + 1 + 2 * _MARGIN_PX) * px for ends in (columns, rows))
    return float(left), float(top), float(width), float(height)


def page_picture(
    root: ET.Element,
    page: Page,
    part: View | None = None,
    longest_px: int = TRACE_PX,
) -> bytes:
    """PNG of one part of the page, or all of it, its longer side ``longest_px`` pixels.

    Raises
    ------
    UnfitError
        If resvg cannot render the drawing.

    Examples
    --------
    >>> from packwork.readers.svg_syntax.coordinates import read_page
    >>> root = ET.fromstring('<svg width="20" height="20"/>')
    >>> page_picture(root, read_page(root))[1:4]
    b'PNG'
    """
    left, top, width, height = part or (0.0, 0.0, page.width, page.height)
    # The view is as many whole pixels as the picture, or both ways would scale differently.
    px = max(width, height) / longest_px
    columns, rows = max(1, round(width / px)), max(1, round(height / px))
    inner = copy.copy(root)
    inner.attrib = {**root.attrib, "x": "0", "y": "0"}
    inner.attrib |= {"width": repr(page.width), "height": repr(page.height)}
    outer = ET.Element(
        "svg",
        {
            "width": str(columns),
            "height": str(rows),
            "viewBox": f"{left!r} {top!r} {columns * px!r} {rows * px!r}",
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
