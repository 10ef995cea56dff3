"""A text element by itself and in black, for rendering its outline."""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from typing import TypeAlias

from packwork.readers.svg_syntax.painted import PlacedText
from packwork.readers.svg_syntax.references import referenced_ids

PAINTS = frozenset(
    {"fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray"}
    | {"stroke-dashoffset", "stroke-linecap", "stroke-linejoin", "stroke-miterlimit", "color"}
    | {"opacity", "visibility", "paint-order"}
)
"""Attributes by which letters of one text may differ though their shapes do not."""

PLACED = PAINTS | {"id", "transform", "clip-path", "mask", "style", "display", "filter"}
"""Attributes of a text that its outlines keep."""

_SETTING = frozenset(
    {"font-family", "font-size", "font-stretch", "font-style", "font-variant", "font-weight"}
    | {"letter-spacing", "word-spacing", "text-anchor", "text-decoration", "direction"}
    | {"writing-mode", "dominant-baseline", "alignment-baseline", "baseline-shift", "xml:space"}
)
"""Attributes of what is around a text that decide how it is set."""

Paint: TypeAlias = tuple[tuple[str, str], ...]
"""What a part of a text sets for its paint, by name; empty for the text's own."""


def paints_of(text: ET.Element) -> list[Paint]:
    """Distinct paints of a text's letters, in their order.

    Examples
    --------
    >>> paints_of(ET.fromstring('<text fill="red">a<tspan fill="blue">b</tspan>c</text>'))
    [(), (('fill', 'blue'),)]
    """
    return list(dict.fromkeys(paint for element, paint in _painted(text, ()) if _letters(element)))


def stage_of(text: PlacedText, paint: Paint, by_id: dict[str, ET.Element]) -> ET.Element:
    """Drawing of the letters of one paint of a text in black, in the text's own units.

    Examples
    --------
    >>> import numpy as np
    >>> text = ET.fromstring('<text x="1" fill="red">a<tspan fill="blue">b</tspan></text>')
    >>> placed = PlacedText(text, np.eye(2, 3), (9.0, 9.0), ())
    >>> [e.get("visibility") for e in stage_of(placed, (), {}).iter() if e.tag != "svg"]
    ['visible', 'hidden']
    """
    twin = copy.deepcopy(text.element)
    twin.tail = None
    for element, own in list(_painted(twin, ())):
        element.attrib = {k: v for k, v in element.attrib.items() if k not in PLACED}
        element.set("visibility", "visible" if own == paint else "hidden")
    twin.set("fill", "black")
    stage = ET.Element("svg", {"overflow": "visible"})
    inner = stage
    for parent in text.above:
        inner = ET.SubElement(inner, "g", {k: v for k, v in parent.items() if k in _SETTING})
    used = [by_id[name] for e in twin.iter() for _, name in referenced_ids(e) if name in by_id]
    if used:
        ET.SubElement(stage, "defs").extend(copy.deepcopy(element) for element in used)
    inner.append(twin)
    return stage


def _painted(element: ET.Element, paint: Paint) -> list[tuple[ET.Element, Paint]]:
    """The parts of a text, each with what it and those around it set for its paint."""
    found = [(element, paint)]
    for child in element:
        own = {k: v for k, v in child.attrib.items() if k in PAINTS}
        found += _painted(child, tuple(sorted((dict(paint) | own).items())))
    return found


def _letters(element: ET.Element) -> str:
    """What the element itself says, not its parts."""
    return ((element.text or "") + "".join(child.tail or "" for child in element)).strip()
