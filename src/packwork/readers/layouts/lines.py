"""Parts of a nest that was written as SVG: lines for a machine, their arcs as they were."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
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
from packwork.readers.layouts.foreign_svg import tag
from packwork.readers.line_drawings import arc_line
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.coordinates import parse_transform
from packwork.readers.svg_syntax.path_data import parse_path
from packwork.scene.item import Item, Label
from packwork.scene.line_art import EngravedLine, LineArt

CURVES = 1e-7
"""Distance of Bézier curves from the arcs that a DXF has for them, as a share of the part."""

_NUMBER, _RADIUS = r"-?\d{1,15}(?:\.\d{1,30})?", r"\d{1,15}(?:\.\d{1,30})?(?:e[+-]?\d{1,3})?"
_PAIR = f"{_NUMBER} {_NUMBER}"
_OURS = re.compile(
    f"(?:M{_PAIR}(?: {_PAIR})*(?:L{_PAIR}|A{_RADIUS} {_RADIUS} 0 0 [01] {_PAIR})*Z?)+"
)
_STEP = re.compile(r"([MLA])([-+\d.e ]+)")
_FLAT = 1e-200
_KEPT = re.compile(r"[MmZzLlHhVvCcSsQqTtAaeE\d\s+.,-]*")


def is_of_lines(items: ET.Element | None) -> bool:
    """Whether a group of items is one of lines for a machine."""
    return items is not None and items.get("data-lines") == "cut"


@final
class LineParts:
    """Parts of one file; copies of one drawing are one item."""

    def __init__(self, root: ET.Element, px_cu: float) -> None:
        """``px_cu``: length of a px in the units of the file."""
        self._px_cu = px_cu
        self._items: dict[tuple[object, ...], Item] = {}
        self._marks: dict[str, list[tuple[str, ET.Element]]] = {}
        self._artwork: dict[str, ET.Element] = {}
        for group in root:
            for one in group if "data-lines" in group.attrib else ():
                name = one.get("data-item", "")
                if group.get("data-lines") == "engrave" and tag(one) == "path":
                    label = next((v for k, v in group.attrib.items() if k[-6:] == "}label"), "")
                    colour = one.get("stroke", group.get("stroke", ""))
                    self._marks.setdefault(name, []).append((f"{label}\n{colour}", one))
                elif group.get("data-lines") == "artwork" and tag(one) == "g":
                    self._artwork[name] = one

    @property
    def artwork(self) -> list[ET.Element]:
        """Drawings painted on parts."""
        return [*self._artwork.values()]

    def lost(self, names: Sequence[str]) -> list[str]:
        """That lines are engraved on parts that are not there any more; or nothing."""
        lost = len(self._marks.keys() - {*names})
        if not lost:
            return []
        many = number_of(lost, "part that is not there are", "parts that are not there are")
        return [f"engraved lines of {many} left out"]

    def item(
        self, drawn: ET.Element, source: ET.Element, label: Label, ink: Region, arts: Arts,
        *, keeps_holes: bool,
    ) -> Item:  # fmt: skip
        """One part; ``ink`` is what its path encloses, in its own units."""
        name, path = drawn.get("data-name", "item"), source.get("d", "")
        place, own = place_and_art(source, drawn)
        back = _inverse(affine.compose(place, own))
        marks = self._marks.get(drawn.get("id", ""), [])
        artwork = self._artwork.get(drawn.get("id", ""))
        moved = [affine.compose(back, parse_transform(one.get("transform"))) for _, one in marks]
        key = (
            name, label, path, repr(own.tolist()), arts.text(artwork),
            *((paint, one.get("d"), repr(np.round(map_, 6).tolist()))
              for (paint, one), map_ in zip(marks, moved, strict=True)),
        )  # fmt: skip
        if key not in self._items:
            seen = sound_outline(ink, f"item {name!r}")
            outline = seen if keeps_holes else Outline.from_region(silhouette(ink))
            inside = seen.mapped(affine.inverse(own))
            cut = tuple(arc_lines_of(path, inside.extent))
            engraved = [
                EngravedLine(line.points, line.bulges, line.is_closed, paint.partition("\n")[2],
                             paint.partition("\n")[0])
                for (paint, one), map_ in zip(marks, moved, strict=True)
                for made in arc_lines_of(one.get("d", ""), inside.extent)
                for line in [made.mapped(map_, CURVES * inside.extent)]
            ]  # fmt: skip
            scale = abs(float(np.linalg.det(affine.compose(place, own)[:, :2]))) ** 0.5
            made_art = line_art(
                cut, tuple(engraved), inside.extent, inside.region, self._px_cu / scale
            )
            # Curves go into another SVG as they are.
            kept = path if "C" in path.upper() and _KEPT.fullmatch(path) else ""
            art = replace(made_art, matrix=own, path=kept)
            if artwork is not None:
                art = _painted(art, artwork, arts, affine.compose(back, parse_transform(
                    artwork.get("transform"))))  # fmt: skip
            self._items[key] = Item(name, name, outline, seen, art, label)
        return self._items[key]


def _painted(art: LineArt, artwork: ET.Element, arts: Arts, matrix: FloatArray) -> LineArt:
    """The same lines on what is painted; ``matrix`` maps that to the lines' units."""
    to_markup = _inverse(matrix)
    cut = tuple(line.mapped(to_markup, CURVES) for line in art.cut)
    engraved = tuple(line.mapped(to_markup, CURVES) for line in art.engraved)
    markup = arts.fragment(artwork).markup
    place = affine.compose(art.matrix, matrix)
    is_same = np.allclose(matrix, affine.identity(), rtol=0, atol=1e-9)
    path = art.path if is_same else ""
    return LineArt(markup, place, cut=cut, engraved=engraved, path=path, is_painted=True)


def _inverse(matrix: FloatArray) -> FloatArray:
    """Map back, where nothing is pressed flat."""
    found = affine.inverse(matrix) if abs(np.linalg.det(matrix[:, :2])) > _FLAT else matrix * np.nan
    if not np.isfinite(found).all():
        raise UnfitError("has a line to cut or artwork that is pressed flat")
    return found


def arc_lines_of(data: str, size: float) -> Iterator[ArcLine]:
    """Pieces of a path with its arcs as they are, other curves as arcs; ``size`` is the part's.

    >>> circle, = arc_lines_of("M1 0A1 1 0 0 1 0 1A1 1 0 0 1 -1 0A1 1 0 0 1 1 0Z", 2.0)
    >>> circle.bulges.tolist()
    [1.0, 1.0]
    """
    if not _OURS.fullmatch(data):
        for piece in parse_path(data):
            if len(piece.segments):
                yield arc_line(piece, CURVES * size)
        return
    for part in data.split("M")[1:]:
        points, bulges = list[tuple[float, float]](), list[float]()
        for letter, text in _STEP.findall("M" + part):
            values = [float(one) for one in text.split()]
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
            yield with_longest_arcs(line, CURVES * size) if any(bulges) else line
