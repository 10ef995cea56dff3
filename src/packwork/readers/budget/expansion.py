"""Size of a drawing once every ``use`` and every paint reference is followed.

Ten nested ``use`` elements of ten each are 10^10 shapes in a kilobyte of file. Counting
by memoised recursion takes one visit per element, whatever the count.

A line a thousand units long with dashes of a thousandth is a million dashes in fifty
letters. Dashes are measured in the line's own units, so transforms do not matter.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass

import numpy as np

from packwork.readers.reading import UnfitError, notice
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE, parse_length
from packwork.readers.svg_syntax.references import elements_by_id, embedded_size, referenced_ids
from packwork.readers.svg_syntax.shapes import flattened_all, shape_pieces
from packwork.readers.svg_syntax.vocabulary import (
    FILTER_STEPS,
    GRADIENTS,
    HREF,
    NEVER_DRAWN,
    SHAPES,
    TEXTS,
)

DASHES = "stroke-dasharray"

_SOLID = frozenset({"none", "inherit"})
_RELATIVE = ("%", "em", "ex")
_FINE = 1e-6
_LIKE_PATHS = frozenset({"path", "polyline", "polygon"})
_WEIGHTS = {"width": 2, "height": 2, "r": 7, "rx": 7, "ry": 7, "x1": 1, "y1": 1, "x2": 1, "y2": 1}
"""What each measure of the other shapes adds to the length of their lines, at most."""


def bound_dashes(root: ET.Element) -> bool:
    """Draw lines solid whose dashes cannot be counted, in place; whether any are dashed.

    Those are the lines of text, and dashes in units of a font or a page.

    >>> line = ET.Element("line", {"stroke-dasharray": "1e-9em"})
    >>> bound_dashes(line), line.attrib
    (False, {'stroke-dasharray': 'none'})
    """
    dashed = [element for element in root.iter() if DASHES in element.attrib]
    for element in dashed:
        text = element.attrib[DASHES].strip()
        if element.tag in TEXTS or (text not in _SOLID and not _lengths(text)):
            element.set(DASHES, "none")
    if not any(dashes_per_unit(element) for element in dashed):
        return False
    for element in root.iter("text"):
        element.set(DASHES, "none")
    return True


def dashes_per_unit(element: ET.Element) -> float:
    """Dashes that the element's own style puts on a unit of line, gaps counted too.

    >>> dashes_per_unit(ET.Element("g", {"stroke-dasharray": "3 1"}))
    0.5
    """
    lengths = _lengths(element.get(DASHES, ""))
    period = sum(lengths)
    # Below that, single precision cannot tell it from none.
    return len(lengths) / max(period, 1 / MAX_COORDINATE) if period > 0 else 0.0


def line_length(element: ET.Element) -> float:
    """Length of a clean shape's line in its own units, at most; 0 for what is no shape.

    >>> line_length(ET.Element("path", {"d": "M0 0h4v3z"}))
    12.0
    """
    if element.tag not in SHAPES:
        return 0.0
    if element.tag not in _LIKE_PATHS:
        measures = ((parse_length(element.get(k), MAX_COORDINATE), w) for k, w in _WEIGHTS.items())
        return sum(abs(measure or 0.0) * weight for measure, weight in measures)
    total = 0.0
    for piece in shape_pieces(element, (0.0, 0.0)):
        points = np.concatenate([[piece.start], *piece.segments, [piece.start]])
        steps = np.hypot(*np.diff(points, axis=0).T)
        total += float(steps.sum() if piece.is_closed else steps[:-1].sum())
    return total


def curve_length(element: ET.Element) -> float:
    """Length of a clean shape's line in its own units, its curves followed.

    >>> circle = ET.Element("circle", {"r": "1"})
    >>> round(curve_length(circle), 3)
    6.283
    """
    total = 0.0
    pieces = shape_pieces(element, (0.0, 0.0))
    controls = [piece.segments.reshape(-1, 2) for piece in pieces if len(piece.segments)]
    if not controls:
        return 0.0
    extent = float(np.ptp(np.concatenate(controls), axis=0).max())
    for line in flattened_all(pieces, max(extent * _FINE, 1e-9)):
        total += float(np.hypot(*np.diff(line, axis=0).T).sum())
    return total


def _lengths(text: str) -> list[float]:
    """Lengths of dashes and gaps; empty if there are none or one is not absolute."""
    lengths: list[float] = []
    for word in text.replace(",", " ").split():
        length = None if word.lower().endswith(_RELATIVE) else parse_length(word, math.nan)
        if length is None or length < 0:
            return []
        lengths.append(length)
    return lengths


MAX_DEPTH = 100
"""Elements inside one another, also after ``use`` has been expanded. Drawings made by
people stay below 40; recursion over the tree stays far from Python's own limit. Chosen."""

MAX_EXPANDED = 30_000
"""Elements of a drawing after expansion, a tenth of a millisecond each. Rich illustrations
have some thousands. Chosen."""

MAX_LAYERS = 16
"""Clips, masks and blended groups inside one another, each rendered as a picture. Chosen."""

MAX_DASHES = 20_000
"""Dashes of a drawing, or of a line: ten milliseconds of each copy in a picture. Chosen."""

_PIXELS_PER_ELEMENT = 10_000
_COUNTABLE = 10**15
_PAINT_NAMES = frozenset({"fill", "stroke", "marker-start", "marker-mid", "marker-end"})
_LAYER_COSTS = {"clip-path": 25, "mask": 100, "opacity": 10, "style": 10, "filter": 25}
"""Elements that an off-screen layer counts for when the drawing is rendered, as a step of a filter
does for that of an opacity. Chosen."""


def check_size(raw: ET.Element) -> None:
    """Refuse a parsed document of too many shapes before each of them is looked at."""
    count = sum(str(element.tag).rpartition("}")[2] in SHAPES for element in raw.iter())
    if count > MAX_EXPANDED:
        raise UnfitError(
            f"grows to {count:,} elements; {MAX_EXPANDED:,} are the most, so simplify it"
        )


def bound_expansion(root: ET.Element) -> None:
    """Refuse a clean drawing that grows too large or too deep, or refers to itself.

    One of more than ``MAX_DASHES`` dashes is kept, its lines drawn solid, in place.

    >>> loop = ET.fromstring('<svg><g id="a"><use xlink:href="#a" xmlns:xlink="x"/></g></svg>')
    >>> loop[0][0].attrib.clear(); loop[0][0].set("xlink:href", "#a")
    >>> bound_expansion(loop)
    Traceback (most recent call last):
    packwork.readers.reading.UnfitError: refers to itself in a circle (at id 'a'); ...
    """
    is_dashed = bound_dashes(root)
    size = _Counter(elements_by_id(root), is_dashed=is_dashed).measure(root, 0)
    count = size.count
    if count > MAX_EXPANDED:
        met = f"{count:,}" if count < _COUNTABLE else "far too many"
        raise UnfitError(
            f"grows to {met} elements once its references are followed; "
            f"{MAX_EXPANDED:,} are the most, so simplify it"
        )
    if size.layers > MAX_LAYERS:
        raise UnfitError(
            f"nests clips, masks or see-through groups {size.layers} deep; "
            f"{MAX_LAYERS} are the most, so flatten it"
        )
    if size.dashes > MAX_DASHES:
        for element in root.iter():
            element.attrib.pop(DASHES, None)
        notice(f"dashed lines are drawn solid, for they have more than {MAX_DASHES:,} dashes")


def count_expanded(root: ET.Element) -> tuple[int, float]:
    """Elements of a clean drawing after expansion, costly ones several times, and layers.

    Layers are clips, masks and blended groups, each of which is rendered as a picture of its own.

    >>> count_expanded(ET.fromstring('<svg><g opacity=".5"/><g opacity=".5"/></svg>'))
    (23, 2.0)
    """
    size = _Counter(elements_by_id(root), is_dashed=False).measure(root, 0)
    return size.count, float(size.pictures)


@dataclass(frozen=True)
class _Size:
    """Counts of an element after expansion."""

    count: int
    levels: int
    layers: int
    pictures: float
    length: float
    dashes: float


class _Counter:
    """Sizes of expanded elements, each element visited once."""

    def __init__(self, by_id: dict[str, ET.Element], *, is_dashed: bool) -> None:
        self._by_id = by_id
        self._is_dashed = is_dashed
        self._known: dict[ET.Element, _Size] = {}
        self._open: set[ET.Element] = set()

    def measure(self, element: ET.Element, depth: int) -> _Size:
        """Size of ``element``, itself included, ``depth`` levels below the root."""
        known = self._known.get(element)
        if known is None:
            if element in self._open:
                raise UnfitError(
                    f"refers to itself in a circle (at id {element.get('id', '')[:40]!r}); "
                    "remove that reference"
                )
            if depth > MAX_DEPTH:
                raise UnfitError(f"nests its references more than {MAX_DEPTH} deep; flatten it")
            self._open.add(element)
            known = self._sum(element, depth)
            self._open.remove(element)
            self._known[element] = known
        if depth + known.levels > MAX_DEPTH:
            raise UnfitError(f"nests its references more than {MAX_DEPTH} deep; flatten it")
        return known

    def _sum(self, element: ET.Element, depth: int) -> _Size:
        inside = [self.measure(child, depth + 1) for child in element]
        drawn = [
            part
            for part, child in zip(inside, element, strict=True)
            if child.tag not in NEVER_DRAWN
        ]
        painted: list[tuple[int, _Size]] = []
        for name, target in referenced_ids(element):
            part = self.measure(self._by_id[target], depth + 1)
            if name in _PAINT_NAMES:
                painted.append((_paint_times(element, name, self._by_id[target]), part))
            else:
                inside.append(part)
                drawn.append(part)
        count = _own_cost(element) + sum(part.count for part in inside)
        length, dashes = self._dashed(element, inside)
        shapes = float(min(count, _COUNTABLE))
        pictures = _own_layers(element) + sum(part.pictures for part in drawn)
        reached = [*inside, *(part for _, part in painted)]
        return _Size(
            count=count * (1 + sum(times * part.count for times, part in painted)),
            levels=1 + max((part.levels for part in reached), default=0),
            layers=min(_own_layers(element), 1) + max((part.layers for part in reached), default=0),
            pictures=pictures + shapes * sum(times * part.pictures for times, part in painted),
            length=length,
            dashes=dashes + shapes * sum(times * part.dashes for times, part in painted),
        )

    def _dashed(self, element: ET.Element, inside: list[_Size]) -> tuple[float, float]:
        """Length of all lines and number of dashes; dashes are inherited by all inside."""
        if not self._is_dashed:
            return 0.0, 0.0
        length = line_length(element) + sum(part.length for part in inside)
        return length, length * dashes_per_unit(element) + sum(part.dashes for part in inside)


def _own_layers(element: ET.Element) -> int:
    return sum(name in element.attrib for name in _LAYER_COSTS) + (element.tag in FILTER_STEPS)


def _own_cost(element: ET.Element) -> int:
    cost = 1 + sum(cost for name, cost in _LAYER_COSTS.items() if name in element.attrib)
    cost += _LAYER_COSTS["opacity"] * (element.tag in FILTER_STEPS)
    if element.tag == "image":
        width, height = embedded_size(element.get(HREF, "")) or (0, 0)
        cost += width * height // _PIXELS_PER_ELEMENT
    return cost


def _paint_times(element: ET.Element, name: str, target: ET.Element) -> int:
    """Times that ``target`` is drawn for each shape painted so; inherited by all inside."""
    if target.tag in GRADIENTS:
        return 0
    if name.startswith("marker") and element.tag in SHAPES:
        return max(1, len(element.get("d", "") or element.get("points", "")) // 4)
    return 1
