"""Parts of a nest that was written as SVG: lines for a machine, their arcs as they were."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.arcs import ArcLine, with_longest_arcs
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region
from packwork.geometry.polygon import silhouette
from packwork.phrasing import number_of
from packwork.readers.dxf.item import line_art
from packwork.readers.layouts.arts import Arts, place_and_art
from packwork.readers.layouts.assembly import sound_outline
from packwork.readers.layouts.line_room import LineRoom
from packwork.readers.layouts.marks import Beside, inverse, left_out, paint_of
from packwork.readers.line_drawings import CURVES_PX, arc_line
from packwork.readers.svg_syntax.coordinates import checked
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.scene.item import Item, Label
from packwork.scene.line_art import EngravedLine, LineArt

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
