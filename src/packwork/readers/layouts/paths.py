"""Paths of layouts of ours: those that are rings of points, and those without curves."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import numpy as np

from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region
from packwork.readers.layouts.foreign_svg import tag

_OF_POLYGONS = frozenset({"id", "d", "fill-rule", "data-name", "data-weight", "fill"})
_RINGS = re.compile(r"(?:M-?\d++(?:\.\d++)?+(?: -?\d++(?:\.\d++)?+)++Z)++")
_CURVES = re.compile("[CcSsQqTtAa]")
_LEAST_NUMBERS = 6


def is_straight(element: ET.Element) -> bool:
    """Whether an element is a path of straight lines alone, as it is drawn."""
    is_path = tag(element) == "path" and not {"data-outline", "data-bays"} & element.attrib.keys()
    return is_path and _CURVES.search(element.get("d", "")) is None


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
