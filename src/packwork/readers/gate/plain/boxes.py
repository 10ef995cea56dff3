"""Bounding boxes of drawn elements, for CSS lengths and transforms that refer to them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.reading import spend
from packwork.readers.svg_syntax.lengths import parse_length
from packwork.readers.svg_syntax.shapes import Viewport, flattened_all, shape_pieces
from packwork.readers.svg_syntax.transforms import parse_transform
from packwork.readers.svg_syntax.vocabulary import HREF, NEVER_DRAWN, SHAPES

MAX_DEPTH = 12
"""Uses inside one another that are followed. Chosen."""

_SHAPE_NS = 4e5
_FINE = 1e-4
_SIDES = {"left": 0.0, "top": 0.0, "center": 0.5, "right": 1.0, "bottom": 1.0}

Box = tuple[float, float, float, float]
"""Left, top, width and height."""


def fill_box(element: ET.Element, by_id: dict[str, ET.Element], viewport: Viewport) -> Box | None:
    """Box round the fills of an element and what is in it; None if there are none.

    Text counts for nothing.

    Examples
    --------
    >>> group = ET.fromstring('<g><rect width="4" height="2" transform="scale(2)"/></g>')
    >>> fill_box(group, {}, (9.0, 9.0))
    (0.0, 0.0, 8.0, 4.0)
    """
    points = _points(element, by_id, viewport, 0)
    if len(points) == 0:
        return None
    (left, top), (width, height) = points.min(axis=0).tolist(), np.ptp(points, axis=0).tolist()
    return left, top, width, height


def place_in(box: Box, words: Sequence[str]) -> tuple[float, float]:
    """Point of a box that CSS names by up to two words, across and down, or the other way round.

    Examples
    --------
    >>> place_in((10.0, 0.0, 4.0, 8.0), ["top"]), place_in((10.0, 0.0, 4.0, 8.0), ["25%", "1"])
    ((12.0, 0.0), (11.0, 1.0))
    """
    across, down = [*words, "center", "center"][:2]
    if across in {"top", "bottom"} or down in {"left", "right"}:
        across, down = down, across
    x, y = (
        box[k] + (_SIDES[w] * box[2 + k] if w in _SIDES else parse_length(w, box[2 + k]) or 0.0)
        for k, w in enumerate((across, down))
    )
    return x, y


def _points(
    element: ET.Element, by_id: dict[str, ET.Element], viewport: Viewport, depth: int
) -> FloatArray:
    """Points that lie within the box and reach its sides."""
    spend(_SHAPE_NS, "refers to the boxes of too many shapes")
    nothing = np.empty((0, 2))
    if element.get("display") == "none" or depth > MAX_DEPTH:
        return nothing
    if element.tag in SHAPES or element.tag == "image":
        return _shape(element, viewport)
    children: list[ET.Element] = [c for c in element if c.tag not in NEVER_DRAWN]
    moved = affine.identity()
    if element.tag == "use":
        target = by_id.get(element.get(HREF, "")[1:])
        children, depth = ([] if target is None else [target]), depth + 1
        x, y = (parse_length(element.get(n), viewport[k]) or 0.0 for k, n in enumerate("xy"))
        moved = affine.similarity(x, y, 0.0, 1.0)
    parts = [nothing]
    for child in children:
        own = affine.compose(moved, parse_transform(child.get("transform")))
        parts.append(affine.apply(own, _points(child, by_id, viewport, depth)))
    return np.concatenate(parts)


def _shape(element: ET.Element, viewport: Viewport) -> FloatArray:
    if element.tag == "image":
        names = (("x", 0), ("y", 1), ("width", 0), ("height", 1))
        x, y, w, h = (parse_length(element.get(n), viewport[k]) or 0.0 for n, k in names)
        return np.array([(x, y), (x + w, y + h)])
    pieces = shape_pieces(element, viewport)
    if not pieces:
        return np.empty((0, 2))
    controls = np.concatenate([piece.segments.reshape(-1, 2) for piece in pieces])
    if len(controls) == 0:
        return np.array([piece.start for piece in pieces])
    tolerance = max(float(np.ptp(controls, axis=0).max()) * _FINE, 1e-9)
    return np.concatenate(flattened_all(pieces, tolerance))
