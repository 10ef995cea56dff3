"""Paths of layouts of ours: those that are rings of points, and those without curves."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET

import numpy as np

from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region
from packwork.geometry.rectangles import is_near
from packwork.readers.layouts.arts import place_and_art
from packwork.readers.layouts.foreign_svg import tag

_OF_POLYGONS = frozenset({"id", "d", "fill-rule", "data-name", "data-weight", "fill"})
_RINGS = re.compile(r"(?:M-?\d++(?:\.\d++)?+(?: -?\d++(?:\.\d++)?+)++Z)++")
_CURVES = re.compile("[CcSsQqTtAa]")
_LEAST_NUMBERS = 6
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_RELATIVE = re.compile("[mlhv]")
_ONE = re.compile(
    r"(?:translate\([^()]*\))?\s*(?:rotate\(\s*[^\s(),]+\s*\))?\s*(?:scale\([^()]*\))?"
    r"|matrix\([^()]*\)"
)
_TWO = re.compile(r"translate\([^()]*\)(?:rotate\([^()]*\))?(?:scale\([^()]*\))?matrix\([^()]*\)")


def is_straight(element: ET.Element) -> bool:
    """Whether an element is a path of straight lines alone, as it is drawn."""
    is_path = tag(element) == "path" and not {"data-outline", "data-bays"} & element.attrib.keys()
    return is_path and _CURVES.search(element.get("d", "")) is None


def is_placed_exactly(source: ET.Element, drawn: ET.Element, outline: Outline) -> bool:
    """Whether neither the numbers of a path nor its transforms lose digits that count.

    ``outline``: the same in the units of the item.

    Examples
    --------
    >>> tile, far = Outline.box(0, 0, 2, 1), "M-9e7 0m9e7 0h2v1h-2z"
    >>> one, other = (ET.Element("path", {"d": data}) for data in ("M0 0H2V1H0Z", far))
    >>> is_placed_exactly(one, one, tile), is_placed_exactly(other, other, tile)
    (True, False)
    """
    texts = [source.get("transform", ""), drawn.get("transform", "")]
    if source is drawn:
        # Maps that stand one behind the other are kept apart.
        texts = texts[1].split("matrix(", 1) if _TWO.fullmatch(texts[1]) else texts[1:]
        texts[1:] = [f"matrix({text}" for text in texts[1:]]
    if not all(_ONE.fullmatch(text) for text in texts):
        return False
    own = np.abs(place_and_art(source, drawn)[1])
    reach = float((own[:, :2].sum(axis=1) * reach_of(source.get("d", "")) + own[:, 2]).max())
    return is_near(reach, outline.extent)


def reach_of(data: str) -> float:
    """Largest number of a path, or more: relative ones add up, and their roundings with them.

    Examples
    --------
    >>> reach_of("M0 0H20V-100"), reach_of("m3 0h4")
    (100.0, 21.0)
    """
    sizes = [abs(float(text)) for text in _NUMBER.findall(data)]
    if _RELATIVE.search(data):
        return math.fsum(sizes) * len(sizes)
    return max(sizes, default=math.inf)


def polygon_of(element: ET.Element) -> Region | None:
    """Region of a plain path that is nothing but rings of absolute points; None of all others."""
    is_plain = tag(element) == "path" and element.attrib.keys() <= _OF_POLYGONS
    if not (is_plain and element.get("fill-rule") == "evenodd"):
        return None
    data = element.get("d", "")
    if not _RINGS.fullmatch(data):
        return None
    rings = [np.array(ring.split(), dtype=np.float64) for ring in data[1:-1].split("ZM")]
    if any(len(ring) < _LEAST_NUMBERS or len(ring) % 2 for ring in rings):
        return None
    region = Outline.from_rings([ring.reshape(-1, 2) for ring in rings]).region
    return region if region.is_valid else None
