"""SVGs to containers: what the drawing covers on its page, white over darker paint as holes."""

from __future__ import annotations

import copy
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
import shapely

from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import difference, intersection, union
from packwork.geometry.polygon import Region, polygon_parts
from packwork.progress import Stop, never
from packwork.readers.gate.door import parse_xml, unpacked
from packwork.readers.options import AS_DRAWN, ReadOptions
from packwork.readers.pictures.decode import decode_picture
from packwork.readers.pictures.mask import mask_of_pixels
from packwork.readers.pictures.silhouette import LEAST_WHITE
from packwork.readers.reading import (
    TooRichError,
    UnfitError,
    notice,
    one_budget,
    reading_file,
    spend,
)
from packwork.readers.regions import canvas_box, clean_union, tell_if_full, within_lines
from packwork.readers.svg.drawing import (
    LARGESSE,
    WHOLE_PAGE,
    PaintedDrawing,
    is_near_white,
    read_drawing,
)
from packwork.readers.svg.ink import Follower, Ink, TracedInk
from packwork.readers.svg.resvg import TRACE_PX, page_picture
from packwork.readers.svg_syntax.coordinates import Page
from packwork.readers.svg_syntax.painted import Painted, drawing_box, opacity
from packwork.scene.container import Container, placed_container
from packwork.units import DEFAULT_SIDE, Unit, as_unit, convert, split_length

MOST_WHITES = 2_000
"""White shapes whose place among the others is looked at; more are passed over. Chosen."""

Tell: TypeAlias = Callable[[str], object]

_HALF = 0.5
_SPECIAL = frozenset({"mask", "filter"})


@dataclass(frozen=True, eq=False)
class _Layer:
    """Region, in CSS pixels, that one shape paints in one colour."""

    region: Region
    is_white: bool


def without_whites(drawing: PaintedDrawing, region: Region) -> Region:
    """Region of a drawing less what white paint covers of dark fills below it.

    White on nothing counts, as a panda's face does and a drawing in white alone; so does what
    is painted over in turn.
    """
    holes = [hole for hole in _holes(drawing) if hole.area > 0]
    return difference(region, union(holes)) if holes else region


def _holes(drawing: PaintedDrawing) -> Iterator[Region]:
    shapes, box = drawing.shapes, drawing_box(drawing.shapes)
    whites = sum(map(_is_white, shapes))
    if box is None or not 0 < whites <= MOST_WHITES:
        return
    follower = Follower(max(box[2] - box[0], box[3] - box[1]), FLATTENING)
    layers = list(_layers(shapes, drawing.root, follower))
    dark = [k for k, layer in enumerate(layers) if not layer.is_white]
    tree = shapely.STRtree([layers[k].region for k in dark])
    for k, layer in enumerate(layers):
        if not layer.is_white:
            continue
        near = [dark[i] for i in tree.query(layer.region, "intersects")]
        below = [layers[i].region for i in near if i < k]
        if below:
            above = union([layers[i].region for i in near if i > k])
            hole = intersection(layer.region, union(below))
            yield difference(hole, above)


def _layers(shapes: Sequence[Painted], root: ET.Element, follower: Follower) -> Iterator[_Layer]:
    """Fills in their order, and strokes where they are white; dark lines hide nothing."""
    parents = {child: parent for parent in root.iter() for child in parent}
    for shape in shapes:
        painting = shape.painting
        is_plain = _opacity(shape.element, parents) >= _HALF
        if painting.has_fill:
            is_white = is_near_white(_fill(shape))
            if not is_white or (is_plain and painting.fill_opacity >= _HALF):
                yield _Layer(follower.fill(shape), is_white)
        is_seen = is_plain and painting.stroke_opacity >= _HALF
        if painting.has_stroke and is_seen and is_near_white(_stroke(shape)):
            yield _Layer(follower.stroke(shape), True)


def _opacity(element: ET.Element, parents: dict[ET.Element, ET.Element]) -> float:
    """Opacity of an element in all that it stands in; 0 where a mask or a filter decides."""
    product, one = 1.0, element
    while True:
        if _SPECIAL & one.attrib.keys():
            return 0.0
        product *= opacity(one.get("opacity"), 1.0)
        if one not in parents:
            return product
        one = parents[one]


def _is_white(shape: Painted) -> bool:
    """Whether its fill or its line is painted white."""
    return is_near_white(_fill(shape)) or is_near_white(_stroke(shape))


def _fill(shape: Painted) -> str:
    return _plain(shape.painting.fill, shape)


def _stroke(shape: Painted) -> str:
    return _plain(shape.painting.stroke, shape)


def _plain(paint: str, shape: Painted) -> str:
    return shape.painting.color if paint.strip().lower() == "currentcolor" else paint


_WHY_FULL = (
    "all that is painted counts; take out the sheet behind the shape, or say page for the whole "
    "sheet"
)

TOLD_WHITE = 0.1
"""Share of a drawing that its white holes take from which they are told. Larger is silent about
a white dress, smaller speaks of every eye. Chosen."""


def container_of_svg(
    data: bytes,
    name: str,
    source: str,
    side: float | None = None,
    reading: ReadOptions = AS_DRAWN,
) -> Container:
    """Container of an SVG's bytes, its canvas the page, scaled to ``side``.

    Without a side a page in mm, cm, in or pt keeps its size and unit; any other becomes
    600 px long.

    Filled shapes count, with their holes and parts, and of shapes drawn as lines the inside,
    as ``within_lines`` has it; nearly white paint over dark fills is a hole. Where that is the
    whole page, as with a sheet behind the drawing, its picture is taken for a mask, dark inside.
    Without a page the canvas is the region's box; with one, as ``canvas_box`` has it.

    >>> data = b'<svg width="4cm" viewBox="0 0 20 10"><rect width="10" height="10"/></svg>'
    >>> container = container_of_svg(data, "half", "half.svg")
    >>> container.width, container.height, container.unit
    (4.0, 2.0, 'cm')
    """
    with reading_file(source):
        drawing = read_drawing(data, alpha_threshold=reading.alpha_threshold)
        region = _inside(drawing.ink)
        unit = stated_unit(drawing.root) if side is None else None
        left, top, right, bottom = region.bounds
        canvas = (left, top, right - left, bottom - top)
        if drawing.page is not None:
            page = drawing.page.width, drawing.page.height
            if region.area > WHOLE_PAGE * page[0] * page[1]:
                region = _dark_part(drawing.root, drawing.page)
            else:
                region = _without_whites(drawing, region)
                tell_if_full(region.area / (page[0] * page[1]), _WHY_FULL)
            canvas = canvas_box(region.bounds, page, reading.trim, unit)
        if unit is not None:
            side = convert(max(canvas[2:]), "px", unit)
        placed = placed_container(name, source, region, canvas, side or DEFAULT_SIDE)
        return placed if unit is None else replace(placed, unit=unit)


def inside_of_svg(data: bytes) -> Region:
    """Region of an SVG without a page, in CSS pixels: shapes, and the inside of lines.

    >>> inside_of_svg(b'<svg><path fill="none" stroke="red" d="M1 1h4v4h-4z"/></svg>').bounds
    (0.5, 0.5, 5.5, 5.5)
    """
    drawing = read_drawing(data)
    return _without_whites(drawing, _inside(drawing.ink))


def parts_of_svg(
    data: bytes, container: Container, tell: Tell = notice, stop: Stop = never
) -> list[tuple[str, Region]]:
    """Names and regions, canvas units, of the parts of the SVG that a container was read from.

    Parts that paint nothing are left out. ``tell``: told what goes without a name, and why; once
    ``stop`` is true, so does what is left.
    """
    with reading_file(container.source):
        found = _regions_of(named_parts(data, tell), tell, stop)
        if not found:
            return []
        bounds = np.reshape(_inside(read_drawing(data).ink).bounds, (2, 2))
    low, scale = bounds[0], container.outline.extent / np.ptp(bounds, axis=0).max()
    corner = np.array(container.outline.bounds[:2])
    inside = container.outline.region

    def placed(region: Region) -> Region:
        moved = shapely.transform(region, lambda points: (points - low) * scale + corner)
        return intersection(moved, inside)

    parts = [(name, placed(region)) for name, region in found]
    return [(name, region) for name, region in parts if region.area > 0]


def _regions_of(
    parts: Iterable[tuple[str, bytes]], tell: Tell, stop: Stop
) -> list[tuple[str, Region]]:
    """Names and regions, CSS pixels, of parts that paint something.

    All together may take as much work as one container. Once stopped, those before.
    """
    found = list[tuple[str, Region]]()
    with one_budget(LARGESSE):
        for name, document in parts:
            if stop():
                tell(f"stopped: the part {name} and those after it are not named")
                break
            try:
                spend(_BYTE_NS * len(document), "has too large parts")
                found.append((name, _inside(read_drawing(document).ink)))
            except TooRichError as error:
                tell(f"the part {name} and those after it are not named: it {error.what}")
                break
            except UnfitError:
                continue
    return found


def stated_unit(root: ET.Element) -> Unit | None:
    """The real unit in which a drawing states its size; None for px and shares.

    Where width and height have different ones, the width's.

    >>> stated_unit(ET.Element("svg", {"width": "20mm"})), stated_unit(ET.Element("svg"))
    ('mm', None)
    """
    for name in ("width", "height"):
        length = split_length(root.get(name, ""))
        unit = as_unit(length[1]) if length is not None else None
        if unit is not None and unit != "px":
            return unit
    return None


def _inside(ink: Ink) -> Region:
    inside = [ink.fills] if ink.fills.area > 0 else []
    if ink.lines.area > 0:
        inside.append(within_lines(ink.lines))
    return clean_union(*inside)


def _without_whites(drawing: PaintedDrawing, region: Region) -> Region:
    if drawing.ink.fills.area == 0 and any(part.interiors for part in polygon_parts(region)):
        notice("its closed lines within lines are holes; fill the outer one, and they are none")
    if not any(map(_is_white, drawing.shapes)):
        return region
    if isinstance(drawing.ink, TracedInk) and drawing.page is not None:
        return _dark_part(drawing.root, drawing.page)
    left = clean_union(without_whites(drawing, region))
    share = 1 - left.area / region.area
    if share > TOLD_WHITE:
        notice(
            f"its white paint over darker counts as holes, {share:.0%} of it; a tint below "
            f"#{LEAST_WHITE:02x}{LEAST_WHITE:02x}{LEAST_WHITE:02x} fills them"
        )
    return left


def _dark_part(root: ET.Element, page: Page) -> Region:
    """Dark region of a page that is painted all over, in CSS pixels."""
    pixels = decode_picture(page_picture(root, page), TRACE_PX).pixels
    traced = mask_of_pixels(pixels)
    return shapely.transform(traced.region, lambda points: points * (page.width / traced.width))


MOST_PARTS = 300
"""Parts that are looked at; of more, none has room for a name. Chosen."""

LONGEST = 60
"""Letters of a name. Longer ones are remarks. Chosen."""

_BYTE_NS = 1e3
"""For parsing and cleaning a byte of a part, at most. Measured."""

_LAYER = "{http://www.inkscape.org/namespaces/inkscape}label"
_NAMES = (_LAYER, "title", "name", "data-name", "aria-label")
"""Attributes that hold names, before ids."""

_GIVEN_BY_PROGRAMS = re.compile(
    r"(path|g|group|rect|circle|ellipse|polygon|polyline|line|layer|ebene|calque|capa|svg|use|image"
    r"|text|tspan|shape|vector|object|xmlid|svgid)?[-_ ]*[\d_-]*|.*\d{4,}.*",
    re.IGNORECASE,
)
_REFERS = re.compile(r"url\(|href", re.IGNORECASE)
_SHAPES = frozenset({"g", "a", "path", "rect", "circle", "ellipse", "polygon", "polyline", "use"})
_UNSEEN = frozenset({"defs", "style", "symbol", "clipPath", "mask", "linearGradient"})


def named_parts(data: bytes, tell: Tell = notice) -> Iterator[tuple[str, bytes]]:
    """Names of at most ``MOST_PARTS`` parts of an SVG, and documents that show nothing else.

    They are the children of one element, the first inwards from the root that has two with
    names: of a layer of Inkscape, a title, an attribute for names, or an id that no program made.
    What goes without for its long name, or beyond that many, is told.

    >>> data = b'<svg><g><path id="Peru" d="M0 0h9v9z"/><path id="Chile" d="M9 0h2v9z"/></g></svg>'
    >>> [(name, len(document) < 90) for name, document in named_parts(data)]
    [('Peru', True), ('Chile', True)]
    """
    root = parse_xml(unpacked(data))
    way, remarks = [root], 0
    while True:
        children = [child for child in way[-1] if tag_of(child) in _SHAPES]
        found = [(name, child) for child in children if (name := name_of(child))]
        remarks += sum(any(map(len, _said(one))) and not name_of(one) for one in children)
        if len(found) > 1:
            break
        groups = [child for child in children if tag_of(child) in {"g", "a"}]
        if len(groups) != 1:
            found = []
            break
        way.append(groups[0])
    if remarks:
        tell(f"{remarks} of its parts go without: a name has at most {LONGEST} letters")
    if len(found) > MOST_PARTS:
        tell(f"{MOST_PARTS} of its {len(found):,} parts are named, the first")
    sheets = "".join("".join(one.itertext()) for one in root.iter() if tag_of(one) == "style")
    for name, child in found[:MOST_PARTS]:
        yield name, _alone(way, child, is_whole="url(" in sheets)


def _alone(way: list[ET.Element], part: ET.Element, *, is_whole: bool) -> bytes:
    """The document with one part of what is drawn, and what is defined where it refers to that.

    ``is_whole``: whether styles may refer to it.
    """
    drawn = ET.tostring(part, encoding="unicode") + "".join(str(one.attrib) for one in way)
    kept = _UNSEEN if is_whole or _REFERS.search(drawn) else frozenset({"style"})
    inner = part
    for element in reversed(way):
        outer = copy.copy(element)
        for child in list(outer):
            if tag_of(child) not in kept:
                outer.remove(child)
        outer.append(inner)
        inner = outer
    return ET.tostring(inner, encoding="unicode").encode()


def name_of(element: ET.Element) -> str:
    """Name of a part or a layer: its title, or what a program keeps beside it; empty without.

    >>> name_of(ET.Element("g", {"id": "Engrave"})), name_of(ET.Element("g", {"id": "g12"}))
    ('Engrave', '')
    """
    return next((text for text in _said(element) if 0 < len(text) <= LONGEST), "")


def _said(element: ET.Element) -> list[str]:
    """Texts of an element that may be its name, the best first."""
    titles = [child.text for child in element if tag_of(child) == "title"]
    said = [*titles, *(element.get(key) for key in _NAMES), _own(element.get("id", ""))]
    return [" ".join((text or "").split()) for text in said]


def _own(name: str) -> str:
    """An id as a name; empty for one that a program gave.

    >>> _own("New_Zealand"), _own("path4092"), _own("g")
    ('New Zealand', '', '')
    """
    return "" if _GIVEN_BY_PROGRAMS.fullmatch(name) else name.replace("_", " ")


def tag_of(element: ET.Element) -> str:
    """Name of an element without its namespace; empty for a comment."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
