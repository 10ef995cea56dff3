"""Pictures of clean drawings by resvg, and opaque copies of drawings that show what they cover."""

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
from packwork.readers.svg_syntax.painted import is_clear, opacity
from packwork.readers.svg_syntax.references import elements_by_id, paint_server
from packwork.readers.svg_syntax.vocabulary import GRADIENTS, HREF

_COLOURING = GRADIENTS | {"filter"}
_OPACITIES = ("opacity", "fill-opacity", "stroke-opacity")
_PAINTS = ("fill", "stroke", "color")
_CLEAR = "rgba(0, 0, 0, 0)"
_BY_REFERENCE = frozenset({"inherit", "currentcolor", "context-fill", "context-stroke"})


def solid_twin(root: ET.Element, *, with_dashes: bool = True) -> ET.Element:
    """Copy of a clean drawing whose opacity is what it covers: a faint shape is a shape.

    Only what shapes a mask stays as it is, and pictures.

    Parameters
    ----------
    root
        Left as it is.
    with_dashes
        Whether dashed lines stay dashed.

    Examples
    --------
    >>> root = ET.fromstring('<svg><rect fill="red" opacity=".2"/><rect fill="none"/></svg>')
    >>> [shape.attrib for shape in solid_twin(root)]
    [{'fill': 'black'}, {'fill': 'none'}]
    """
    twin = copy.deepcopy(root)
    _harden(twin, elements_by_id(twin), with_dashes=with_dashes)
    if twin.find(".//mask") is None:
        _drop_unused(twin)
    return twin


def _harden(element: ET.Element, by_id: dict[str, ET.Element], *, with_dashes: bool) -> None:
    if element.tag == "mask":
        return
    for name in _OPACITIES:
        if opacity(element.get(name), 0.0) > 0:
            del element.attrib[name]
    for name in _PAINTS:
        if name in element.attrib:
            solid = _solid(element.attrib[name], by_id)
            element.set(name, _CLEAR if name == "color" and solid == "none" else solid)
    for name in ("style", "filter"):
        element.attrib.pop(name, None)
    if not with_dashes:
        element.attrib.pop("stroke-dasharray", None)
    for child in element:
        _harden(child, by_id, with_dashes=with_dashes)


def _drop_unused(twin: ET.Element) -> None:
    """Take out what only colours referred to."""
    for parent in list(twin.iter()):
        for child in list(parent):
            if child.tag in _COLOURING:
                parent.remove(child)


def _solid(paint: str, by_id: dict[str, ET.Element]) -> str:
    server = by_id.get(paint_server(paint) or "")
    if server is not None:
        if server.tag not in GRADIENTS:
            return paint
        return "black" if _shows(server, by_id) else "none"
    if paint.strip().lower() in _BY_REFERENCE:
        return paint
    return "none" if is_clear(paint) else "black"


def _shows(gradient: ET.Element, by_id: dict[str, ET.Element]) -> bool:
    """Whether any stop of a gradient, or of the one it is made after, is not clear."""
    while (stops := gradient.findall("stop")) == []:
        made_after = by_id.get(gradient.get(HREF, "")[1:])
        if made_after is None:
            return False
        gradient = made_after
    return any(
        opacity(stop.get("stop-opacity"), 1.0) > 0 and not is_clear(stop.get("stop-color", "black"))
        for stop in stops
    )


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
