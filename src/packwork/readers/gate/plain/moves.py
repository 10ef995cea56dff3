"""CSS transforms, and symbols with a place, to the ``transform`` attribute that all programs read.

``translate``, ``rotate``, ``scale``, ``transform-origin`` and ``transform-box``, shares and
lengths inside, all become one matrix.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.gate.plain.boxes import Box, fill_box, place_in
from packwork.readers.svg_syntax.lengths import parse_length, parse_numbers
from packwork.readers.svg_syntax.page import Page, root_viewport, view_box
from packwork.readers.svg_syntax.references import elements_by_id
from packwork.readers.svg_syntax.transforms import parse_transform
from packwork.readers.svg_syntax.vocabulary import CSS_MOVES, HREF

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


ORIGIN, BOX = "transform-origin", "transform-box"

_SHARED = re.compile(r"(translate[xy]?)\s*\(([^()]*%[^()]*)\)", re.IGNORECASE)
_OWN_BOXES = frozenset({"fill-box", "stroke-box", "content-box", "border-box"})


def settle_moves(root: ET.Element, page: Page | None) -> None:
    """Write every transform of a clean drawing as one attribute, in place.

    Examples
    --------
    >>> root = ET.fromstring('<svg><g transform-origin="2 0" transform="scale(2)"/></svg>')
    >>> settle_moves(root, None); root[0].attrib
    {'transform': 'matrix(2 0 0 2 -2 0)'}
    """
    if not any(_is_special(element) for element in root.iter()):
        return
    _settle(root, elements_by_id(root), root_viewport(root, page))


def _is_special(element: ET.Element) -> bool:
    attributes = element.attrib
    if ORIGIN in attributes or BOX in attributes or CSS_MOVES & attributes.keys():
        return True
    return "%" in attributes.get("transform", "")


def _settle(
    element: ET.Element, by_id: dict[str, ET.Element], viewport: tuple[float, float]
) -> None:
    inner = view_box(element) if element.tag in {"svg", "symbol"} else None
    for child in element:
        _settle(child, by_id, (inner[2], inner[3]) if inner else viewport)
    if not _is_special(element):
        return
    origin, box_word = element.attrib.pop(ORIGIN, None), element.attrib.pop(BOX, "")
    box: Box = (0.0, 0.0, *viewport)
    if box_word in _OWN_BOXES:
        box = fill_box(element, by_id, viewport) or box
    own = _SHARED.sub(lambda call: _unshared(call, box), element.get("transform", ""))
    matrix = affine.identity()
    for name, read in _READERS.items():
        matrix = affine.compose(matrix, read(element.attrib.pop(name, "none"), box))
    matrix = affine.compose(matrix, parse_transform(own))
    x, y = place_in(box, (origin or "0 0").lower().split())
    there, back = affine.similarity(x, y, 0.0, 1.0), affine.similarity(-x, -y, 0.0, 1.0)
    numbers = affine.compose(affine.compose(there, matrix), back).T.ravel()
    element.set("transform", f"matrix({' '.join(f'{number:.12g}' for number in numbers)})")


def _unshared(call: re.Match[str], box: Box) -> str:
    """A translation by shares of a box as one by lengths."""
    sides = (3, 3) if call[1].lower().endswith("y") else (2, 3)
    words = call[2].replace(",", " ").split()
    lengths = [parse_length(w, box[side]) or 0.0 for w, side in zip(words, sides, strict=False)]
    return f"{call[1]}({' '.join(f'{length:.12g}' for length in lengths)})"


def _translated(text: str, box: Box) -> FloatArray:
    words = text.split()
    x, y = (parse_length(w, box[2 + k]) or 0.0 for k, w in enumerate((*words, "0", "0")[:2]))
    return affine.similarity(x, y, 0.0, 1.0)


def _turned(text: str, _: Box) -> FloatArray:
    words = text.split()
    return parse_transform(f"rotate({words[-1]})") if words and words[-1] != "none" else _NOTHING


def _scaled(text: str, _: Box) -> FloatArray:
    shares = [parse_length(word, 1.0) for word in text.split()[:2]]
    known = [share for share in shares if share is not None]
    return _NOTHING if not known else np.array([[known[0], 0.0, 0.0], [0.0, known[-1], 0.0]])


_NOTHING = affine.identity()
_READERS = {"css-translate": _translated, "css-rotate": _turned, "css-scale": _scaled}
