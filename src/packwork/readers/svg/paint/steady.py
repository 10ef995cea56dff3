"""Non-scaling strokes (``vector-effect``) as plain strokes.

They are as wide as on the drawing's own page; from then on they scale with the item.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np

from packwork.geometry import affine
from packwork.readers.svg.paint.walk import painted_shapes
from packwork.readers.svg_syntax.page import Page
from packwork.readers.svg_syntax.painted import Painted
from packwork.readers.svg_syntax.path_data import SubPath
from packwork.readers.svg_syntax.transforms import parse_transform

EFFECT, STEADY = "vector-effect", "non-scaling-stroke"

_EVEN = 1e-9
"""Difference of the two stretches of a map, as a share, from which its circles are ellipses."""


def settle_steady(root: ET.Element, page: Page | None) -> None:
    """Draw lines of constant width as plain ones, in place.

    A shape that is used several times is as its first use has it.

    Examples
    --------
    >>> text = '<g transform="scale(4)"><path vector-effect="non-scaling-stroke" {}/></g>'
    >>> line = text.format('d="M0 0h9" stroke="red" stroke-width="2"')
    >>> root = ET.fromstring(f"<svg>{line}</svg>")
    >>> settle_steady(root, None)
    >>> root[0][0].get("stroke-width"), root[0][0].get("vector-effect")
    ('0.5', None)
    """
    steady = {element for element in root.iter() if element.get(EFFECT) == STEADY}
    shapes = painted_shapes(root, page) if steady else []
    for element in root.iter():
        element.attrib.pop(EFFECT, None)
    for shape in shapes:
        if shape.element in steady:
            steady.remove(shape.element)
            if shape.painting.has_stroke:
                _settle(shape)


def _settle(shape: Painted) -> None:
    element, pen = shape.element, shape.painting.pen
    stretches = np.linalg.svd(shape.matrix[:, :2], compute_uv=False)
    if stretches[1] <= 0:
        return
    factor = 1.0
    if stretches[0] - stretches[1] <= _EVEN * stretches[0]:
        factor = 1 / float(stretches[0])
    else:
        _straighten(shape)
    element.set("stroke-width", f"{factor * pen.width:.12g}")
    if pen.dashes:
        element.set("stroke-dasharray", " ".join(f"{factor * d:.12g}" for d in pen.dashes))
        element.set("stroke-dashoffset", f"{factor * pen.dash_offset:.12g}")


def _straighten(shape: Painted) -> None:
    """Write a shape as a path in CSS pixels, brought there by what undoes its map."""
    element = shape.element
    own = parse_transform(element.get("transform"))
    back = affine.compose(own, affine.inverse(shape.matrix))
    data = " ".join(_written(piece.placed(shape.matrix)) for piece in shape.pieces)
    for name in ("x", "y", "width", "height", "cx", "cy", "r", "rx", "ry", "points"):
        element.attrib.pop(name, None)
    element.tag = "path"
    element.set("d", data)
    element.set("transform", f"matrix({' '.join(f'{v:.12g}' for v in back.T.ravel())})")


def _written(piece: SubPath) -> str:
    numbers = " ".join(f"{v:.12g}" for v in piece.segments[:, 1:].ravel())
    curves = f"C{numbers}" if numbers else ""
    return "M{:.12g} {:.12g}".format(*piece.start) + curves + ("z" if piece.is_closed else "")
