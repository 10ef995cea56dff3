"""Dash patterns scaled from the author's ``pathLength`` to user units."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from packwork.readers.budget.dashes import DASHES, curve_length
from packwork.readers.svg_syntax.lengths import parse_length
from packwork.readers.svg_syntax.vocabulary import SHAPES

PATH_LENGTH, OFFSET = "pathLength", "stroke-dashoffset"


def settle_dash_units(root: ET.Element) -> None:
    """Scale the dashes of shapes that state a ``pathLength``, in place.

    Examples
    --------
    >>> text = '<svg><path d="M0 0h8" pathLength="4" stroke-dasharray="1 .5"/></svg>'
    >>> root = ET.fromstring(text); settle_dash_units(root)
    >>> root[0].get("stroke-dasharray"), root[0].get("pathLength")
    ('2 1', None)
    """
    if any(PATH_LENGTH in element.attrib for element in root.iter()):
        _settle(root, "none", "0")


def _settle(element: ET.Element, dashes: str, offset: str) -> None:
    dashes, offset = element.get(DASHES, dashes), element.get(OFFSET, offset)
    stated = parse_length(element.attrib.pop(PATH_LENGTH, None), 0.0)
    lengths = [parse_length(word, 0.0) for word in dashes.replace(",", " ").split()]
    if element.tag in SHAPES and stated is not None and stated > 0 and None not in lengths:
        factor = curve_length(element) / stated
        written = (f"{factor * (length or 0.0):.9g}" for length in lengths)
        element.set(DASHES, " ".join(written))
        element.set(OFFSET, f"{factor * (parse_length(offset, 0.0) or 0.0):.9g}")
    for child in element:
        _settle(child, dashes, offset)
