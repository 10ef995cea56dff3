"""Parts of an SVG that have names, each as a document of its own: the countries of a map."""

from __future__ import annotations

import copy
import re
import xml.etree.ElementTree as ET

from packwork.readers.gate.door import unpacked
from packwork.readers.gate.xml_tree import parse_xml

MOST_PARTS = 300
"""Parts that are looked at; of more, none has room for a name. Chosen."""

LONGEST = 60
"""Letters of a name. Longer ones are remarks. Chosen."""

_LAYER = "{http://www.inkscape.org/namespaces/inkscape}label"
_NAMES = (_LAYER, "title", "name", "data-name", "aria-label")
"""Attributes that hold names, before ids."""

_GIVEN_BY_PROGRAMS = re.compile(
    r"(path|g|group|rect|circle|ellipse|polygon|polyline|line|layer|ebene|calque|capa|svg|use|image"
    r"|text|tspan|shape|vector|object|xmlid|svgid)?[-_ ]*[\d_-]*|.*\d{4,}.*",
    re.IGNORECASE,
)
_SHAPES = frozenset({"g", "a", "path", "rect", "circle", "ellipse", "polygon", "polyline", "use"})
_UNSEEN = frozenset({"defs", "style", "symbol", "clipPath", "mask", "linearGradient"})


def named_parts(data: bytes) -> list[tuple[str, bytes]]:
    """Names of the parts of an SVG, and documents that show nothing else.

    They are the children of one element, the first inwards from the root that has two with
    names: of a layer of Inkscape, a title, an attribute for names, or an id that no program made.

    Raises
    ------
    UnfitError
        If the bytes are no SVG or pass a limit.

    Examples
    --------
    >>> data = b'<svg><g><path id="Peru" d="M0 0h9v9z"/><path id="Chile" d="M9 0h2v9z"/></g></svg>'
    >>> [(name, len(document) < 90) for name, document in named_parts(data)]
    [('Peru', True), ('Chile', True)]
    """
    root = parse_xml(unpacked(data))
    way = [root]
    while True:
        children = [child for child in way[-1] if _tag(child) in _SHAPES]
        found = [(name, child) for child in children if (name := _name(child))]
        if len(found) > 1:
            break
        groups = [child for child in children if _tag(child) in {"g", "a"}]
        if len(groups) != 1:
            return []
        way.append(groups[0])
    return [(name, _alone(way, child)) for name, child in found[:MOST_PARTS]]


def _alone(way: list[ET.Element], part: ET.Element) -> bytes:
    """The document with one part of what is drawn."""
    inner = part
    for element in reversed(way):
        outer = copy.copy(element)
        for child in list(outer):
            if _tag(child) not in _UNSEEN:
                outer.remove(child)
        outer.append(inner)
        inner = outer
    return ET.tostring(inner, encoding="unicode").encode()


def _name(element: ET.Element) -> str:
    titles = [child.text for child in element if _tag(child) == "title"]
    said = [*titles, *(element.get(key) for key in _NAMES), _own(element.get("id", ""))]
    plain = (" ".join((text or "").split()) for text in said)
    return next((text for text in plain if 0 < len(text) <= LONGEST), "")


def _own(name: str) -> str:
    """An id as a name; empty for one that a program gave.

    Examples
    --------
    >>> _own("New_Zealand"), _own("path4092"), _own("g")
    ('New Zealand', '', '')
    """
    return "" if _GIVEN_BY_PROGRAMS.fullmatch(name) else name.replace("_", " ")


def _tag(element: ET.Element) -> str:
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
