"""SVGs as drawings for a machine: the paths themselves, their curves as arcs, not what ink covers.

Thin lines without a fill are what is cut, as programs for laser cutters and plotters have it;
an SVG of filled shapes is one part, whose edges are the paths that lie on them.
"""

from __future__ import annotations

import contextlib
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path

import numpy as np
import shapely
from shapely.geometry import LinearRing, MultiPolygon, Polygon

from packwork.arrays import BoolArray, FloatArray
from packwork.geometry import affine
from packwork.geometry.arc_chains import arcs_through
from packwork.geometry.arcs import ArcLine, arcs_along, joined_lines, with_longest_arcs
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import symmetric_difference, valid
from packwork.geometry.polygon import polygon_parts, signed_area
from packwork.readers.dxf.entities import CURVES, CadDrawing, CadLine
from packwork.readers.dxf.item import (
    ART_DIGITS,
    cad_part,
    cad_parts,
    engraved_in,
    items_of,
    line_art,
    tell_left_out,
)
from packwork.readers.dxf.item import ENGRAVED as ENGRAVED_LAYER
from packwork.readers.dxf.rings import Ring, RingPart, rings_of
from packwork.readers.engraving import Engraving, rgb_of
from packwork.readers.gate.door import MAX_BYTES, parse_xml, serialised, unpacked
from packwork.readers.pages import Read
from packwork.readers.reading import UnfitError, notice, one_budget, read_bytes, reading_file, stem
from packwork.readers.regions import Holes, centred, clean_union, thin_px
from packwork.readers.svg.container import name_of, stated_unit, tag_of
from packwork.readers.svg.drawing import PaintedDrawing, read_drawing
from packwork.readers.svg.ink import PaintedInk
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg_syntax.painted import Painted, drawing_box
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.scene.item import Item, VectorArt
from packwork.scene.line_art import LineArt
from packwork.scene.notation import arc_path_data, cubic_path_data, decimals
from packwork.units import convert

CURVES_PX = convert(5e-4, "mm", "px")
"""Largest distance of a curve from the arcs that stand for it, and again of these from longer ones.
Larger shows in what is cut, smaller makes a machine stutter. Chosen: half a micrometre."""

ALONG = 1e-6
"""Largest distance of a union's corners from its arcs, as a share of the drawing's size. Larger is
seen in small drawings, smaller makes many arcs. Tried: areas of icons come out to 1e-6."""

MOST_CURVES = 40_000
"""Curves of a drawing that are followed, each by some tens of arcs. Chosen."""

_UP = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])

ENGRAVED = "engrave"
"""Layer of what is not cut through."""

_MARK = 0.734375
"""Dash, px, by which what lies on a layer to engrave is told. Chosen, as one that nobody draws."""

_PX_MM = convert(1.0, "px", "mm")


def read_line_drawing(path: str | Path, holes: Holes, engraving: Engraving) -> list[Read]:
    """Parts of an SVG file, in px, their true curves beside what shows them.

    Raises
    ------
    ReadError
        If it cannot be read; of lines alone, if an outline is open, crosses itself or another.
    """
    data, name = read_bytes(path, MAX_BYTES), stem(path)
    with reading_file(str(path)), one_budget():
        data = _with_engraved_layers(data, engraving)
        drawing = read_drawing(data, is_on_paper=True)
        engraving.stated[str(path)] = stated_unit(drawing.root) is not None
        is_plain = isinstance(drawing.ink, PaintedInk) and not any(
            shape.clips for shape in drawing.shapes
        )
        if is_plain and sum(map(_curves, drawing.shapes)) > MOST_CURVES:
            notice(f"has more than {MOST_CURVES:,} curves; what its paint covers is cut")
            is_plain = False
        engraved = [
            shape for shape in drawing.shapes
            if engraving.holds(_paint_of(shape)) or _MARK in shape.painting.pen.dashes
        ]  # fmt: skip
        if is_plain and (lines := _lines_to_cut(drawing, engraved)) is not None:
            return items_of(cad_parts(lines), name, str(path), holes)
        marks = [line for shape in engraved for line in _cad_lines(shape, drawing, ENGRAVED, _UP)]
        bodies = [
            shape for shape in engraved
            if shape.painting.has_fill and shape.painting.has_stroke
            and _MARK not in shape.painting.pen.dashes and not engraving.holds(shape.painting.fill)
        ]  # fmt: skip
        if engraved and len(engraved) == len(drawing.shapes) and not bodies:
            raise UnfitError(
                "is engraved all over, by the colours or layers of all that it shows; give the "
                "outline that is to be cut another one"
            )
        if is_plain and (filled := _without_lines(drawing, engraved, bodies)) is not None:
            drawing = read_drawing(filled, is_on_paper=True)
            data = filled
    item = item_of_svg(data, name, str(path), holes, is_compared=True)
    with reading_file(str(path)):
        if is_plain and isinstance(item.art, VectorArt) and not item.art.is_traced:
            item = _with_true_curves(item, item.art, drawing, marks, holes)
        elif engraved:
            notice("what is to be engraved cannot be told apart; make curves of text, and release "
                   "clips and masks")  # fmt: skip
    return [Read(item, str(path))]


def _with_engraved_layers(data: bytes, engraving: Engraving) -> bytes:
    """Document all of whose layers to engrave, by their names, has ``_MARK`` for a dash.

    Names of layers do not come through the gate.
    """
    plain = unpacked(data)
    # Other encodings and references to characters might hide a name.
    may_hide = b"\0" in plain or b"&" in plain or bool(engraving.wanted)
    if not may_hide and not ENGRAVED_LAYER.search(plain.decode("utf-8", "replace")):
        return data
    root = parse_xml(plain)
    groups = [
        one for one in root.iter() if tag_of(one) == "g" and (name := name_of(one))
        and (engraving.holds("", name) or ENGRAVED_LAYER.search(name))
    ]  # fmt: skip
    for element in chain.from_iterable(group.iter() for group in groups):
        # A style that is important outdoes sheets and what is inherited.
        style = f"{element.get('style', '')};stroke-dasharray:{_MARK}!important"
        element.set("style", style.lstrip(";"))
    return ET.tostring(root) if groups else data


def _lines_to_cut(drawing: PaintedDrawing, engraved: Sequence[Painted]) -> CadDrawing | None:
    """Thin lines of a drawing, and what goes with them to be engraved; None without a thin line."""
    extent, marked = _extent(drawing), set(engraved)
    is_line = [shape not in marked and _is_thin(shape, extent) for shape in drawing.shapes]
    if not any(
        one and not shape.painting.has_fill
        for one, shape in zip(is_line, drawing.shapes, strict=True)
    ):
        return None
    # In mm from the page's lower left corner.
    height = 0.0 if drawing.page is None else drawing.page.height
    up = _PX_MM * np.array([[1.0, 0.0, 0.0], [0.0, -1.0, height]])
    found, colours = list[CadLine](), Counter[str]()
    for shape, is_cut in zip(drawing.shapes, is_line, strict=True):
        # A dashed line is folded or scored.
        is_cut = is_cut and not shape.painting.pen.dashes
        layer = _paint_of(shape) if is_cut else ENGRAVED
        colours[layer] += is_cut
        lines = _cad_lines(shape, drawing, layer, up)
        found += [replace(one, page_height=_PX_MM * height) for one in lines]
    if len(+colours) > 1:
        told = ", ".join(f"{colour} ({count})" for colour, count in colours.most_common() if count)
        notice(f"has lines in several colours: {told}; outlines of all are cut, but for colours "
               "that are given as --engrave 'COLOUR'")  # fmt: skip
    return CadDrawing(tuple(found), Counter(), 1.0, None)


def _cad_lines(
    shape: Painted, drawing: PaintedDrawing, layer: str, matrix: FloatArray
) -> list[CadLine]:
    """Lines of a shape on a layer, mapped from px."""
    kind, colour = str(shape.element.tag), _paint_of(shape)
    return [
        CadLine(line.mapped(matrix, 0.0), layer, kind, colour)
        for line in _arc_lines(shape, _extent(drawing))
    ]


def _paint_of(shape: Painted) -> str:
    """Colour of a shape's line, else of its inside."""
    painting = shape.painting
    paint = painting.stroke if painting.has_stroke else painting.fill
    return painting.color if paint.lower() == "currentcolor" else paint


def _paints(shape: Painted) -> Iterator[object]:
    painting = shape.painting
    for is_there, paint in (
        (painting.has_fill, painting.fill), (painting.has_stroke, painting.stroke)
    ):  # fmt: skip
        if is_there:
            text = painting.color if paint.lower() == "currentcolor" else paint
            yield rgb_of(text) or text


def _extent(drawing: PaintedDrawing) -> float:
    """Longer side of a drawing's box in px."""
    left, top, right, bottom = drawing_box(drawing.shapes) or (0.0, 0.0, 0.0, 0.0)
    return max(right - left, bottom - top)


def _curves(shape: Painted) -> int:
    return sum(int(_is_bent(piece.segments, 0.0).sum()) for piece in shape.pieces)


def _is_bent(cubics: FloatArray, least: float) -> BoolArray:
    # The handles of a straight line lie at its thirds but for rounding.
    bends = np.abs(np.diff(cubics, n=2, axis=1)).max(axis=(1, 2), initial=0.0)
    return np.asarray(
        bends > np.maximum(least, 1e-9 * np.abs(cubics).max(axis=(1, 2), initial=0.0))
    )


def _is_thin(shape: Painted, extent: float) -> bool:
    """Whether a shape of a drawing of an extent in px has a line that counts as one of no width."""
    scale = abs(float(np.linalg.det(shape.matrix[:, :2]))) ** 0.5
    return shape.painting.has_stroke and shape.painting.pen.width * scale <= thin_px(extent)


def _arc_lines(shape: Painted, extent: float) -> Iterator[ArcLine]:
    """Pieces of a shape in px; those that are filled are closed."""
    is_filled = shape.painting.has_fill and not shape.painting.has_stroke
    for piece in shape.pieces:
        if len(piece.segments):
            tolerance = max(CURVES_PX, CURVES * extent)
            yield arc_line(piece.placed(shape.matrix), tolerance, is_filled=is_filled)


def arc_line(piece: SubPath, tolerance: float, *, is_filled: bool = False) -> ArcLine:
    """A piece of a path with arcs for its curves, within twice a tolerance.

    ``is_filled``: whether it is closed though its path is not.

    Examples
    --------
    >>> from packwork.readers.svg_syntax.path_data import parse_path
    >>> slot, = parse_path("M0 0h9a4 4 0 0 1 0 8h-9z")
    >>> arc_line(slot, 1e-4).bulges.round(5).tolist()
    [0.0, 1.0, 0.0, 0.0]
    """
    cubics = piece.segments
    is_bent = _is_bent(cubics, 1e-3 * tolerance)
    runs = np.split(np.arange(len(cubics)), np.flatnonzero(np.diff(is_bent)) + 1)
    line = joined_lines(
        [_arcs_of(cubics[run], tolerance) if is_bent[run[0]] else _straight(cubics[run])
         for run in runs], is_closed=False,
    )  # fmt: skip
    points, bulges = line.points, line.bulges
    gap = float(np.hypot(*(points[-1] - points[0])))
    if piece.is_closed or is_filled or gap <= tolerance:
        kept = slice(None, -1) if gap <= tolerance else slice(None)
        line = ArcLine(points[kept], bulges[kept], is_closed=True)
    return with_longest_arcs(line, tolerance) if line.bulges.any() else line


def _straight(cubics: FloatArray) -> ArcLine:
    return ArcLine(np.vstack([cubics[:, 0], cubics[-1:, 3]]), np.zeros(len(cubics) + 1))


def _arcs_of(cubics: FloatArray, tolerance: float) -> ArcLine:
    """Arcs within a tolerance of cubics end to end ``(k, 4, 2)``."""
    slopes = 3.0 * np.diff(cubics, axis=1)

    def curve(t: FloatArray) -> tuple[FloatArray, FloatArray]:
        at = np.clip(t.astype(np.int64), 0, len(cubics) - 1)
        u = (t - at)[:, None]
        v = 1.0 - u
        p, d = np.moveaxis(cubics[at], 1, 0), np.moveaxis(slopes[at], 1, 0)
        points = v**3 * p[0] + 3 * v * v * u * p[1] + 3 * v * u * u * p[2] + u**3 * p[3]
        return points, v * v * d[0] + 2 * v * u * d[1] + u * u * d[2]

    return arcs_along(curve, np.arange(len(cubics) + 1.0), tolerance)


def _without_lines(
    drawing: PaintedDrawing, engraved: Sequence[Painted], bodies: Sequence[Painted]
) -> bytes | None:
    """The same drawing without what is engraved and thin lines; None if there are none.

    ``bodies``: those whose line alone is engraved.
    """
    extent = _extent(drawing)
    lined = [shape.element for shape in drawing.shapes if _is_thin(shape, extent)]
    for element in lined:
        element.set("stroke", "none")
    for shape in engraved:
        shape.element.attrib |= {"stroke": "none", **({} if shape in bodies else {"fill": "none"})}
    return serialised(drawing.root).encode() if lined or engraved else None


def _with_true_curves(
    item: Item, art: VectorArt, drawing: PaintedDrawing, marks: Sequence[CadLine], holes: Holes
) -> Item:
    """Item whose edges are the paths that lie on them, with straight sides where none does."""
    extent, drawn = _extent(drawing), clean_union(drawing.ink.body)
    known = dict(
        pair for one in drawing.shapes if one.painting.has_fill for pair in _rings(one, extent)
    )
    slack, left_out = 3.0 * FLATTENING * extent, Counter[str]()
    rings = [
        RingPart(_ring_at(polygon.exterior, [*known], slack, extent),
                 tuple(_ring_at(ring, [*known], slack, extent) for ring in polygon.interiors))
        for polygon in polygon_parts(drawn)
    ]  # fmt: skip
    parts = [
        cad_part(part, own, _UP, within=False)
        for part, own in zip(rings, engraved_in(rings, marks, [], left_out), strict=True)
    ]
    tell_left_out(left_out)
    whole = valid(MultiPolygon([one for part in parts for one in polygon_parts(part.region)]))
    outline, ink, move = centred(whole, holes)
    to_px = affine.compose(affine.inverse(centred(drawn, holes)[2]), art.matrix)
    back = affine.inverse(to_px)
    cut, engraved = (
        tuple(line.mapped(back, CURVES_PX) for part in parts for line in getattr(part, name))
        for name in ("cut", "engraved")
    )
    digits = decimals(ART_DIGITS * extent * float(np.linalg.norm(back[:, :2], 2)))
    path = "".join(
        cubic_path_data(known[ring].placed(back).segments, digits) if ring in known
        else arc_path_data(ring.line.mapped(affine.compose(back, _UP), 0.0), digits)
        for part in rings for ring in (part.outer, *part.holes)
    )  # fmt: skip
    colours = {colour for one in drawing.shapes for colour in _paints(one)}
    lines = LineArt(art.markup, affine.compose(move, to_px), cut=cut, path=path,
                    is_painted=len(colours) > 1 and not engraved)  # fmt: skip
    if engraved:
        region = shapely.transform(drawn, lambda points: affine.apply(back, points))
        pixel = float(np.linalg.norm(back[:, :2], 2))
        shown = line_art(cut, engraved, pixel * extent, region, pixel)
        lines = replace(shown, matrix=lines.matrix, path=path)
    return Item(item.name, item.source, outline, ink, lines)


def _rings(shape: Painted, extent: float) -> Iterator[tuple[Ring, SubPath]]:
    """Rings of a filled shape that do not cross themselves, px, y up, and their paths, y down."""
    pieces = (piece for piece in shape.pieces if len(piece.segments))
    for line, piece in zip(_arc_lines(shape, extent), pieces, strict=True):
        with contextlib.suppress(UnfitError):
            found = rings_of([CadLine(line.mapped(_UP, 0.0), "", str(shape.element.tag))])[0]
            yield from ((ring, piece.placed(shape.matrix)) for ring in found)


def _ring_at(edge: LinearRing, known: Sequence[Ring], slack: float, extent: float) -> Ring:
    """The ring that lies on an edge, px, y down; else arcs through its corners."""
    points = affine.apply(_UP, shapely.get_coordinates(edge)[:-1])
    polygon = Polygon(points)
    bounds, most = np.array(polygon.bounds), slack * polygon.length
    for ring in known:
        is_near = (np.abs(bounds - ring.polygon.bounds) <= slack).all()
        if is_near and symmetric_difference(polygon, ring.polygon).area <= most:
            return ring
    points = points if signed_area(points) > 0 else points[::-1]
    line = arcs_through(points, min(CURVES_PX, ALONG * extent), 2.0 * FLATTENING * extent)
    return Ring(line, "", "edge", polygon)
