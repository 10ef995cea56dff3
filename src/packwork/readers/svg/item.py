"""SVG files to items: filters that paint beyond their shapes removed, arcs in short pieces.

Most programs draw a quarter of a circle as one cubic, which bulges by 2.7e-4 of the
radius: far more than the gaps that are checked. Shorter arcs have no such choice.
"""

from __future__ import annotations

import copy
import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.readers.budget.expansion import count_expanded
from packwork.readers.budget.rendering import FILTER, drop_filters
from packwork.readers.cache import read_once
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.options import ReadOptions
from packwork.readers.pages import PageFate, Read, with_pages_alike
from packwork.readers.reading import UnfitError, notice, one_budget, read_bytes, reading_file, stem
from packwork.readers.regions import Holes, centred, clean_union
from packwork.readers.svg.art import FILTERED, vector_art, whole_reach, within_outline
from packwork.readers.svg.drawing import LARGESSE, WHOLE_PAGE, PaintedDrawing, read_drawing
from packwork.readers.svg.ink import TracedInk
from packwork.readers.svg.resvg import SIDES_PX, excess, side_by_side
from packwork.readers.svg_syntax.coordinates import parse_length
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.readers.svg_syntax.shapes import shape_pieces
from packwork.scene.item import Item, VectorArt

PIECES = 10
"""Arcs that make a whole ellipse. As one cubic, each is within 1.2e-6 of the radius; the
error goes with the sixth power, the file's size with the first. Derived."""

PRECISION = 1e-7
"""Last digit of a coordinate, as a share of the shape's size: below the arcs' error."""

_OWN = frozenset({"d", "cx", "cy", "r", "rx", "ry", "x", "y", "width", "height"})


def with_short_arcs(root: ET.Element) -> ET.Element:
    """Copy of a clean drawing in which whatever is round is made of short pieces.

    Shapes whose size is a share of the page keep their form, as do the paths of drawings
    with markers, which would gain corners to mark.

    >>> root = ET.fromstring('<svg><circle r="3" fill="red"/><rect width="2" height="2"/></svg>')
    >>> [shape.tag for shape in with_short_arcs(root)]
    ['path', 'rect']
    """
    drawing = copy.deepcopy(root)
    has_markers = any(element.tag == "marker" for element in drawing.iter())
    for element in drawing.iter():
        if any("%" in element.get(name, "") for name in _OWN):
            continue
        if element.tag in {"circle", "ellipse"}:
            _redraw(element, _oval(element))
        elif _has_corners(element) or (_has_arcs(element) and not has_markers):
            _redraw(element, _curves(shape_pieces(element, (0.0, 0.0))))
    return drawing


def _has_corners(element: ET.Element) -> bool:
    return element.tag == "rect" and not {"rx", "ry"}.isdisjoint(element.attrib)


def _has_arcs(element: ET.Element) -> bool:
    return element.tag == "path" and "a" in element.get("d", "").lower()


def _redraw(element: ET.Element, data: str) -> None:
    """Make a path of a shape, in place; one that does not show stays as it is."""
    if data:
        element.tag = "path"
        element.attrib = {k: v for k, v in element.attrib.items() if k not in _OWN} | {"d": data}


def _oval(element: ET.Element) -> str:
    cx, cy, r, rx, ry = (
        parse_length(element.get(name), 0.0) or 0.0 for name in ("cx", "cy", "r", "rx", "ry")
    )
    rx, ry = (r, r) if element.tag == "circle" else (rx or ry, ry or rx)
    if min(rx, ry) <= 0:
        return ""
    turns = 2 * math.pi * np.arange(PIECES) / PIECES
    points = np.column_stack([cx + rx * np.cos(turns), cy + ry * np.sin(turns)])
    digits = _digits(points)
    start, *ends = (_numbers(point, digits) for point in points)
    return f"M{start}" + "".join(f"A{rx:.9g} {ry:.9g} 0 0 1 {end}" for end in [*ends, start]) + "Z"


def _curves(pieces: Sequence[SubPath]) -> str:
    """Path data of lines and cubics, absolute."""
    points = [np.reshape([*piece.start, *piece.segments.flat], (-1, 2)) for piece in pieces]
    digits = _digits(np.concatenate([np.zeros((0, 2)), *points]))
    text = ""
    for piece in pieces:
        text += f"M{_numbers(np.array(piece.start), digits)}"
        text += "".join(_step(cubic, digits) for cubic in piece.segments)
        text += "Z" if piece.is_closed else ""
    return text


def _step(cubic: FloatArray, digits: int) -> str:
    # The handles of a straight line lie at its thirds but for rounding.
    is_line = np.abs(np.diff(cubic, n=2, axis=0)).max() <= 10.0**-digits
    return ("L" if is_line else "C") + _numbers(cubic[3 if is_line else 1 :], digits)


def _digits(points: FloatArray) -> int:
    """Digits after the point that a shape's points need."""
    size = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
    return max(0, math.ceil(-math.log10(PRECISION * size))) if size > 0 else 0


def _numbers(points: FloatArray, digits: int) -> str:
    # Adding nothing takes the sign off a zero.
    return " ".join(f"{round(value, digits) + 0.0:.12g}" for value in points.ravel().tolist())


MOST_GLOW = 0.02
"""What filters may add beyond the ink, as a share of it. Larger lets shadows fall on
neighbours, smaller takes the shading off drawings whose edges it softens. Tried."""


def without_glow(drawing: PaintedDrawing) -> ET.Element:
    """Tree of a drawing, its filters taken off if they paint beyond its ink, which is said."""
    root, ink = drawing.root, drawing.ink.whole
    if not any(FILTER in element.attrib for element in root.iter()):
        return root
    work = replace(drawing.work, layers=count_expanded(root)[1])
    side = work.side(SIDES_PX[0], work.page)
    work.spend(side, work.page)
    shown, drawn = side_by_side(ink, root, drawing.page, side)
    if not shown.any():
        raise UnfitError("paints nothing, for its filters hide every shape; save it without them")
    if excess(shown, drawn) <= MOST_GLOW:
        return root
    notice("its filters were left out, for they paint shadows or light beyond its shapes")
    plain = copy.deepcopy(root)
    drop_filters(plain)
    return plain


def read_svg(path: str | Path, holes: Holes = "fill", reading: ReadOptions | None = None) -> Read:
    """Item of an SVG file, its units CSS pixels (96 to the inch).

    Curves and round strokes are flattened to ``bezier.FLATTENING`` of the drawing's
    extent. Text, clips, masks and pictures are rendered and traced. A white page behind
    all else is left out, unless something on it touches its edges or it is to stay.
    """
    data, options = read_bytes(path, MAX_BYTES), reading or ReadOptions()
    read = _read(data, stem(path), str(path), holes, options, is_compared=True)
    if options.keep_page is not None:
        return replace(read, page=PageFate.NONE)

    def again() -> Item:
        kept = replace(options, keep_page=True)
        return _read(data, stem(path), str(path), holes, kept, is_compared=True).item

    return replace(read, again=again)


def item_of_svg(
    data: bytes,
    name: str,
    source: str,
    holes: Holes = "fill",
    reading: ReadOptions | None = None,
    *,
    is_compared: bool = False,
) -> Item:
    """Item of an SVG's bytes, compared with a rendering as strangers' files should be.

    >>> data = b'<svg><circle r="5" fill="none" stroke="red" stroke-width="2"/></svg>'
    >>> item = item_of_svg(data, "ring", "ring.svg")
    >>> len(item.outline.rings), len(item.ink.rings)
    (1, 2)
    """
    options = reading or ReadOptions()
    return with_pages_alike([_read(data, name, source, holes, options, is_compared=is_compared)])[0]


def _read(
    data: bytes, name: str, source: str, holes: Holes, options: ReadOptions, *, is_compared: bool
) -> Read:
    def read() -> Read:
        return _read_anew(data, name, source, holes, options, is_compared=is_compared)

    return read_once(data, (holes, options, is_compared), name, source, read)


def _read_anew(
    data: bytes, name: str, source: str, holes: Holes, options: ReadOptions, *, is_compared: bool
) -> Read:
    with reading_file(source), one_budget(1.0 if is_compared else LARGESSE):
        drawing = read_drawing(
            data, is_compared=is_compared, is_on_paper=True, keep_page=options.keep_page,
            alpha_threshold=options.alpha_threshold,
        )  # fmt: skip
        outline, ink, place = centred(clean_union(drawing.ink.body), holes)
        if drawing.ink.body is not drawing.ink.whole:
            ink = Outline.from_region(clean_union(drawing.ink.whole)).mapped(place)
        art = _art(drawing, outline, place, is_checked=is_compared)
    item = Item(name, source, outline, ink, art)
    fate = drawing.sheet
    if fate is PageFate.NONE and drawing.page is not None:
        whole = drawing.page.width * drawing.page.height
        fate = PageFate.FILLED if outline.area >= WHOLE_PAGE * whole else fate
    return Read(item, source, fate)


def _art(
    drawing: PaintedDrawing, outline: Outline, place: FloatArray, *, is_checked: bool
) -> VectorArt:
    """Drawing that is written into files for an item: nothing beyond its outline."""
    root = with_short_arcs(without_glow(drawing))
    is_traced = isinstance(drawing.ink, TracedInk)

    def art(shown: ET.Element, is_cut: bool) -> VectorArt:
        made = vector_art(shown, drawing.page, is_cut=is_cut, place=place)
        return replace(made, is_traced=is_traced)

    is_cut = drawing.ink.is_cut
    first = art(root, is_cut)
    if not is_checked:
        return first
    # As it is, else as viewers show it by itself, else without its filters.
    ways = [is_cut] if is_cut or drawing.page is None else [False, True]

    def arts() -> Iterator[VectorArt]:
        yield first
        yield from (art(root, way) for way in ways[1:])
        if FILTERED in first.markup:
            plain = copy.deepcopy(root)
            drop_filters(plain)
            yield from (art(plain, way) for way in ways)

    found = within_outline(arts(), outline, whole_reach(drawing.shapes, place), drawing.work)
    if FILTERED in first.markup and FILTERED not in found.markup:
        notice("its filters were left out, for they paint beyond its outline")
    return found
