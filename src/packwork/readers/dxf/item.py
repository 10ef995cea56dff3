"""DXF files to items, one for each outline that lies in no other, and to containers.

Lines to engrave, and open ones, travel with the part that they lie in. Outlines with straight sides
lie around the true curves, by ``bezier.FLATTENING`` of the part's size at most; the curves are kept
in the item's art, as arcs.
"""

from __future__ import annotations

import math
import re
import shlex
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import shapely
from shapely.geometry import LineString, Polygon

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.arcs import ArcLine
from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import buffered, intersection, union, valid
from packwork.geometry.polygon import Region, polygon_parts
from packwork.phrasing import number_of
from packwork.readers.dxf.entities import (
    MAX_DXF_BYTES,
    CadDrawing,
    CadLine,
    read_drawing,
)
from packwork.readers.dxf.rings import Ring, RingPart, called, nested, place, rings_of
from packwork.readers.engraving import Engraving
from packwork.readers.pages import Read
from packwork.readers.reading import UnfitError, notice, one_budget, read_bytes, reading_file, stem
from packwork.readers.regions import Holes, centred
from packwork.scene.container import Container, placed_container
from packwork.scene.item import Item
from packwork.scene.line_art import EngravedLine, LineArt
from packwork.scene.notation import arc_path_data, decimals
from packwork.units import convert

MOST_ITEMS = 2_000
"""Parts of one file. Chosen: as many as lie on a sheet."""

ENGRAVED = re.compile(r"engrav|etch|grav|mark|text|score|raster|scribe", re.IGNORECASE)
"""Names of layers of what is not cut through."""

IGNORED = re.compile(r"constr|dimension|guide|\bdims?\b|border|title", re.IGNORECASE)
"""Names of layers of what is no part of a piece."""

FRAME = re.compile(
    r"(?<![^\W\d_])(frame|rahmen|cadre|cornice|marco|ramka)(?![^\W\d_])", re.IGNORECASE
)
"""Names of layers of what a sheet is drawn with: whole words, with digits, or lines, about them."""

LEAST_FRAMED = 3
"""Rings, one in another, from which what a frame is around is parts: one, with two, may be the
window of a part and what falls out of it. Chosen."""

OURS = {"container", "room"}
"""Layers of the sheet in drawings that we wrote."""

_TEXTS = {"TEXT", "MTEXT", "HATCH", "ATTDEF", "ATTRIB"}

LEAST_MM, MOST_MM = 1e-3, 1e6
"""Sizes of a part beyond which its unit is a mistake. Chosen."""

FILL, INK = "#8fb48c", "#20302a"
"""Colours of a part, and of what is engraved on it, on screen. Chosen by eye."""

ENGRAVED_PX = 1.0
"""Width of an engraved line on screen: a quarter of a millimetre. Chosen by eye."""

_THINNEST = 1 / 200
"""The same as a share of the part's size, at most."""

ART_DIGITS = 1e-8
"""Last digit of a path's coordinates, as a share of the part's size."""


def read_dxf(
    path: str | Path, holes: Holes = "fill", engraving: Engraving | None = None
) -> list[Read]:
    """Items of a DXF file, in px of its unit's true size; holes are those of a part's outline.

    Raises
    ------
    ReadError
        If it cannot be read, or an outline is open, crosses itself or another one.
    """
    with reading_file(str(path)), one_budget():
        parts = cad_parts(read_drawing(read_bytes(path, MAX_DXF_BYTES)), engraving)
        return items_of(parts, stem(path), str(path), holes)


def items_of(parts: Sequence[CadPart], name: str, source: str, holes: Holes) -> list[Read]:
    """Items of the parts of a drawing, numbered where there are several."""
    names = [name] if len(parts) == 1 else [f"{name} {k}" for k in range(1, len(parts) + 1)]
    return [
        Read(_item(part, called, source, holes), source)
        for part, called in zip(parts, names, strict=True)
    ]


@dataclass(frozen=True, eq=False)
class CadPart:
    """Lines to cut, the outer first, and to engrave: in px, y down, positive area but for holes."""

    cut: tuple[ArcLine, ...]
    engraved: tuple[EngravedLine, ...]
    region: Region


def container_of_dxf(data: bytes, name: str, source: str, side: float | None = None) -> Container:
    """Container of a DXF's bytes, its canvas the box of all outlines: in mm, or scaled to ``side``.

    Outlines lie within the true curves, so that what is laid inside them is inside these.
    """
    with reading_file(source), one_budget():
        regions = [part.region for part in cad_parts(read_drawing(data), within=True)]
        whole = regions[0] if len(regions) == 1 else shapely.MultiPolygon(
            [polygon for region in regions for polygon in polygon_parts(region)]
        )  # fmt: skip
        left, top, right, bottom = whole.bounds
        canvas = left, top, right - left, bottom - top
        own = convert(max(canvas[2:]), "px", "mm")
        placed = placed_container(name, source, whole, canvas, own if side is None else side)
    return replace(placed, unit="mm") if side is None else placed


def cad_parts(
    drawing: CadDrawing, engraving: Engraving | None = None, *, within: bool = False
) -> list[CadPart]:
    """Parts of a drawing, in the order of their outlines there.

    Their regions lie around what the lines enclose, or ``within`` it.
    """
    # Pixels of one unit of a drawing; where it states none, that is said.
    millimetres = drawing.millimetres
    if millimetres is None:
        is_inch = drawing.is_metric is False
        unit, millimetres = ("inches", 25.4) if is_inch else ("mm", 1.0)
        notice(f"states no unit; it is taken for {unit}")
    px = millimetres * convert(1.0, "mm", "px")
    left_out, engraving = Counter(drawing.left_out), engraving or Engraving()
    cut, engraved = list[CadLine](), list[CadLine]()
    for piece in drawing.pieces:
        if engraving.holds(piece.colour, piece.layer):
            engraved.append(piece)
        elif IGNORED.search(piece.layer) or piece.layer.casefold() in OURS:
            left_out[f"on layer {piece.layer[:40]!r}"] += 1
        else:
            (engraved if ENGRAVED.search(piece.layer) else cut).append(piece)
    rings, loose = rings_of(cut)
    parts, doubled = _nested_unframed(rings, left_out)
    if not parts:
        raise UnfitError(_why_none(cut, loose, engraved, left_out))
    if len(parts) > MOST_ITEMS:
        raise UnfitError(f"holds {len(parts):,} parts, {MOST_ITEMS:,} are the most")
    marks = [
        one if ENGRAVED.search(one.layer) or engraving.holds("", one.layer)
        else replace(one, layer="") for one in engraved
    ]  # fmt: skip
    marked = engraved_in(parts, marks, loose, left_out)
    if doubled:
        notice(f"{number_of(doubled, 'outline')} that lay on another was taken once")
    tell_left_out(left_out)
    flip = np.array([[px, 0.0, 0.0], [0.0, -px, 0.0]])
    return [
        cad_part(part, own, flip, within=within) for part, own in zip(parts, marked, strict=True)
    ]


def _nested_unframed(rings: list[Ring], left_out: Counter[str]) -> tuple[list[RingPart], int]:
    """Parts of rings, as :func:`nested`, without the frame of a sheet.

    Rings of a layer of frames are one if each is drawn around all others, and these are parts with
    holes. Plain rings in it may be the holes of a part: then it is one, and that is told.
    """
    frames = [ring for ring in rings if FRAME.search(ring.layer)]
    others = [ring for ring in rings if not FRAME.search(ring.layer)]
    if not others or not frames:
        return nested(rings)
    inner = union(shapely.box(*ring.polygon.bounds) for ring in others)
    if not all(ring.polygon.covers(inner) for ring in frames):
        return nested(rings)
    parts, doubled = nested(others)
    holes = sum(len(part.holes) for part in parts)
    if not holes or holes + len(parts) < LEAST_FRAMED:
        for name in dict.fromkeys(ring.layer[:40] for ring in frames):
            notice(f"layer {name!r}: the outline around all else is taken for a part's; if it is "
                   "the frame of the sheet, call its layer border")  # fmt: skip
        return nested(rings)
    for ring in frames:
        name = repr(ring.layer[:40])
        left_out[f"around all else on layer {name} (a frame; another layer's name keeps it)"] += 1
    return parts, doubled


def tell_left_out(left_out: Counter[str]) -> None:
    """Count what is neither cut nor engraved, in a line."""
    if left_out:
        told = ", ".join(f"{count} {kind}" for kind, count in sorted(left_out.items()))
        is_text = not _TEXTS.isdisjoint(left_out)
        hint = "; text and hatches have to be made curves to be engraved" if is_text else ""
        notice(f"left out: {told}{hint}")


def _why_none(
    cut: Sequence[CadLine],
    loose: Sequence[CadLine],
    engraved: Sequence[CadLine],
    left_out: Counter[str],
) -> str:
    if loose:
        return _open_at(loose, loose[0])
    if engraved and not cut:
        said = dict.fromkeys(f"layer {one.layer[:40]!r} in {one.colour}" for one in engraved)
        where = ", ".join([*said][:4])
        return (
            f"has lines to engrave alone, on {where}; the outline that is to be cut wants another "
            "layer or colour"
        )
    if cut:
        first = cut[0]
        return (
            f"{called(first)} at {place(first.line.points[0], first.page_height)} has no "
            "area, and there is no other outline"
        )
    others = ", ".join(f"{count} {kind}" for kind, count in sorted(left_out.items()))
    return f"holds no outline{f', but {others}' if others else ''}; export lines and curves"


def _open_at(loose: Sequence[CadLine], piece: CadLine) -> str:
    ends = np.concatenate([[one.line.points[0], one.line.points[-1]] for one in loose])
    own = np.array([piece.line.points[0], piece.line.points[-1]])
    # Takes a quarter of a second to load, and most runs read no DXF.
    from scipy.spatial import KDTree

    gaps = KDTree(ends).query(own, k=min(3, len(ends)))[0]
    # The nearest of those is the end itself; what it meets is no gap.
    free = max(range(2), key=lambda k: gaps[k][1])
    height = piece.page_height
    away = f"{gaps[free][1]:.3g}{'' if height is None else ' mm'}"
    name = piece.layer if height is None else piece.colour
    return (
        f"{called(piece)} at {place(own[free], height)} is open; the next end is {away} away; "
        f"close it, or engrave it: --engrave {shlex.quote(name[:40])}"
    )


def engraved_in(
    parts: Sequence[RingPart],
    engraved: Sequence[CadLine],
    loose: Sequence[CadLine],
    left_out: Counter[str],
) -> list[list[EngravedLine]]:
    """Lines that go with each part; what lies beyond its edges is cut off."""
    regions = [
        Polygon(part.outer.polygon.exterior, [hole.polygon.exterior for hole in part.holes])
        for part in parts
    ]
    # By its own size: a small part next to a large one has no more room about it.
    slacks = [
        FLATTENING * float(np.ptp(shapely.get_coordinates(one), axis=0).max()) for one in regions
    ]
    tree = shapely.STRtree(regions)
    found: list[list[EngravedLine]] = [[] for _ in parts]
    every = (*engraved, *(replace(one, layer="") for one in loose))
    for number, piece in enumerate(every, start=-len(engraved)):
        coarse = _drawn(piece.line, max(slacks))
        around = tree.query(coarse, predicate="dwithin", distance=3 * max(slacks))
        fine = {int(k): _drawn(piece.line, slacks[k]) for k in around}
        near = [k for k, line in fine.items() if line.dwithin(regions[k], slacks[k])]
        inside = [k for k in near if buffered(regions[k], 2 * slacks[k]).covers(fine[k])]
        if inside:
            found[inside[0]].append(_mark(piece.line, piece))
        elif number >= 0:
            raise UnfitError(_open_at(loose, loose[number]))
        elif not near:
            left_out["to engrave beside all parts"] += 1
        else:
            left_out["engraved beyond an edge"] += 1
            for k in near:
                found[k] += [_mark(part, piece) for part in _inside(fine[k], regions[k])]
    if loose:
        notice(f"{number_of(len(loose), 'open line')} inside parts will be engraved")
    return found


def _drawn(line: ArcLine, tolerance: float) -> LineString:
    points = line.flattened(tolerance)
    return LineString(np.vstack([points, points[:1]]) if line.is_closed else points)


def _mark(line: ArcLine, piece: CadLine) -> EngravedLine:
    return EngravedLine(line.points, line.bulges, line.is_closed, piece.colour, piece.layer)


def _inside(line: LineString, region: Polygon) -> Iterator[ArcLine]:
    for part in shapely.get_parts(intersection(line, region)):
        points = shapely.get_coordinates(part)
        if len(points) > 1:
            yield ArcLine(points, np.zeros(len(points)))


def cad_part(
    part: RingPart, engraved: Iterable[EngravedLine], flip: FloatArray, *, within: bool
) -> CadPart:
    """Lines in px; a map that mirrors makes an outer ring run the other way."""
    outer = part.outer.line.mapped(flip, math.inf).reversed()
    holes = [hole.line.mapped(flip, math.inf) for hole in part.holes]
    size = float(np.ptp(shapely.get_coordinates(part.outer.polygon), axis=0).max()) * flip[0, 0]
    millimetres = convert(size, "px", "mm")
    if not LEAST_MM <= millimetres <= MOST_MM:
        ring = part.outer
        name = called(ring) if ring.layer else f"the {ring.kind}"
        raise UnfitError(
            f"{name} at {place(ring.line.points[0], ring.page_height)} is a part of "
            f"{millimetres:.3g} mm; take it out, or state the drawing's true unit"
        )
    tolerance = FLATTENING * size
    # Seen the other way, what is outside a line is inside.
    seen = [line.reversed() if within else line for line in (outer, *holes)]
    shell, *inner = (line.flattened(tolerance, around=True) for line in seen)
    region = Polygon(shell, inner)
    return CadPart(
        (outer, *holes), tuple(line.mapped(flip, math.inf) for line in engraved),
        region if region.is_valid else valid(region),
    )  # fmt: skip


def _item(part: CadPart, name: str, source: str, holes: Holes) -> Item:
    outline, ink, move = centred(part.region, holes)
    cut = tuple(line.mapped(move, math.inf) for line in part.cut)
    engraved = tuple(line.mapped(move, math.inf) for line in part.engraved)
    return Item(name, source, outline, ink, line_art(cut, engraved, outline.extent, ink.region))


def line_art(
    cut: tuple[ArcLine, ...],
    engraved: tuple[EngravedLine, ...],
    size: float,
    region: Region,
    pixel: float = 1.0,
) -> LineArt:
    """Lines and the markup that shows them on their region, in units of which a px is so long."""
    digits = decimals(ART_DIGITS * size)
    path = "".join(arc_path_data(line, digits) for line in cut)
    markup = f'<path fill="{FILL}" fill-rule="evenodd" d="{path}"/>'
    width = min(ENGRAVED_PX * pixel, _THINNEST * size)
    # Away from all edges by its width, so that it adds nothing to what is measured.
    room = buffered(region, -width)
    shown = defaultdict[str, str](str)
    for line in engraved:
        shown[line.own_colour or INK] += "".join(_shown(line, room, width, digits))
    for colour, path in shown.items():
        if path:
            markup += (
                f'<path fill="none" stroke="{colour}" stroke-width="{width:.6g}" '
                f'stroke-linejoin="round" d="{path}"/>'
            )
    return LineArt(markup, affine.identity(), cut=cut, engraved=engraved)


def _shown(line: ArcLine, room: Region, width: float, digits: int) -> Iterator[str]:
    """Paths of an engraved line where it lies in a region."""
    whole = _drawn(line, width / 10)
    if room.contains(whole):
        yield arc_path_data(line, digits)
    else:
        for part in _inside(whole, room):
            yield arc_path_data(part, digits)
