"""Pixel check of a layout's SVG: paint outside the container, and in more than one item.

The items are painted in a few pictures, in each of which no two are near one another; where the
opacities of these add up to more than one, two items are painted.
"""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.errors import ReadError
from packwork.raster.drawing import drawn_png
from packwork.readers.gate.door import document, parse_untrusted, parse_xml
from packwork.readers.layouts.foreign_svg import group_named, tag
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.reading import UnfitError
from packwork.scene.layout import Layout
from packwork.threads import at_once

SIDE_PX = 400
"""Longer side of the pictures: a quarter of a millimetre of ten centimetres. Larger takes
time by its square. Chosen."""

PAINTED_BYTES = 5_000_000
"""Size of a file above which it is not painted at a run's end: pictures take seconds. Chosen."""

NEAR_PX = 2.0
"""Distance of boxes from which items are in one picture: edges are softened over a pixel."""

SEEN, DOUBLE = 0.5, 1.25
"""Opacity from which a pixel outside is paint, and sum of opacities from which it is that of two
items: two that meet in a pixel come to one. What is drawn from pixels is softened by up to another:
pixels count of which four are together. Chosen."""

_NEVER = frozenset({"defs", "style", "symbol", "clipPath", "mask", "filter", "linearGradient",
                    "radialGradient", "pattern", "marker"})  # fmt: skip


@dataclass(frozen=True)
class PaintedPixels:
    """Counts of pixels in a picture of a layout.

    ``outside``: those of the items' paint where nothing of the container is; ``double``: those that
    more than one item paints.
    """

    outside: int
    double: int
    columns: int
    rows: int

    def __str__(self) -> str:
        """One line."""
        return (
            f"of {self.columns} x {self.rows} px painted, {self.outside} are outside, "
            f"{self.double} in more than one item"
        )


def painted_pixels(data: bytes, layout: Layout, *, is_own: bool = False) -> PaintedPixels:
    """Paint the items of an SVG of ours, which goes through the gate unless it was made just now.

    Raises ``UnfitError`` if it cannot be painted item by item.

    >>> from packwork.scene.layout import blank
    >>> from packwork.writers.svg import svg_text
    >>> painted = painted_pixels(svg_text(blank()).encode(), blank(), is_own=True)
    >>> painted.outside, painted.double
    (0, 0)
    """
    root = parse_xml(data)
    items = group_named(root, "items")
    elements = [] if items is None else list(items)
    if items is None or len(elements) != len(layout.items):
        raise UnfitError(f"shows {len(elements)} of {len(layout.items)} items; save it anew")
    container = layout.container
    longest = SIDE_PX / container.side
    columns, rows = (max(1, round(s * longest)) for s in (container.width, container.height))
    sums, most = np.zeros((rows, columns)), np.zeros((rows, columns))

    def painted(apart: IntArray) -> FloatArray:
        sheet = _with_items(root, items, [elements[k] for k in apart])
        return _opacity(sheet, columns, rows, is_own=is_own)

    try:
        # Long documents are drawn by processes of their own, two and more at once.
        for picture in at_once(painted, [(one,) for one in sets_apart(layout, NEAR_PX / longest)]):
            sums += picture
            most = np.maximum(most, picture)
    except (ValueError, ReadError) as error:
        raise UnfitError(f"cannot be painted: {error}") from None
    inside = _room(layout, columns, rows)
    return PaintedPixels(
        outside=_in_fours((most > SEEN) & (inside == 0)),
        double=_in_fours(sums > DOUBLE),
        columns=columns,
        rows=rows,
    )


def _in_fours(pixels: BoolArray) -> int:
    """Number of pixels that are in some square of four."""
    fours = pixels[1:, 1:] & pixels[:-1, 1:] & pixels[1:, :-1] & pixels[:-1, :-1]
    met = np.zeros_like(pixels)
    for rows in (slice(1, None), slice(None, -1)):
        for columns in (slice(1, None), slice(None, -1)):
            met[rows, columns] |= fours
    return int(np.count_nonzero(met))


def sets_apart(layout: Layout, distance: float) -> list[IntArray]:
    """Items in sets, in each of which all boxes are that far apart; distances in canvas units."""
    if not layout.items:
        return []
    boxes = np.array([outline.bounds for outline in layout.outlines])
    boxes += distance / 2 * np.array([-1, -1, 1, 1])
    shapes = shapely.box(*boxes.T)
    pairs = shapely.STRtree(shapes).query(shapes)
    number = np.full(len(shapes), -1)
    order = np.argsort(pairs[0], kind="stable")
    ends = np.searchsorted(pairs[0][order], np.arange(len(shapes) + 1))
    for k in range(len(shapes)):
        taken = set(number[pairs[1][order[ends[k] : ends[k + 1]]]].tolist())
        number[k] = next(n for n in range(len(taken) + 1) if n not in taken)
    return [np.flatnonzero(number == n) for n in range(number.max() + 1)]


def _with_items(root: ET.Element, items: ET.Element, chosen: Iterable[ET.Element]) -> ET.Element:
    """The file with no drawings but these items."""
    group, sheet = copy.copy(items), copy.copy(root)
    group[:] = list(chosen)
    used = {text.removeprefix("#") for e in group.iter() for text in e.attrib.values()}
    sheet[:] = []
    for child in root:
        if tag(child) == "defs":
            defs = copy.copy(child)
            defs[:] = [e for e in child if e.get("id", "") in used or not _is_shape(e)]
            sheet.append(defs)
        elif tag(child) in _NEVER:
            sheet.append(child)
    sheet.append(group)
    return sheet


def _is_shape(element: ET.Element) -> bool:
    return element.get("id", "").startswith("shape-")


def _opacity(sheet: ET.Element, columns: int, rows: int, *, is_own: bool) -> FloatArray:
    sheet.attrib = {**sheet.attrib, "width": str(columns), "height": str(rows)}
    sheet.attrib["preserveAspectRatio"] = "none"
    text = ET.tostring(sheet, encoding="unicode")
    if not is_own:
        text = document(parse_untrusted(text.encode()))
    pixels = decode_picture(drawn_png(text), max(columns, rows)).pixels
    return np.asarray(pixels[:, :, 3], dtype=np.float64) / 255


def _room(layout: Layout, columns: int, rows: int) -> FloatArray:
    """Share of each pixel that is in the container."""
    from packwork.raster.coverage import coverage

    outline = layout.container.outline
    if layout.container.lattice is not None:
        return np.ones((rows, columns))
    scale = np.array([columns / layout.container.width, rows / layout.container.height])
    return np.asarray(
        coverage(outline.points * scale, outline.starts, (rows, columns)), dtype=np.float64
    )
