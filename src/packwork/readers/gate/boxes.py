"""Clip shapes and transforms of CSS, which refer to boxes of elements, as plain SVG.

``circle()`` and the like become elements of clip paths; ``translate``, ``rotate``, ``scale``,
``transform-origin`` and ``transform-box`` become one matrix, which all programs read.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.gate.css.selectors import split_outside
from packwork.readers.reading import spend
from packwork.readers.svg_syntax.coordinates import (
    Page,
    Viewport,
    parse_length,
    parse_numbers,
    parse_transform,
    root_viewport,
    view_box,
)
from packwork.readers.svg_syntax.references import elements_by_id
from packwork.readers.svg_syntax.shapes import flattened_all, shape_pieces
from packwork.readers.svg_syntax.vocabulary import CSS_MOVES, HREF, NEVER_DRAWN, SHAPES, TEXTS

MAX_DEPTH = 12
"""Uses inside one another that are followed. Chosen."""

_SHAPE_NS = 4e5
_FINE = 1e-4
_EDGES = {"left": 0.0, "top": 0.0, "center": 0.5, "right": 1.0, "bottom": 1.0}

Box = tuple[float, float, float, float]
"""Left, top, width and height."""


def fill_box(element: ET.Element, by_id: dict[str, ET.Element], viewport: Viewport) -> Box | None:
    """Box round the fills of an element and what is in it; None if there are none.

    Text counts for nothing.

    >>> group = ET.fromstring('<g><rect width="4" height="2" transform="scale(2)"/></g>')
    >>> fill_box(group, {}, (9.0, 9.0))
    (0.0, 0.0, 8.0, 4.0)
    """
    points = _points(element, by_id, viewport, 0)
    if len(points) == 0:
        return None
    (left, top), (width, height) = points.min(axis=0).tolist(), np.ptp(points, axis=0).tolist()
    return left, top, width, height


def place_in(box: Box, words: Sequence[str]) -> tuple[float, float]:
    """Point of a box that CSS names by up to two words, across and down, or the other way round.

    >>> place_in((10.0, 0.0, 4.0, 8.0), ["top"]), place_in((10.0, 0.0, 4.0, 8.0), ["25%", "1"])
    ((12.0, 0.0), (11.0, 1.0))
    """
    across, down = [*words, "center", "center"][:2]
    if across in {"top", "bottom"} or down in {"left", "right"}:
        across, down = down, across
    x, y = (
        box[k] + (_EDGES[w] * box[2 + k] if w in _EDGES else parse_length(w, box[2 + k]) or 0.0)
        for k, w in enumerate((across, down))
    )
    return x, y


def _points(
    element: ET.Element, by_id: dict[str, ET.Element], viewport: Viewport, depth: int
) -> FloatArray:
    """Points that lie within the box and reach its sides."""
    spend(_SHAPE_NS, "refers to the boxes of too many shapes")
    nothing = np.empty((0, 2))
    if element.get("display") == "none" or depth > MAX_DEPTH:
        return nothing
    if element.tag in SHAPES or element.tag == "image":
        return _shape(element, viewport)
    children: list[ET.Element] = [c for c in element if c.tag not in NEVER_DRAWN]
    moved = affine.identity()
    if element.tag == "use":
        target = by_id.get(element.get(HREF, "")[1:])
        children, depth = ([] if target is None else [target]), depth + 1
        x, y = (parse_length(element.get(n), viewport[k]) or 0.0 for k, n in enumerate("xy"))
        moved = affine.similarity(x, y, 0.0, 1.0)
    parts = [nothing]
    for child in children:
        own = affine.compose(moved, parse_transform(child.get("transform")))
        parts.append(affine.apply(own, _points(child, by_id, viewport, depth)))
    return np.concatenate(parts)


def _shape(element: ET.Element, viewport: Viewport) -> FloatArray:
    if element.tag == "image":
        names = (("x", 0), ("y", 1), ("width", 0), ("height", 1))
        x, y, w, h = (parse_length(element.get(n), viewport[k]) or 0.0 for n, k in names)
        return np.array([(x, y), (x + w, y + h)])
    pieces = shape_pieces(element, viewport)
    if not pieces:
        return np.empty((0, 2))
    controls = np.concatenate([piece.segments.reshape(-1, 2) for piece in pieces])
    if len(controls) == 0:
        return np.array([piece.start for piece in pieces])
    tolerance = max(float(np.ptp(controls, axis=0).max()) * _FINE, 1e-9)
    return np.concatenate(flattened_all(pieces, tolerance))


CLIP = "clip-path"

_SHAPE = re.compile(
    r"\s*(circle|ellipse|inset|polygon|path|rect|xywh)\((.*)\)\s*([\w-]*)\s*", re.DOTALL
)
_QUOTED = re.compile(r"['\"](.*)['\"]", re.DOTALL)
_ROUND_LINES = frozenset({"", "border-box", "stroke-box", "margin-box"})
"""Boxes that hold the line too; without a word it is one of these."""


def resolve_clip_shapes(root: ET.Element, page: Page | None) -> None:
    """Give every shape that CSS cuts with an element of its own, in place.

    >>> root = ET.fromstring('<svg><rect width="9" height="9" clip-path="circle(4px)"/></svg>')
    >>> resolve_clip_shapes(root, None)
    >>> ET.tostring(root[1][0]).decode(), root[0].get("clip-path")
    ('<circle cx="4.5" cy="4.5" r="4" />', 'url(#cut-1)')
    """
    cut = [e for e in root.iter() if CLIP in e.attrib and "url(" not in e.attrib[CLIP]]
    if not cut:
        return
    by_id = elements_by_id(root)
    parents = {child: parent for parent in root.iter() for child in parent}
    viewport = root_viewport(root, page)
    for element in cut:
        match = _SHAPE.fullmatch(element.attrib.pop(CLIP))
        if match is None:
            continue
        whole: Box = (0.0, 0.0, *viewport)
        box = whole if match[3] == "view-box" else fill_box(element, by_id, viewport) or whole
        if match[3] in _ROUND_LINES:
            box = _widened(box, _line_width(element, parents))
        name = next(n for n in (f"cut-{k}" for k in range(1, 10**6)) if n not in by_id)
        clip = ET.SubElement(root, "clipPath", {"id": name})
        clip.append(_stencil(match[1], match[2], box))
        by_id[name] = clip
        element.set(CLIP, f"url(#{name})")


def prune_clip_paths(root: ET.Element) -> None:
    """Take out of clip paths what browsers pass over there, in place: groups, and uses of these.

    >>> root = ET.fromstring('<svg><clipPath id="c"><g/><path/></clipPath></svg>')
    >>> prune_clip_paths(root)
    >>> [child.tag for child in root[0]]
    ['path']
    """
    clips = list(root.iter("clipPath"))
    by_id = elements_by_id(root) if clips else {}
    for clip in clips:
        for child in list(clip):
            meant = by_id.get(child.get(HREF, "")[1:]) if child.tag == "use" else child
            if meant is None or meant.tag not in SHAPES | TEXTS:
                clip.remove(child)


def _line_width(element: ET.Element, parents: dict[ET.Element, ET.Element]) -> float:
    """Width of the line that an element is drawn with, 0 if it has none."""
    above: ET.Element | None = element
    found: dict[str, str] = {}
    while above is not None:
        for name in ("stroke", "stroke-width"):
            if name in above.attrib:
                found.setdefault(name, above.attrib[name])
        above = parents.get(above)
    if found.get("stroke", "none") == "none":
        return 0.0
    return parse_length(found.get("stroke-width", "1"), 0.0) or 0.0


def _widened(box: Box, width: float) -> Box:
    left, top = box[0] - width / 2, box[1] - width / 2
    return left, top, box[2] + width, box[3] + width


def _stencil(kind: str, text: str, box: Box) -> ET.Element:
    if kind in {"circle", "ellipse"}:
        return _round(kind, text, box)
    if kind == "polygon":
        return _polygon(text, box)
    if kind == "path":
        quoted = _QUOTED.search(text)
        rule = "evenodd" if text.lstrip().startswith("evenodd") else "nonzero"
        data = quoted[1] if quoted else ""
        move = f"translate({box[0]:.12g} {box[1]:.12g})"
        return ET.Element("path", {"d": data, "clip-rule": rule, "transform": move})
    return _rectangle(kind, text, box)


def _round(kind: str, text: str, box: Box) -> ET.Element:
    radii, _, place = text.partition("at ")
    x, y = place_in(box, place.split())
    sides = (x - box[0], box[0] + box[2] - x, y - box[1], box[1] + box[3] - y)
    diagonal = ((box[2] ** 2 + box[3] ** 2) / 2) ** 0.5
    words = radii.split() or ["closest-side"]
    if kind == "circle":
        words = words[:1]
        ends = {"closest-side": min(map(abs, sides)), "farthest-side": max(map(abs, sides))}
        return _element("circle", cx=x, cy=y, r=_radius(words[0], diagonal, ends))
    found = []
    for k in range(2):
        near = [abs(side) for side in sides[2 * k : 2 * k + 2]]
        ends = {"closest-side": min(near), "farthest-side": max(near)}
        found.append(_radius(words[k % len(words)], box[2 + k], ends))
    return _element("ellipse", cx=x, cy=y, rx=found[0], ry=found[1])


def _radius(word: str, whole: float, ends: dict[str, float]) -> float:
    return ends[word] if word in ends else max(0.0, parse_length(word, whole) or 0.0)


def _polygon(text: str, box: Box) -> ET.Element:
    parts = [part.split() for part in split_outside(text, ",")]
    rule = parts.pop(0)[0] if parts and parts[0] in (["evenodd"], ["nonzero"]) else "nonzero"
    points = [place_in(box, part) for part in parts if len(part) == 2]
    written = " ".join(f"{x:.12g},{y:.12g}" for x, y in points)
    return ET.Element("polygon", {"points": written, "clip-rule": rule})


def _rectangle(kind: str, text: str, box: Box) -> ET.Element:
    lengths, _, corner = text.partition("round")
    words = (lengths.split() or ["0"])[:4]
    left, top, width, height = box
    if kind == "xywh":
        x, y, w, h = (parse_length(t, box[2 + k % 2]) or 0.0 for k, t in enumerate(words))
        left, top, width, height = left + x, top + y, w, h
    else:
        # Top, right, bottom, left, those left out as in any list of four sides.
        full = [
            words[k] for k in ((0,) * 4, (0, 1, 0, 1), (0, 1, 2, 1), (0, 1, 2, 3))[len(words) - 1]
        ]
        t, r, b, s = (parse_length(word, box[3 - k % 2]) or 0.0 for k, word in enumerate(full))
        if kind == "rect":
            r, b = box[2] - r, box[3] - b
        left, top, width, height = left + s, top + t, width - s - r, height - t - b
    radius = parse_length((corner.split() or ["0"])[0], min(box[2:])) or 0.0
    sides = {"x": left, "y": top, "width": max(width, 0.0), "height": max(height, 0.0)}
    return _element("rect", **sides, rx=radius)


def _element(tag: str, **numbers: float) -> ET.Element:
    return ET.Element(tag, {name: f"{number:.12g}" for name, number in numbers.items()})


_SIZES = ("width", "height")


def resolve_symbols(root: ET.Element) -> None:
    """Give uses of symbols what these say of place and size, in place; drop those without area.

    >>> text = '<symbol id="s" width="3" x="1" transform="scale(2)"><path/></symbol>'
    >>> root = ET.fromstring(f'<svg xmlns:xlink="l">{text}</svg>')
    >>> root.append(ET.Element("use", {"xlink:href": "#s", "x": "5"}))
    >>> resolve_symbols(root)
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
        if any(_number(use, side) == 0 for side in _SIZES) and use in parents:
            parents[use].remove(use)
    for symbol in root.iter("symbol"):
        for name in ("x", "y", "transform", *_SIZES):
            symbol.attrib.pop(name, None)


def _move_to_use(symbol: ET.Element, use: ET.Element) -> None:
    for side in _SIZES:
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


def resolve_transforms(root: ET.Element, page: Page | None) -> None:
    """Write every transform of a clean drawing as one attribute, in place.

    >>> root = ET.fromstring('<svg><g transform-origin="2 0" transform="scale(2)"/></svg>')
    >>> resolve_transforms(root, None); root[0].attrib
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
