"""Line drawings with reduced stroke width on the same centre lines."""

from __future__ import annotations

import copy
import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely.errors import GEOSException

from packwork.arrays import FloatArray
from packwork.errors import ShapeError
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered
from packwork.geometry.polygon import silhouette
from packwork.readers.reading import UnfitError
from packwork.readers.regions import Holes, clean_union, without_holes
from packwork.readers.svg.art import vector_art
from packwork.readers.svg.drawing import PaintedDrawing, read_drawing
from packwork.readers.svg.ink import PaintedInk
from packwork.readers.svg.walk import painted_shapes
from packwork.readers.svg_syntax.painted import drawing_box
from packwork.scene.item import Item, VectorArt

LINES_SHARE = 0.75
"""Share of its ink that lines have to be for a drawing to be one in lines. Larger leaves icons
with a filled dot as they are, smaller thins the edges of filled drawings. Chosen."""

THIN = 1 / 7
"""Mean breadth of its ink, as a share of its extent, below which a drawing with strokes passes for
one in lines before that is looked at. Larger takes lean icons for such: ours in lines have up to
.093, the leanest others .12. Tried."""

MOST_LOOKED = 60
"""Drawings at most whose lines are looked at, where it is only for advice. Chosen."""

UNSURE = 1e-3
"""Share of a silhouette's area by which closing its narrowest bays may change it. Larger lets
programmes differ about a bay whose mouth a line all but closes. Chosen."""

NUDGE, MOST_NUDGES = 0.99, 4
"""Factor on the lines' width that opens such a mouth, and how often it is tried. Chosen."""

ROUNDING = 1e-12
"""Distance by which an outline may reach beyond the one it had, as a share of its extent: a
millionth of the least gap. Smaller refuses butt ends that lie askew. Derived."""

_WIDTH = "stroke-width"
_STROKE = re.compile(r"\bstroke\s*[=:]\s*[\"']?\s*(?!none)[#\w]")
_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)")


@dataclass(frozen=True, eq=False)
class LineDrawing:
    """An item drawn in lines, most of them of ``width``, in the item's own units."""

    item: Item
    width: float
    _art: VectorArt
    _drawing: PaintedDrawing

    def thinner(self, factor: float, holes: Holes) -> Item | None:
        """The item with its lines ``factor`` times as wide; None where that cannot be told.

        The factor is below 1. The origin stays, and the outline lies within the one it had.
        """
        found: Item | None = None
        for nudges in range(MOST_NUDGES):
            found, is_sure = self._thinner(factor * NUDGE**nudges, holes)
            if is_sure:
                break
        return found

    def _thinner(self, factor: float, holes: Holes) -> tuple[Item | None, bool]:
        """The same, and whether its silhouette does not hang on a mouth that is hardly open."""
        root = _scaled(self._drawing.root, factor)
        box = drawing_box(self._drawing.shapes)
        assert box is not None  # noqa: S101 - a drawing without ink is none in lines
        extent = max(box[2] - box[0], box[3] - box[1])
        place = self._art.matrix
        try:
            # Curves are followed as they were, so that edges that stay are the same.
            painted = PaintedInk(painted_shapes(root, None), extent)
            body = clean_union(painted.body)
            shape = without_holes(body) if holes == "fill" else body
            is_sure = holes == "keep" or shape.area <= (1 + UNSURE) * silhouette(body).area
            outline = Outline.from_region(shape).mapped(place)
            ink = Outline.from_region(clean_union(painted.whole)).mapped(place)
            if not _is_within(outline, self.item.outline):
                return None, True
        except (UnfitError, GEOSException, ShapeError):
            return None, True
        art = vector_art(root, None, is_cut=False, place=place)
        return replace(self.item, outline=outline, ink=ink, art=art), is_sure


def line_drawing(item: Item) -> LineDrawing | None:
    """An item as a drawing in lines; None if it is none.

    >>> from packwork.readers.svg.item import item_of_svg
    >>> data = b'<svg><path d="M0 0h20" stroke="red" stroke-width="4"/></svg>'
    >>> line = line_drawing(item_of_svg(data, "line", "line.svg"))
    >>> line.width, line.thinner(0.5, "fill").outline.bounds
    (4.0, (-10.0, -1.0, 10.0, 1.0))
    """
    art = item.art
    if item.text is not None or not isinstance(art, VectorArt) or art.is_traced:
        return None
    if "stroke" not in art.markup:
        return None
    try:
        drawing = read_drawing(f"<svg>{art.markup}</svg>".encode())
        filled, ink = drawing.ink.fills.area, drawing.ink.body.area
    except (UnfitError, GEOSException, ShapeError):
        return None
    stroked = [shape for shape in drawing.shapes if shape.painting.has_stroke]
    if not stroked or filled > (1 - LINES_SHARE) * ink:
        return None
    widths = np.array([s.painting.pen.width * _size(s.matrix) for s in stroked])
    lengths = np.array([sum(shape.lengths) + 1e-9 for shape in stroked])
    order = np.argsort(widths, kind="stable")
    up_to = np.cumsum(lengths[order])
    middle = order[int(np.searchsorted(up_to, up_to[-1] / 2))]
    return LineDrawing(item, float(widths[middle]) * _size(art.matrix), art, drawing)


def are_lines(items: Sequence[Item]) -> bool:
    """Whether most of some items look like drawings in lines, by their regions alone.

    >>> from packwork.readers.svg.item import item_of_svg
    >>> data = b'<svg><path d="M0 0h20" stroke="red"/></svg>'
    >>> are_lines([item_of_svg(data, "line", "line.svg")])
    True
    """
    kinds = list(dict.fromkeys(items))[:MOST_LOOKED]
    return 2 * sum(map(_looks_thin, kinds)) > len(kinds)


def _looks_thin(item: Item) -> bool:
    if item.text is not None or not isinstance(item.art, VectorArt):
        return False
    ink = item.ink
    return "stroke" in item.art.markup and 2 * ink.area < THIN * ink.extent * ink.region.length


def has_traced_lines(item: Item) -> bool:
    """Whether an item is a drawing with lines that its shapes do not tell."""
    art = item.art
    if item.text is not None or not isinstance(art, VectorArt) or not art.is_traced:
        return False
    return _STROKE.search(art.markup) is not None


def _is_within(inner: Outline, outer: Outline) -> bool:
    """Whether a region lies in another, their edges alike but for the last digits."""
    allowed = buffered(outer.region, ROUNDING * outer.extent, join_style="mitre")
    return bool(shapely.covers(allowed, inner.region))


def _size(matrix: FloatArray) -> float:
    return float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))


def _scaled(root: ET.Element, factor: float) -> ET.Element:
    """A clean drawing whose lines are all ``factor`` times as wide."""
    drawing = copy.deepcopy(root)
    for element in drawing.iter():
        stated = _NUMBER.match(element.get(_WIDTH, ""))
        if stated is not None:
            unit = element.attrib[_WIDTH][stated.end() :]
            element.set(_WIDTH, f"{float(stated[1]) * factor!r}{unit}")
    # Where none is stated, a line is one unit wide.
    drawing.attrib.setdefault(_WIDTH, repr(factor))
    return drawing
