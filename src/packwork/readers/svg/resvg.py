"""Pictures of clean drawings by resvg, and how they agree with regions that were computed.

Drawing and region are both drawn by resvg in the same small picture, so that its soft edges tell
nothing apart. Thin details need more pixels, so a poor agreement is looked at more closely.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region, oriented_rings
from packwork.raster.drawing import drawn_png
from packwork.readers.budget.rendering import Work
from packwork.readers.gate.door import document
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.coordinates import PLAIN_VIEWPORT, Page
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
    """PNG of one part of the page, or all of it, its longer side ``longest_px`` pixels."""
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
    """PNG of a clean drawing at its own size; nothing but clean drawings may come here."""
    try:
        return drawn_png(document(root))
    except ValueError as error:
        raise UnfitError(f"cannot be rendered ({error}); save it as plain SVG") from None


LEAST_AGREEMENT = 0.98
"""Intersection over union below which a reading counts as wrong. Larger traces drawings
for seams between their shapes, smaller lets a lost detail pass. Chosen."""

SIDES_PX = (64, 256, TRACE_PX)
"""Longer sides of the pictures, each looked at if the one before it disagrees. Tried: few
drawings needed the second, 1 % the third."""

_HOPELESS = 0.9
_MANY_ELEMENTS = 5_000
_AROUND = 0.5
_STEPS = 100


class Comparison:
    """Pictures of a clean drawing, solid, of growing size, each made once.

    The box of a region and half as much around it are looked at. Without a page, user units are
    CSS pixels and nothing is cut off.
    """

    def __init__(self, root: ET.Element, page: Page | None, region: Region, work: Work) -> None:
        self._root, self._page = _on_page(solid_twin(root), page)
        self._part = _surroundings(region, page)
        longest = SIDES_PX[1:2] if work.elements > _MANY_ELEMENTS else SIDES_PX
        self._sides = list(dict.fromkeys(work.side(px, max(self._part[2:])) for px in longest))
        self._has_hairs = work.hairs > 0
        self._work = work
        self._shown: dict[int, FloatArray] = {}

    def agreement(self, region: Region) -> float:
        """Intersection over union of a region and what is shown.

        A second region is looked at as closely as the first one was.
        """
        reached = 0.0
        for side in self._sides if not self._shown else [max(self._shown)]:
            if side not in self._shown:
                self._work.spend(side, max(self._part[2:]))
                self._shown[side] = coverage(self._root, self._page, self._part, side)
            reached = max(reached, iou(self._shown[side], _drawn(region, self._part, side)))
            is_hopeless = side >= SIDES_PX[1] and reached < _HOPELESS and not self._has_hairs
            if reached >= LEAST_AGREEMENT or is_hopeless:
                break
        return reached


def excess(shown: FloatArray, drawn: FloatArray) -> float:
    """Excess of a drawing over a region, both as pictures, as a share of the region.

    What is within a pixel of the region is not beyond it: filters leave hard edges.

    >>> whole = np.ones((8, 8))
    >>> excess(whole, np.pad(np.ones((8, 4)), ((0, 0), (0, 4))))
    0.75
    """
    return float(np.maximum(shown - _spread(drawn), 0.0).sum() / max(1.0, drawn.sum()))


def side_by_side(
    region: Region, root: ET.Element, page: Page | None, side: int
) -> tuple[FloatArray, FloatArray]:
    """Pictures of a drawing and of a region, about the region."""
    part = _surroundings(region, page)
    return coverage(*_on_page(root, page), part, side), _drawn(region, part, side)


def iou(a: FloatArray, b: FloatArray) -> float:
    """Intersection over union of coverages; of nothing and nothing 1.

    >>> iou(np.array([[1.0, 0.5]]), np.array([[1.0, 0.0]])).__round__(3)
    0.667
    """
    union = float(np.maximum(a, b).sum())
    return float(np.minimum(a, b).sum()) / union if union > 0 else 1.0


def _on_page(root: ET.Element, page: Page | None) -> tuple[ET.Element, Page]:
    """A drawing without a page on one that cuts nothing off."""
    if page is not None:
        return root, page
    root = copy.copy(root)
    root.attrib = {**root.attrib, "overflow": "visible"}
    return root, Page(*PLAIN_VIEWPORT, affine.identity())


def _surroundings(region: Region, page: Page | None) -> View:
    """Part of the page about a region; all of it about none."""
    if region.is_empty:
        width, height = PLAIN_VIEWPORT if page is None else (page.width, page.height)
        return 0.0, 0.0, width, height
    left, top, right, bottom = region.bounds
    around = _AROUND * max(right - left, bottom - top)
    left, top, right, bottom = left - around, top - around, right + around, bottom + around
    if page is not None:
        left, top = max(0.0, left), max(0.0, top)
        right, bottom = min(page.width, right), min(page.height, bottom)
    return left, top, right - left, bottom - top


def _drawn(region: Region, part: View, side: int) -> FloatArray:
    """The same picture of a region."""
    px = max(part[2:]) / side
    rings = [np.round((ring - part[:2]) * (_STEPS / px)) for ring in oriented_rings(region)]
    data = "".join(f"M{' '.join(map(str, ring.ravel().astype(int).tolist()))}z" for ring in rings)
    root = ET.Element("svg")
    ET.SubElement(root, "path", {"d": data, "fill-rule": "evenodd"})
    view = (0.0, 0.0, part[2] / px * _STEPS, part[3] / px * _STEPS)
    return coverage(root, Page(*view[2:], affine.identity()), view, side)


def _spread(picture: FloatArray) -> FloatArray:
    """The greatest of each pixel and its eight neighbours."""
    rows, columns = picture.shape
    padded = np.pad(picture, 1)
    parts = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    return np.asarray(np.max(parts, axis=0))
