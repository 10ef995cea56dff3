"""Circles, ellipses, rounded corners and arcs in short pieces, drawn alike by every program.

Most programs draw a quarter of a circle as one cubic, which bulges by 2.7e-4 of the
radius: far more than the gaps that are checked. Shorter arcs have no such choice.
"""

from __future__ import annotations

import copy
import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.svg_syntax.lengths import parse_length
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.readers.svg_syntax.shapes import shape_pieces

PIECES = 10
"""Arcs that make a whole ellipse. As one cubic, each is within 1.2e-6 of the radius; the
error goes with the sixth power, the file's size with the first. Derived."""

PRECISION = 1e-7
"""Last digit of a coordinate, as a share of the shape's size: below the arcs' error."""

_OWN = frozenset({"d", "cx", "cy", "r", "rx", "ry", "x", "y", "width", "height"})


def with_short_arcs(root: ET.Element) -> ET.Element:
    """Copy of a clean drawing in which whatever is round is made of short pieces.

    Shapes whose size is a share of the page keep their form, as do the paths of drawings
    with markers, which would gain corners to mark.

    Examples
    --------
    >>> root = ET.fromstring('<svg><circle r="3" fill="red"/><rect width="2" height="2"/></svg>')
    >>> [shape.tag for shape in with_short_arcs(root)]
    ['path', 'rect']
    """
    drawing = copy.deepcopy(root)
    has_markers = any(element.tag == "marker" for element in drawing.iter())
    for element in drawing.iter():
        if any("%" in element.get(name, "") for name in _OWN):
            continue
        if element.tag in {"circle", "ellipse"}:
            _redraw(element, _oval(element))
        elif _has_corners(element) or (_has_arcs(element) and not has_markers):
            _redraw(element, _curves(shape_pieces(element, (0.0, 0.0))))
    return drawing


def _has_corners(element: ET.Element) -> bool:
    return element.tag == "rect" and not {"rx", "ry"}.isdisjoint(element.attrib)


def _has_arcs(element: ET.Element) -> bool:
    return element.tag == "path" and "a" in element.get("d", "").lower()


def _redraw(element: ET.Element, data: str) -> None:
    """Make a path of a shape, in place; one that does not show stays as it is."""
    if data:
        element.tag = "path"
        element.attrib = {k: v for k, v in element.attrib.items() if k not in _OWN} | {"d": data}


def _oval(element: ET.Element) -> str:
    cx, cy, r, rx, ry = (
        parse_length(element.get(name), 0.0) or 0.0 for name in ("cx", "cy", "r", "rx", "ry")
    )
    rx, ry = (r, r) if element.tag == "circle" else (rx or ry, ry or rx)
    if min(rx, ry) <= 0:
        return ""
    turns = 2 * math.pi * np.arange(PIECES) / PIECES
    points = np.column_stack([cx + rx * np.cos(turns), cy + ry * np.sin(turns)])
    digits = _digits(points)
    start, *ends = (_numbers(point, digits) for point in points)
    return f"M{start}" + "".join(f"A{rx:.9g} {ry:.9g} 0 0 1 {end}" for end in [*ends, start]) + "Z"


def _curves(pieces: Sequence[SubPath]) -> str:
    """Path data of lines and cubics, absolute."""
    points = [np.reshape([*piece.start, *piece.segments.flat], (-1, 2)) for piece in pieces]
    digits = _digits(np.concatenate([np.zeros((0, 2)), *points]))
    text = ""
    for piece in pieces:
        text += f"M{_numbers(np.array(piece.start), digits)}"
        text += "".join(_step(cubic, digits) for cubic in piece.segments)
        text += "Z" if piece.is_closed else ""
    return text


def _step(cubic: FloatArray, digits: int) -> str:
    # The handles of a straight line lie at its thirds but for rounding.
    is_line = np.abs(np.diff(cubic, n=2, axis=0)).max() <= 10.0**-digits
    return ("L" if is_line else "C") + _numbers(cubic[3 if is_line else 1 :], digits)


def _digits(points: FloatArray) -> int:
    """Digits after the point that a shape's points need."""
    size = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
    return max(0, math.ceil(-math.log10(PRECISION * size))) if size > 0 else 0


def _numbers(points: FloatArray, digits: int) -> str:
    # Adding nothing takes the sign off a zero.
    return " ".join(f"{round(value, digits) + 0.0:.12g}" for value in points.ravel().tolist())
