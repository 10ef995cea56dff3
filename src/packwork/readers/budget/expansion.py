"""Size of a drawing once every ``use`` and every paint reference is followed.

Ten nested ``use`` elements of ten each are 10^10 shapes in a kilobyte of file. Counting
by memoised recursion takes one visit per element, whatever the count.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass

from packwork.readers.budget.dashes import dashes_per_unit, draw_solid, line_length, settle_dashes
from packwork.readers.svg_syntax.references import elements_by_id, embedded_size, referenced_ids
from packwork.readers.svg_syntax.vocabulary import (
    FILTER_STEPS,
    GRADIENTS,
    HREF,
    NEVER_DRAWN,
    SHAPES,
)
from packwork.readers.unfit import UnfitError, notice

MAX_DEPTH = 100
"""Elements inside one another, also after ``use`` has been expanded. Drawings made by
people stay below 40; recursion over the tree stays far from Python's own limit. Chosen."""

MAX_EXPANDED = 30_000
"""Elements of a drawing after expansion. Icons have some tens, rich illustrations some
thousands; each costs a tenth of a millisecond. Chosen."""

MAX_LAYERS = 16
"""Clips, masks and blended groups inside one another: each is a picture of its
own while the drawing is rendered. Chosen."""

MAX_DASHES = 20_000
"""Dashes of a drawing, or of one line: about ten milliseconds of each of its copies in a picture.
Chosen."""

_PIXELS_PER_ELEMENT = 10_000
_COUNTABLE = 10**15
_PAINT_NAMES = frozenset({"fill", "stroke", "marker-start", "marker-mid", "marker-end"})
_LAYER_COSTS = {"clip-path": 25, "mask": 100, "opacity": 10, "style": 10, "filter": 25}
"""Elements that an off-screen layer counts for when the drawing is rendered. Chosen."""

_STEP_COST = 10
"""Elements that a step of a filter counts for. Chosen."""


def check_size(raw: ET.Element) -> None:
    """Refuse a parsed document of too many shapes before each of them is looked at.

    Raises
    ------
    UnfitError
        If even without following references there are more than ``MAX_EXPANDED``.

    Examples
    --------
    >>> check_size(ET.fromstring("<svg><g/></svg>"))
    """
    count = sum(str(element.tag).rpartition("}")[2] in SHAPES for element in raw.iter())
    if count > MAX_EXPANDED:
        raise UnfitError(
            f"grows to {count:,} elements; {MAX_EXPANDED:,} are the most, so simplify it"
        )


def bound_expansion(root: ET.Element) -> None:
    """Refuse a clean drawing that grows too large or too deep, or refers to itself.

    One of more than ``MAX_DASHES`` dashes is kept, its lines drawn solid, in place.

    Raises
    ------
    UnfitError
        Within milliseconds, even where the expanded count has twenty digits.

    Examples
    --------
    >>> loop = ET.fromstring('<svg><g id="a"><use xlink:href="#a" xmlns:xlink="x"/></g></svg>')
    >>> loop[0][0].attrib.clear(); loop[0][0].set("xlink:href", "#a")
    >>> bound_expansion(loop)
    Traceback (most recent call last):
    packwork.readers.unfit.UnfitError: refers to itself in a circle (at id 'a'); ...
    """
    is_dashed = settle_dashes(root)
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
        draw_solid(root)
        notice(f"dashed lines are drawn solid, for they have more than {MAX_DASHES:,} dashes")


def count_expanded(root: ET.Element) -> tuple[int, float]:
    """Elements of a clean drawing after expansion, and the layers that they need.

    Costly elements are counted several times. Layers are clips, masks and blended groups,
    each of which is a picture of its own while the drawing is rendered.

    Examples
    --------
    >>> count_expanded(ET.fromstring('<svg><g opacity=".5"/><g opacity=".5"/></svg>'))
    (23, 2.0)
    """
    size = _Counter(elements_by_id(root), is_dashed=False).measure(root, 0)
    return size.count, float(size.pictures)


@dataclass(frozen=True)
class _Size:
    """What an element comes to after expansion."""

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
            self._enter(element, depth)
            known = self._sum(element, depth)
            self._open.remove(element)
            self._known[element] = known
        if depth + known.levels > MAX_DEPTH:
            raise UnfitError(f"nests its references more than {MAX_DEPTH} deep; flatten it")
        return known

    def _enter(self, element: ET.Element, depth: int) -> None:
        if element in self._open:
            raise UnfitError(
                f"refers to itself in a circle (at id {element.get('id', '')[:40]!r}); "
                "remove that reference"
            )
        if depth > MAX_DEPTH:
            raise UnfitError(f"nests its references more than {MAX_DEPTH} deep; flatten it")
        self._open.add(element)

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
    cost += _STEP_COST * (element.tag in FILTER_STEPS)
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
