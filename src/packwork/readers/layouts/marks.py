"""Lines for a machine of a nest that was written as SVG: those to cut, their arcs as they were.

Beside them lie engraved lines and artwork, each of which says to which part it goes. What other
programs put there besides is named, and so is what leaves its part: neither was measured.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.arcs import ArcLine, with_longest_arcs
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region, silhouette
from packwork.phrasing import number_of
from packwork.readers.cache import followed_once
from packwork.readers.dxf.item import line_art
from packwork.readers.layouts.arts import Arts, place_and_art
from packwork.readers.layouts.assembly import sound_outline
from packwork.readers.layouts.foreign_svg import PAINTED, declared, group_named, layers_beside, tag
from packwork.readers.layouts.line_room import PAINT_OFF, LineRoom
from packwork.readers.line_drawings import CURVES_PX, arc_line
from packwork.readers.reading import UnfitError
from packwork.readers.regions import clean_union
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.ink import PaintedInk
from packwork.readers.svg_syntax.coordinates import checked, parse_length, parse_transform
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.scene.item import Item, Label
from packwork.scene.line_art import ENGRAVED_COLOUR, EngravedLine, LineArt
from packwork.units import convert

WIDEST_MM = 1.0
"""Width of a stroke from which it is no line. Chosen: that of drawings that are read."""

_SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
_FLAT = 1e-200
_LOOKS = ("stroke", "stroke-width", "fill")
_PLAIN: Mapping[str, str] = {"stroke": "", "stroke-width": "1", "fill": "black"}


@dataclass(frozen=True, eq=False)
class Mark:
    """A path to engrave: its data, its map to the units of the group of items, layer and colour."""

    data: str
    matrix: FloatArray
    layer: str
    colour: str


@final
class Beside:
    """Engraved lines and artwork of all parts, by the ids of these."""

    def __init__(self, root: ET.Element, pixel: float) -> None:
        """``pixel``: length of a px in the units of the file."""
        self.marks: dict[str, list[Mark]] = {}
        self.artwork: dict[str, tuple[ET.Element, FloatArray]] = {}
        self._strange: Counter[str] = Counter()
        self._wide = 0
        self._widest = convert(WIDEST_MM, "mm", "px") * pixel
        items = group_named(root, "items")
        for layer in layers_beside(root):
            back = inverse(parse_transform(None if items is None else items.get("transform")))
            matrix = affine.compose(back, parse_transform(layer.get("transform")))
            if layer.get("data-lines") == "artwork":
                self._add_artwork(layer, matrix)
            else:
                self._add_marks(layer, matrix)

    def _add_artwork(self, layer: ET.Element, matrix: FloatArray) -> None:
        for one in layer:
            name = one.get("data-item", "")
            if tag(one) == "g" and name and name not in self.artwork:
                place = parse_transform(one.get("transform"))
                self.artwork[name] = one, affine.compose(matrix, place)
            elif tag(one) in PAINTED:
                self._strange[tag(one)] += 1

    def _add_marks(self, layer: ET.Element, matrix: FloatArray) -> None:
        label = next((v for k, v in layer.attrib.items() if k[-6:] == "}label"), "")
        looks = _looks(layer, _PLAIN)
        for one, map_, own in _drawn_in(layer, matrix, looks):
            if tag(one) != "path" or not one.get("data-item"):
                self._strange[tag(one)] += 1
                continue
            # What a layer has by default is no colour of a line.
            is_default = own["stroke"] == looks["stroke"] == ENGRAVED_COLOUR
            colour = "" if is_default and "stroke" not in _said(one) else own["stroke"]
            mark = Mark(one.get("d", ""), map_, label, colour)
            self.marks.setdefault(one.get("data-item", ""), []).append(mark)
            scale = float(np.linalg.norm(map_[:, :2], 2))
            width = (parse_length(own["stroke-width"], 0.0) or 0.0) * scale
            self._wide += not width <= self._widest or own["fill"] not in {"none", "transparent"}

    def changes(self, ids: Sequence[str]) -> list[str]:
        """Sentences about what goes with no part, or is no line; ``ids`` are those of all parts."""
        told = [
            f"{number_of(count, f'<{kind}>', f'<{kind}>s')}"
            for kind, count in sorted(self._strange.items())
        ]
        found = [f"{', '.join(told)} beside the lines to cut, of no part, left out"] if told else []
        for group, what in ((self.marks, "engraved lines"), (self.artwork, "artwork")):
            if lost := len(group.keys() - {*ids}):
                many = number_of(lost, "part that is not there", "parts that are not there")
                found.append(f"{what} of {many} {'is' if what == 'artwork' else 'are'} left out")
        if self._wide:
            many = number_of(self._wide, "engraved line is", "engraved lines are")
            found.append(f"{many} filled, or wider than {WIDEST_MM:g} mm, which is not measured")
        double = sum(count > 1 for name, count in Counter(ids).items() if name)
        if double:
            many = number_of(double, "id is that", "ids are those")
            found.append(f"{many} of several items, so that what goes with each is not known")
        return found


def _drawn_in(
    group: ET.Element, matrix: FloatArray, looks: Mapping[str, str]
) -> Iterator[tuple[ET.Element, FloatArray, Mapping[str, str]]]:
    """All that is drawn in a group and those in it, with its map and what it inherits."""
    for one in group:
        map_ = affine.compose(matrix, parse_transform(one.get("transform")))
        own = _looks(one, looks)
        if tag(one) == "g":
            yield from _drawn_in(one, map_, own)
        elif tag(one) in PAINTED:
            yield one, map_, own


def _said(element: ET.Element) -> dict[str, str]:
    return {**element.attrib, **declared(element)}


def _looks(element: ET.Element, inherited: Mapping[str, str]) -> dict[str, str]:
    said = _said(element)
    return {key: said.get(key, inherited[key]).strip() for key in _LOOKS}


def inverse(matrix: FloatArray) -> FloatArray:
    """Map back, where nothing is pressed flat."""
    found = affine.inverse(matrix) if abs(np.linalg.det(matrix[:, :2])) > _FLAT else matrix * np.nan
    if not np.isfinite(found).all():
        raise UnfitError("has a line to cut or artwork that is pressed flat")
    return found


def paint_of(artwork: ET.Element, markup: str) -> Region | None:
    """Region that artwork paints, in its own units; None where that cannot be told from its paths.

    ``markup`` is what of the element is kept.

    Examples
    --------
    >>> paint_of(ET.Element("g"), '<rect width="2" height="3"/>').area
    6.0
    >>> paint_of(ET.fromstring("<g><image/></g>"), '<rect width="2" height="3"/>') is None
    True
    """
    if any(tag(one) == "image" for one in artwork.iter()):
        return None
    try:
        return followed_once(f"<svg {_SPACES}>{markup}</svg>".encode(), PAINT_OFF, _paint_of)
    except UnfitError:
        return None


def _paint_of(data: bytes) -> Region:
    ink = read_drawing(data).ink
    if not isinstance(ink, PaintedInk):
        raise UnfitError("has paint that paths do not tell")
    return clean_union(ink.body)


def left_out(count: int) -> list[str]:
    """Sentence about lines that leave their parts, if there are any.

    Examples
    --------
    >>> left_out(0), left_out(1)
    ([], ['1 engraved line that leaves its part is left out'])
    """
    if not count:
        return []
    many = number_of(
        count, "engraved line that leaves its part is", "engraved lines that leave their parts are"
    )
    return [f"{many} left out"]


_NUMBER, _RADIUS = r"-?\d{1,15}(?:\.\d{1,30})?", r"\d{1,15}(?:\.\d{1,30})?(?:e[+-]?\d{1,3})?"
_PAIR = f"{_NUMBER} {_NUMBER}"
_OURS = re.compile(
    f"(?:M{_PAIR}(?: {_PAIR})*(?:L{_PAIR}|A{_RADIUS} {_RADIUS} 0 0 [01] {_PAIR})*Z?)+"
)
_STEP = re.compile(r"([MLA])([-+\d.e ]+)")
_KEPT = re.compile(r"[MmZzLlHhVvCcSsQqTtAaeE\d\s+.,-]*")


@final
class LineParts:
    """Parts of one file; copies of one drawing are one item."""

    def __init__(self, root: ET.Element, px_cu: float) -> None:
        """``px_cu``: length of a px in the units of the file."""
        self._px_cu = px_cu
        self._items: dict[tuple[object, ...], tuple[Item, Counter[str]]] = {}
        self._beside = Beside(root, px_cu)
        self._met = Counter[str]()

    @property
    def artwork(self) -> list[ET.Element]:
        """Drawings painted on parts."""
        return [element for element, _ in self._beside.artwork.values()]

    def changes(self, ids: Sequence[str]) -> list[str]:
        """Sentences about what goes with no part, or leaves its own; ``ids`` are of all parts."""
        beyond = number_of(self._met["beyond"], "part that it leaves", "parts that it leaves")
        return [
            *self._beside.changes(ids),
            *left_out(self._met["lines"]),
            *([f"artwork of {beyond} is left out"] if self._met["beyond"] else []),
        ]

    @property
    def on_trust(self) -> list[str]:
        """That pictures on parts are not measured, if there are any."""
        many = number_of(self._met["pictures"], "part")
        told = f"what pictures, filters and masks paint on {many} is not measured"
        return [told] if self._met["pictures"] else []

    def item(
        self, drawn: ET.Element, source: ET.Element, label: Label, ink: Region, arts: Arts,
        *, keeps_holes: bool,
    ) -> Item:  # fmt: skip
        """One part; ``ink`` is what its path encloses, in its own units."""
        name, path = drawn.get("data-name", "item"), source.get("d", "")
        place, own = place_and_art(source, drawn)
        back = inverse(affine.compose(place, own))
        marks = self._beside.marks.get(drawn.get("id", ""), [])
        artwork, art_place = self._beside.artwork.get(drawn.get("id", ""), (None, back))
        moved = [affine.compose(back, one.matrix) for one in marks]
        key = (
            name, label, path, repr(own.tolist()), arts.text(artwork),
            *((one.layer, one.colour, one.data, repr(np.round(map_, 6).tolist()))
              for one, map_ in zip(marks, moved, strict=True)),
        )  # fmt: skip
        if key not in self._items:
            seen = sound_outline(ink, f"item {name!r}")
            outline = seen if keeps_holes else Outline.from_region(silhouette(ink))
            inside, whole = (one.mapped(affine.inverse(own)) for one in (seen, outline))
            scale = abs(float(np.linalg.det(affine.compose(place, own)[:, :2]))) ** 0.5
            pixel = self._px_cu / scale
            cut = tuple(arc_lines_of(path, CURVES_PX * pixel))
            is_bare = not marks and artwork is None
            room = None if is_bare else LineRoom(whole.region, whole.extent)
            engraved, met = list[EngravedLine](), Counter[str]()
            for one, map_ in zip(marks, moved, strict=True):
                for made in arc_lines_of(one.data, CURVES_PX * pixel):
                    if room is None or not room.holds(made, matrix=map_):
                        met["lines"] += 1
                        continue
                    line = EngravedLine(
                        made.points, made.bulges, made.is_closed, one.colour, one.layer
                    )
                    engraved.append(line.mapped(map_, CURVES_PX * pixel))
            made_art = line_art(cut, tuple(engraved), inside.extent, inside.region, pixel)
            # Curves go into another SVG as they are.
            kept = path if "C" in path.upper() and _KEPT.fullmatch(path) else ""
            art = replace(made_art, matrix=own, path=kept)
            if artwork is not None and room is not None:
                markup, matrix = arts.fragment(artwork).markup, affine.compose(back, art_place)
                paint = paint_of(artwork, markup)
                if paint is None or room.holds_paint(paint, matrix):
                    met["pictures"] += paint is None
                    art = _painted(art, markup, matrix, pixel)
                else:
                    met["beyond"] += 1
            self._items[key] = Item(name, name, outline, seen, art, label), met
        item, met = self._items[key]
        self._met += met
        return item


def _painted(art: LineArt, markup: str, matrix: FloatArray, pixel: float) -> LineArt:
    """The same lines on what is painted; ``matrix`` maps that to the lines' units."""
    to_markup = inverse(matrix)
    fine = CURVES_PX * pixel * abs(float(np.linalg.det(to_markup[:, :2]))) ** 0.5
    cut = tuple(line.mapped(to_markup, fine) for line in art.cut)
    engraved = tuple(line.mapped(to_markup, fine) for line in art.engraved)
    place = affine.compose(art.matrix, matrix)
    is_same = np.allclose(matrix, affine.identity(), rtol=0, atol=1e-9)
    path = art.path if is_same else ""
    return LineArt(markup, place, cut=cut, engraved=engraved, path=path, is_painted=True)


def arc_lines_of(data: str, tolerance: float) -> Iterator[ArcLine]:
    """Pieces of a path with its arcs as they are, other curves within a tolerance as arcs.

    >>> circle, = arc_lines_of("M1 0A1 1 0 0 1 0 1A1 1 0 0 1 -1 0A1 1 0 0 1 1 0Z", 1e-6)
    >>> circle.bulges.tolist()
    [1.0, 1.0]
    """
    if not _OURS.fullmatch(data):
        for piece in parse_path(data):
            if len(piece.segments):
                yield arc_line(piece, tolerance)
        return
    for part in data.split("M")[1:]:
        points, bulges = list[tuple[float, float]](), list[float]()
        for letter, text in _STEP.findall("M" + part):
            values = [float(one) for one in text.split()]
            for value in values[-2:] if letter == "A" else values:
                checked(value)
            if letter == "A":
                radius, _, _, _, sweep, *end = values
                half = math.dist(points[-1], end) / 2.0
                bend = math.tan(math.asin(min(half / radius, 1.0)) / 2.0) if radius else 0.0
                bulges[-1] = bend if sweep else -bend
                values = end
            points += zip(values[0::2], values[1::2], strict=False)
            bulges += [0.0] * (len(points) - len(bulges))
        is_closed = part.endswith("Z")
        if is_closed and len(points) > 2 and points[0] == points[-1]:
            points, bulges = points[:-1], bulges[:-1]
        if len(points) > 1:
            line = ArcLine(np.array(points), np.array(bulges), is_closed)
            yield with_longest_arcs(line, tolerance) if any(bulges) else line
