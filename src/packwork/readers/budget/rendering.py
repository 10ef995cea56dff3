"""Cost of rendering a drawing: its filters, its pattern tiles, and an estimate of resvg's time.

The figures behind the estimate were measured on documents of one kind each; together they are good
to about a factor of three, which is enough to keep a hostile drawing from taking minutes, and the
same on every machine and under any load.

Filters that shade a shape from its own light and edge are part of its look. What fetches pictures,
makes noise or takes time by the square of a radius is not let in, nor is a region far larger than
what is filtered; then the shape is drawn without its filter.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from packwork.geometry import affine
from packwork.readers.budget.expansion import count_expanded
from packwork.readers.reading import PICTURES_NS, TooRichError, UnfitError, left, notice, spend
from packwork.readers.svg_syntax.coordinates import (
    Page,
    parse_length,
    parse_numbers,
    parse_transform,
)
from packwork.readers.svg_syntax.painted import Painted, drawing_box, stretch
from packwork.readers.svg_syntax.references import elements_by_id, paint_server, referenced_ids
from packwork.readers.svg_syntax.vocabulary import FILTER_STEPS, HREF

LARGEST_TILE = 4.0
"""Side of a tile as a multiple of what is drawn: what lies beyond is never seen, but would
be allocated. Chosen."""


def check_tiles(root: ET.Element, shapes: Iterable[Painted], extent: float) -> None:
    """Refuse a clean drawing that fills a shape with tiles far larger than ``extent``."""
    patterns = {k: e for k, e in elements_by_id(root).items() if e.tag == "pattern"}
    most = LARGEST_TILE * extent
    for shape in shapes if patterns else ():
        for paint in (shape.painting.fill, shape.painting.stroke):
            pattern = patterns.get(paint_server(paint) or "")
            if pattern is None:
                continue
            side = _tile_side(pattern, patterns, shape)
            if side > most:
                raise UnfitError(
                    f"fills a shape with a pattern tile of {side:g} px; "
                    f"{most:g} px are the most for what is drawn"
                )


def _tile_side(pattern: ET.Element, patterns: dict[str, ET.Element], shape: Painted) -> float:
    """Longer side of the tile on the page, in CSS pixels, at most."""
    sizes = np.array(
        [parse_length(_stated(pattern, name, patterns), 1.0) or 0.0 for name in ("width", "height")]
    )
    if _stated(pattern, "patternUnits", patterns) != "userSpaceOnUse":
        points = np.concatenate([piece.segments.reshape(-1, 2) for piece in shape.pieces])
        sizes = sizes * (np.ptp(points, axis=0) if len(points) else 0.0)
    own = parse_transform(_stated(pattern, "patternTransform", patterns))
    stretch = np.linalg.norm(affine.compose(shape.matrix, own)[:, :2], 2)
    return float(sizes.max() * stretch)


def _stated(pattern: ET.Element, name: str, patterns: dict[str, ET.Element]) -> str | None:
    """Attribute of a pattern or of the one it is made after."""
    made_after: ET.Element | None = pattern
    while made_after is not None and name not in made_after.attrib:
        made_after = patterns.get(made_after.get(HREF, "")[1:])
    return None if made_after is None else made_after.get(name)


MAX_STEPS = 800
"""Steps of all filters of a drawing, each counted for every shape it is used on. Shaded
emoji have some hundreds; each costs some microseconds of every picture. Chosen."""

MAX_WORK = 60.0
"""Steps of one filter, times the area of its region over that of what it filters. Shaded
emoji stay below 30. Larger lets hostile files be slow, smaller takes shading off. Tried."""

LARGEST_BLUR = 0.5
"""Deviation of a blur as a share of the page: beyond it nothing is left to see. Chosen."""

LARGEST_REGION = 3.0
"""Side of a filter's region, as a multiple of what it filters or of the page. Chosen."""

FILTER = "filter"

_REGION = {"x": -0.1, "y": -0.1, "width": 1.2, "height": 1.2}
_SIZES = ("width", "height")


def drop_wild_filters(root: ET.Element) -> None:
    """Take out filters that are too large or too many, in place, and say so.

    >>> root = ET.fromstring('<svg><filter id="f" width="9"/><g filter="url(#f)"/></svg>')
    >>> drop_wild_filters(root)
    >>> root[1].attrib
    {}
    """
    if not any(FILTER in element.attrib for element in root.iter()):
        return
    by_id = elements_by_id(root)
    side = max(parse_numbers(root.get("viewBox"))[2:], default=0.0)
    wild = {name for name, e in by_id.items() if e.tag == FILTER and not _is_tame(e, side)}
    for element in root.iter():
        if any(name == FILTER and target in wild for name, target in referenced_ids(element)):
            del element.attrib[FILTER]
    if wild or count_steps(root) > MAX_STEPS:
        notice("some filters were left out, for they are larger or more than drawings need")
    if count_steps(root) > MAX_STEPS:
        drop_filters(root)


def drop_filters(root: ET.Element) -> None:
    """Take all filters off, in place."""
    for element in root.iter():
        element.attrib.pop(FILTER, None)
        for child in element.findall(FILTER):
            element.remove(child)


def count_steps(root: ET.Element) -> int:
    """Steps of all filters, each counted wherever it is used.

    >>> text = '<svg><filter id="f"><feOffset/></filter><g filter="url(#f)"/></svg>'
    >>> count_steps(ET.fromstring(text))
    1
    """
    steps = {
        name: sum(e.tag in FILTER_STEPS for e in element.iter())
        for name, element in elements_by_id(root).items()
        if element.tag == FILTER
    }
    uses = (target for element in root.iter() for name, target in referenced_ids(element))
    return sum(steps.get(target, 0) for target in uses)


def _is_tame(element: ET.Element, side: float) -> bool:
    """Whether the region lies about what is filtered, or about a page of that side."""
    whole = 1.0 if element.get("filterUnits") != "userSpaceOnUse" else side
    whole = whole or 1.0
    lengths = {name: parse_length(element.get(name), whole) for name in _REGION}
    if any(abs(length or 0.0) > LARGEST_REGION * whole for length in lengths.values()):
        return False
    sides = [_REGION[name] if (n := lengths[name]) is None else n / whole for name in _SIZES]
    steps = sum(part.tag in FILTER_STEPS for part in element.iter())
    return steps * sides[0] * sides[1] <= MAX_WORK and not _is_wide(element, side)


def _is_wide(element: ET.Element, side: float) -> bool:
    """Whether any of its blurs is wider than the page could show."""
    unit = 1.0 if element.get("primitiveUnits") == "objectBoundingBox" else side
    blurs = (n for part in element.iter() for n in parse_numbers(part.get("stdDeviation")))
    return any(unit > 0 and blur > LARGEST_BLUR * unit for blur in blurs)


PICTURE_NS = PICTURES_NS / 4
"""Nanoseconds that one picture may take. Larger makes hostile files slow, smaller makes
the pictures of rich drawings coarse."""

LEAST_PX = 40
"""Longer side of the smallest picture. Chosen."""

_ELEMENT_NS, _LAYER_NS, _COVERED_NS, _HAIR_NS, _CROWD_NS = 2e4, 150.0, 6.0, 1e3, 0.05
"""For an element, a pixel of a layer, a pixel that a shape covers, a pixel along a line
thinner than one, and a row of a shape by the square of its edges there. Measured."""

_TOO_MANY = "has too many lines and layers one over another"

_MOST_ZOOM = 1e9
"""Page over the part of it that is shown, at most: beyond it no digits are left. Chosen."""

_MOST_SPILL = 25.0
"""Pictures that a layer is as large as, at most, where its content reaches beyond."""

_HAIR = 1 / 500
_HIDDEN_SHARE = 0.05


@dataclass(frozen=True)
class Work:
    """Counts of all that is to be rendered, after expansion.

    Parameters
    ----------
    layers
        Groups that are pictures of their own.
    depth
        How often shapes cover the page, by their boxes.
    hairs
        Length of thin lines, in sides of the page.
    crowd
        Edges of a shape that a row of pixels meets, squared, summed over shapes.
    spill
        Area of the box round all shapes, in pages, at least 1.
    page
        Longer side of the page in CSS pixels.
    """

    elements: float
    layers: float
    depth: float = 0.0
    hairs: float = 0.0
    crowd: float = 0.0
    spill: float = 1.0
    page: float = 1.0

    def nanoseconds(self, side: int, part: float) -> float:
        """Time for a picture ``side`` pixels long of a ``part`` of the page, in CSS pixels.

        What its size does not change is not counted.

        >>> Work(elements=10, layers=0, depth=1.0).nanoseconds(100, 1.0)
        60000.0
        >>> Work(elements=10, layers=1, page=1e200).nanoseconds(100, 1e-9)
        37500000.0
        """
        zoom = min(max(1.0, self.page / part), _MOST_ZOOM)
        depth = min(self.elements, self.depth * zoom**2)
        layers = self.layers * min(_MOST_SPILL, self.spill * zoom**2)
        pixels = side * side * (_LAYER_NS * layers + _COVERED_NS * depth)
        return pixels + side * (_HAIR_NS * self.hairs * zoom + _CROWD_NS * self.crowd)

    def side(self, longest_px: int, part: float) -> int:
        """Longer side of a picture of a part of the page that takes a reasonable time.

        >>> Work(elements=10, layers=0).side(1000, 1.0)
        1000
        >>> Work(elements=10, layers=500).side(1000, 1.0) < 100
        True
        """
        side = float(longest_px)
        most = min(PICTURE_NS, left("pictures") / 3)
        while side > LEAST_PX and self.nanoseconds(int(side), part) > most:
            side /= 1.1
        side = max(side, min(LEAST_PX, longest_px))
        if self.nanoseconds(int(side), part) + _ELEMENT_NS * self.elements > PICTURES_NS:
            raise TooRichError(_TOO_MANY)
        return int(side)

    def spend(self, side: int, part: float) -> None:
        """Take a picture off the budget of the file, before it is made."""
        spend(self.nanoseconds(side, part) + _ELEMENT_NS * self.elements, _TOO_MANY, "pictures")


def work_of(root: ET.Element, shapes: Sequence[Painted], page: Page | None) -> Work:
    """Counts of a clean drawing whose shapes are known."""
    width, height = _size(shapes, page)
    side = max(width, height)
    elements, layers = count_expanded(root)
    hidden = max(0.0, elements - len(shapes))
    depth, hairs, crowd = _HIDDEN_SHARE * hidden, 0.0, 0.0
    for shape in shapes:
        left, top, right, bottom = shape.bounds
        depth += min(1.0, (right - left) / width) * min(1.0, (bottom - top) / height)
        along, down = shape.lengths
        crowd += (down / height) ** 2
        if shape.painting.has_stroke:
            if shape.painting.pen.width * stretch(shape.matrix) < _HAIR * side:
                hairs += (along + down) / side
            crowd += 3 * (down / height) ** 2
    return Work(elements, layers, depth, hairs, crowd, _spill(shapes, width, height), side)


def _spill(shapes: Sequence[Painted], width: float, height: float) -> float:
    if not shapes:
        return 1.0
    lefts, tops, rights, bottoms = zip(*(shape.bounds for shape in shapes), strict=True)
    across, down = (max(rights) - min(lefts)) / width, (max(bottoms) - min(tops)) / height
    return float(max(1.0, across) * max(1.0, down))


def _size(shapes: Sequence[Painted], page: Page | None) -> tuple[float, float]:
    """Width and height of what is rendered, neither of them zero."""
    if page is not None:
        return page.width, page.height
    box = drawing_box(shapes)
    if box is None:
        return 1.0, 1.0
    width, height = box[2] - box[0], box[3] - box[1]
    return max(width, 1e-3 * height, 1e-9), max(height, 1e-3 * width, 1e-9)
