"""Opaque black copy of a clean drawing, for rendering what it covers."""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET

from packwork.readers.svg_syntax.painted import is_clear, opacity
from packwork.readers.svg_syntax.references import elements_by_id, paint_server
from packwork.readers.svg_syntax.vocabulary import GRADIENTS, HREF

_COLOURING = GRADIENTS | {"filter"}
_OPACITIES = ("opacity", "fill-opacity", "stroke-opacity")
_PAINTS = ("fill", "stroke", "color")
_CLEAR = "rgba(0, 0, 0, 0)"
_BY_REFERENCE = frozenset({"inherit", "currentcolor", "context-fill", "context-stroke"})


def solid_twin(root: ET.Element, *, with_dashes: bool = True) -> ET.Element:
    """Copy of a clean drawing whose opacity is what it covers: a faint shape is a shape.

    Only what shapes a mask stays as it is, and pictures.

    Parameters
    ----------
    root
        Left as it is.
    with_dashes
        Whether dashed lines stay dashed.

    Examples
    --------
    >>> root = ET.fromstring('<svg><rect fill="red" opacity=".2"/><rect fill="none"/></svg>')
    >>> [shape.attrib for shape in solid_twin(root)]
    [{'fill': 'black'}, {'fill': 'none'}]
    """
    twin = copy.deepcopy(root)
    _harden(twin, elements_by_id(twin), with_dashes=with_dashes)
    if twin.find(".//mask") is None:
        _drop_unused(twin)
    return twin


def _harden(element: ET.Element, by_id: dict[str, ET.Element], *, with_dashes: bool) -> None:
    if element.tag == "mask":
        return
    for name in _OPACITIES:
        if opacity(element.get(name), 0.0) > 0:
            del element.attrib[name]
    for name in _PAINTS:
        if name in element.attrib:
            solid = _solid(element.attrib[name], by_id)
            element.set(name, _CLEAR if name == "color" and solid == "none" else solid)
    for name in ("style", "filter"):
        element.attrib.pop(name, None)
    if not with_dashes:
        element.attrib.pop("stroke-dasharray", None)
    for child in element:
        _harden(child, by_id, with_dashes=with_dashes)


def _drop_unused(twin: ET.Element) -> None:
    """Take out what only colours referred to."""
    for parent in list(twin.iter()):
        for child in list(parent):
            if child.tag in _COLOURING:
                parent.remove(child)


def _solid(paint: str, by_id: dict[str, ET.Element]) -> str:
    server = by_id.get(paint_server(paint) or "")
    if server is not None:
        if server.tag not in GRADIENTS:
            return paint
        return "black" if _shows(server, by_id) else "none"
    if paint.strip().lower() in _BY_REFERENCE:
        return paint
    return "none" if is_clear(paint) else "black"


def _shows(gradient: ET.Element, by_id: dict[str, ET.Element]) -> bool:
    """Whether any stop of a gradient, or of the one it is made after, is not clear."""
    while (stops := gradient.findall("stop")) == []:
        made_after = by_id.get(gradient.get(HREF, "")[1:])
        if made_after is None:
            return False
        gradient = made_after
    return any(
        opacity(stop.get("stop-opacity"), 1.0) > 0 and not is_clear(stop.get("stop-color", "black"))
        for stop in stops
    )
