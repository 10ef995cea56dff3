"""SVG filters and pattern tiles: which are allowed, and their cost.

Those that shade a shape from its own light and edge are part of its look. What fetches
pictures, makes noise or takes time by the square of a radius is not let in, nor is a
region far larger than what is filtered; then the shape is drawn without its filter.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable

import numpy as np

from packwork.geometry import affine
from packwork.readers.reading import UnfitError, notice
from packwork.readers.svg_syntax.lengths import parse_length, parse_numbers
from packwork.readers.svg_syntax.painted import Painted
from packwork.readers.svg_syntax.references import elements_by_id, paint_server, referenced_ids
from packwork.readers.svg_syntax.transforms import parse_transform
from packwork.readers.svg_syntax.vocabulary import FILTER_STEPS, HREF

LARGEST_TILE = 4.0
"""Side of a tile as a multiple of what is drawn: what lies beyond is never seen, but would
be allocated. Chosen."""


def check_tiles(root: ET.Element, shapes: Iterable[Painted], extent: float) -> None:
    """Refuse a clean drawing that fills a shape with tiles far larger than ``extent``.

    Raises
    ------
    UnfitError
        Before a renderer tries to allocate them.

    Examples
    --------
    >>> check_tiles(ET.Element("svg"), [], 100.0)
    """
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


def settle_filters(root: ET.Element) -> None:
    """Take out filters that are too large or too many, in place, and say so.

    Examples
    --------
    >>> root = ET.fromstring('<svg><filter id="f" width="9"/><g filter="url(#f)"/></svg>')
    >>> settle_filters(root)
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
    """Take all filters off, in place.

    Examples
    --------
    >>> root = ET.fromstring('<svg><filter id="f"/><g filter="url(#f)"/></svg>')
    >>> drop_filters(root); ET.tostring(root).decode()
    '<svg><g /></svg>'
    """
    for element in root.iter():
        element.attrib.pop(FILTER, None)
        for child in element.findall(FILTER):
            element.remove(child)


def count_steps(root: ET.Element) -> int:
    """Steps of all filters, each counted wherever it is used.

    Examples
    --------
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
