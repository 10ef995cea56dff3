"""Lines that are seen of a container in an SVG that was written: where they lie, and their pen."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.layouts.foreign_svg import tag
from packwork.readers.svg_syntax.coordinates import MAX_COORDINATE, parse_length
from packwork.readers.svg_syntax.shapes import points_of
from packwork.scene.layout import is_hex


def walls_of(group: ET.Element, place: FloatArray) -> tuple[FloatArray, ...] | None:
    """Lines that are seen of a container with openings; None if its outline is."""
    lines = [np.array(points_of(e)) for e in group if tag(e) == "polyline"]
    seen = tuple(affine.apply(place, line) for line in lines if len(line) > 1)
    # An outline that is not drawn has its walls beside it, be it none at all.
    is_drawn = any(e.get("stroke") != "none" for e in group if tag(e) == "path")
    return None if is_drawn and not seen else seen


def pen_of(group: ET.Element, scale: float) -> tuple[str, float] | None:
    """Colour and width of a container's line; None where none is seen."""
    colour = group.get("stroke", "").lower()
    width = scale * (parse_length(group.get("stroke-width"), 0.0) or 0.0)
    is_seen = group.get("display") != "none" and is_hex(colour)
    return (colour, width) if is_seen and 0 < width <= MAX_COORDINATE else None
