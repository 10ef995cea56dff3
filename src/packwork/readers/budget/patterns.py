"""Pattern fills: limit on the size of their tiles, which renderers allocate whole."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable

import numpy as np

from packwork.geometry import affine
from packwork.readers.svg_syntax.lengths import parse_length
from packwork.readers.svg_syntax.painted import Painted
from packwork.readers.svg_syntax.references import elements_by_id, paint_server
from packwork.readers.svg_syntax.transforms import parse_transform
from packwork.readers.svg_syntax.vocabulary import HREF
from packwork.readers.unfit import UnfitError

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
