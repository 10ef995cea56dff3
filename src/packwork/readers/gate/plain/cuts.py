"""Clip paths: CSS shapes (``circle()`` ...) to elements, and what browsers pass over."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

from packwork.readers.gate.css.selectors import split_outside
from packwork.readers.gate.plain.boxes import Box, fill_box, place_in
from packwork.readers.svg_syntax.lengths import parse_length
from packwork.readers.svg_syntax.page import Page, root_viewport
from packwork.readers.svg_syntax.references import elements_by_id
from packwork.readers.svg_syntax.vocabulary import HREF, SHAPES, TEXTS

CLIP = "clip-path"

_SHAPE = re.compile(
    r"\s*(circle|ellipse|inset|polygon|path|rect|xywh)\((.*)\)\s*([\w-]*)\s*", re.DOTALL
)
_QUOTED = re.compile(r"['\"](.*)['\"]", re.DOTALL)
_ROUND_LINES = frozenset({"", "border-box", "stroke-box", "margin-box"})
"""Boxes that hold the line too; without a word it is one of these."""


def settle_cuts(root: ET.Element, page: Page | None) -> None:
    """Give every shape that CSS cuts with an element of its own, in place.

    Examples
    --------
    >>> root = ET.fromstring('<svg><rect width="9" height="9" clip-path="circle(4px)"/></svg>')
    >>> settle_cuts(root, None)
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


def settle_stencils(root: ET.Element) -> None:
    """Take out of clip paths what browsers pass over there, in place: groups, and uses of these.

    Examples
    --------
    >>> root = ET.fromstring('<svg><clipPath id="c"><g/><path/></clipPath></svg>')
    >>> settle_stencils(root)
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
