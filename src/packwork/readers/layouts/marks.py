"""Engraved lines and artwork beside the lines to cut of a nest that was written as SVG.

Each says to which part it goes. What other programs put there besides is named, and so is what
leaves its part: neither was measured.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region
from packwork.phrasing import number_of
from packwork.readers.cache import followed_once
from packwork.readers.layouts.foreign_svg import (
    PAINTED,
    declared,
    group_named,
    layers_beside,
    tag,
)
from packwork.readers.layouts.line_room import PAINT_OFF
from packwork.readers.reading import UnfitError
from packwork.readers.regions import clean_union
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.ink import PaintedInk
from packwork.readers.svg_syntax.coordinates import parse_length, parse_transform
from packwork.scene.line_art import ENGRAVED_COLOUR
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
        return followed_once(f"<svg {_SPACES}>{markup}</svg>".encode(), PAINT_OFF, _painted)
    except UnfitError:
        return None


def _painted(data: bytes) -> Region:
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
