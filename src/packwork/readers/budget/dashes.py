"""Number of dashes that dashed lines make a renderer draw.

A line a thousand units long with dashes of a thousandth is a million dashes in fifty
letters. Dashes are measured in the line's own units, so transforms do not matter.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import numpy as np

from packwork.readers.svg_syntax.lengths import MAX_COORDINATE, parse_length
from packwork.readers.svg_syntax.shapes import flattened_all, shape_pieces
from packwork.readers.svg_syntax.vocabulary import SHAPES, TEXTS

DASHES = "stroke-dasharray"

_SOLID = frozenset({"none", "inherit"})
_RELATIVE = ("%", "em", "ex")
_FINE = 1e-6
_LIKE_PATHS = frozenset({"path", "polyline", "polygon"})
_WEIGHTS = {"width": 2, "height": 2, "r": 7, "rx": 7, "ry": 7, "x1": 1, "y1": 1, "x2": 1, "y2": 1}
"""What each measure of the other shapes adds to the length of their lines, at most."""


def settle_dashes(root: ET.Element) -> bool:
    """Draw lines solid whose dashes cannot be counted, in place; whether any are dashed.

    Those are the lines of text, and dashes in units of a font or a page.

    Examples
    --------
    >>> line = ET.Element("line", {"stroke-dasharray": "1e-9em"})
    >>> settle_dashes(line), line.attrib
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


def draw_solid(root: ET.Element) -> None:
    """Take all dashes away, in place.

    Examples
    --------
    >>> line = ET.Element("line", {"stroke-dasharray": "1"})
    >>> draw_solid(line); line.attrib
    {}
    """
    for element in root.iter():
        element.attrib.pop(DASHES, None)


def dashes_per_unit(element: ET.Element) -> float:
    """Dashes that the element's own style puts on a unit of line, gaps counted too.

    Examples
    --------
    >>> dashes_per_unit(ET.Element("g", {"stroke-dasharray": "3 1"}))
    0.5
    """
    lengths = _lengths(element.get(DASHES, ""))
    period = sum(lengths)
    # Below that, single precision cannot tell it from none.
    return len(lengths) / max(period, 1 / MAX_COORDINATE) if period > 0 else 0.0


def line_length(element: ET.Element) -> float:
    """Length of a clean shape's line in its own units, at most; 0 for what is no shape.

    Examples
    --------
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

    Examples
    --------
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
