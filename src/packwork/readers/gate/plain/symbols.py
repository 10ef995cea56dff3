"""Symbols whose place and size browsers heed and other programs do not: moved to their uses."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from packwork.readers.svg_syntax.lengths import parse_numbers
from packwork.readers.svg_syntax.references import elements_by_id
from packwork.readers.svg_syntax.vocabulary import HREF

_SIDES = ("width", "height")


def settle_symbols(root: ET.Element) -> None:
    """Give uses of symbols what these say of place and size, in place; drop those without area.

    Examples
    --------
    >>> text = '<symbol id="s" width="3" x="1" transform="scale(2)"><path/></symbol>'
    >>> root = ET.fromstring(f'<svg xmlns:xlink="l">{text}</svg>')
    >>> root.append(ET.Element("use", {"xlink:href": "#s", "x": "5"}))
    >>> settle_symbols(root)
    >>> root[0].attrib, root[1].get("transform"), root[1].get("width")
    ({'id': 's'}, 'translate(5 0) scale(2) translate(1 0)', '3')
    """
    for element in root.iter("svg"):
        if element.get("preserveAspectRatio", "").startswith("defer"):
            # Browsers do not know it any longer, so it is as if it were not there.
            del element.attrib["preserveAspectRatio"]
    by_id = elements_by_id(root)
    parents = {child: parent for parent in root.iter() for child in parent}
    for use in list(root.iter("use")):
        symbol = by_id.get(use.get(HREF, "")[1:])
        if symbol is None or symbol.tag not in {"symbol", "svg"}:
            continue
        if symbol.tag == "symbol":
            _move_to_use(symbol, use)
        if any(_number(use, side) == 0 for side in _SIDES) and use in parents:
            parents[use].remove(use)
    for symbol in root.iter("symbol"):
        for name in ("x", "y", "transform", *_SIDES):
            symbol.attrib.pop(name, None)


def _move_to_use(symbol: ET.Element, use: ET.Element) -> None:
    for side in _SIDES:
        if side in symbol.attrib:
            use.attrib.setdefault(side, symbol.attrib[side])
    if not {"x", "y", "transform"} & symbol.attrib.keys():
        return
    moves = [use.get("transform", ""), _shift(use), symbol.get("transform", ""), _shift(symbol)]
    for name in ("x", "y"):
        use.attrib.pop(name, None)
    use.set("transform", " ".join(filter(None, moves)))


def _shift(element: ET.Element) -> str:
    x, y = (_number(element, name) or 0.0 for name in ("x", "y"))
    return f"translate({x:.12g} {y:.12g})" if x or y else ""


def _number(element: ET.Element, name: str) -> float | None:
    numbers = parse_numbers(element.get(name))
    return numbers[0] if numbers else None
