"""Text elements of a clean drawing to paths, so that no viewer's fonts decide how they look.

Each text is rendered by itself in its own units, black and large, and its edge followed;
the path takes the place and the paints of the text. Letters of several paints in one
text become several paths, each rendered while the others are hidden.
"""

from __future__ import annotations

import copy
import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence
from typing import TypeAlias

import numpy as np
import shapely

from packwork.fonts import replaced_families
from packwork.geometry import affine
from packwork.geometry.polygon import Region, oriented_rings
from packwork.readers.reading import left, notice, spend
from packwork.readers.svg.resvg import FIND_PX, View, coverage, inked
from packwork.readers.svg.walk import placed_texts
from packwork.readers.svg_syntax.coordinates import Page, parse_length, parse_numbers
from packwork.readers.svg_syntax.painted import PlacedText
from packwork.readers.svg_syntax.references import elements_by_id, referenced_ids
from packwork.readers.svg_syntax.vocabulary import NEVER_DRAWN

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

    >>> paints_of(ET.fromstring('<text fill="red">a<tspan fill="blue">b</tspan>c</text>'))
    [(), (('fill', 'blue'),)]
    """
    return list(dict.fromkeys(paint for element, paint in _painted(text, ()) if _letters(element)))


def stage_of(text: PlacedText, paint: Paint, by_id: dict[str, ET.Element]) -> ET.Element:
    """Drawing of the letters of one paint of a text in black, in the text's own units.

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
    """Text of the element itself, not of its parts."""
    return ((element.text or "") + "".join(child.tail or "" for child in element)).strip()


MAX_TEXTS = 60
"""Texts, or differently painted parts of them, that become paths: each costs two
pictures. Drawings of more keep their texts. Chosen."""

LETTER_PX = 400
"""Side of the square of pixels that each letter gets: larger costs time by its square, smaller
shows the renderer's rounding as a wobble. Tried."""

MAX_PIXELS = 4_000_000
"""Pixels of all letters together: about half a second's work. Chosen."""

LEAST_LETTER_PX = 60
"""Side of a letter's square below which its text stays text. Chosen."""

_TEXT_NS, _PIXEL_NS, _SHARE = 2e7, 400.0, 0.6
"""For the two pictures of a text, and for a pixel that is followed; and the share of the
budget that texts may take. Measured."""

MAX_SIDE_PX = 8_000
"""Longer side of the picture of one text. Chosen."""

_SIMPLIFY_PX = 0.2
"""Larger flattens curves, smaller keeps the wobble and thrice the points. Tried."""

_STEP_PX = 0.02
_FONT_PX = 16.0


def set_in_outlines(root: ET.Element, page: Page | None) -> None:
    """Replace the texts of a clean drawing by paths, in place; says which fonts it missed.

    Texts inside masks and patterns, those in ``defs``, and where there are more than
    ``MAX_TEXTS``, or too few pixels for each letter, all of them stay as they are, which is said.

    >>> from packwork.readers.svg_syntax.coordinates import read_page
    >>> root = ET.fromstring('<svg viewBox="0 0 9 9"><text y="8" fill="red">a</text></svg>')
    >>> set_in_outlines(root, read_page(root))
    >>> root[0].tag, root[0].get("fill"), root[0].get("d")[0]
    ('path', 'red', 'M')
    """
    if root.find(".//text") is None:
        return
    texts = placed_texts(root, page)
    letters = "".join(letter for text in texts for letter in text.element.itertext())
    count = sum(len(paints_of(text.element)) for text in texts)
    most = min(MAX_PIXELS, LETTER_PX**2 * max(1, len(letters)))
    pixels = min(most, (_SHARE * left("shapes") - _TEXT_NS * count) / _PIXEL_NS)
    if count <= MAX_TEXTS and pixels >= LEAST_LETTER_PX**2 * len(letters):
        spend(_TEXT_NS * count + _PIXEL_NS * pixels, "has too much text")
        _set(texts, letters, root, page, pixels)
    for hidden in _drawn_texts(root, {text.element for text in texts}):
        hidden.clear()
        hidden.tag = "g"
    if root.find(".//text") is not None:
        notice("some of its text stays text, which every viewer sets in fonts of its own")


def _set(
    texts: Sequence[PlacedText], letters: str, root: ET.Element, page: Page | None, pixels: float
) -> None:
    for wanted, found in replaced_families(_wishes(texts)).items():
        notice(f"the font {wanted!r} is not installed; its letters are set in {found!r}")
    letter_px = min(float(LETTER_PX), math.sqrt(pixels / max(1, len(letters))))
    by_id = elements_by_id(root)
    for text in texts:
        _replace(text, page, by_id, letter_px)


def _replace(
    text: PlacedText,
    page: Page | None,
    by_id: dict[str, ET.Element],
    letter_px: float,
) -> None:
    """Turn a text into a path, or a group of paths if its letters differ in paint."""
    element = text.element
    paths: list[ET.Element] = []
    for paint in paints_of(element):
        data = _outlines(stage_of(text, paint, by_id), text, _view(text, page), letter_px)
        if data:
            paths.append(ET.Element("path", {**dict(paint), "fill-rule": "evenodd", "d": data}))
    kept = {name: value for name, value in element.attrib.items() if name in PLACED}
    element.clear()
    element.tag, element.attrib = "g", kept
    if len(paths) == 1 and not kept.keys() & paths[0].attrib.keys():
        element.tag = "path"
        element.attrib |= paths[0].attrib
    else:
        element.extend(paths)


def _outlines(stage: ET.Element, text: PlacedText, view: View | None, letter_px: float) -> str:
    """Path data of what the stage shows, in the text's own units; empty if nothing."""
    from packwork.readers.pictures.contours import contour_region

    page = Page(*text.viewport, affine.identity())
    part = view and inked(coverage(stage, page, view, FIND_PX), view)
    if part is None:
        return ""
    letters = len("".join(text.element.itertext()))
    px = max(math.sqrt(part[2] * part[3] / letters) / letter_px, max(part[2:]) / MAX_SIDE_PX)
    side = max(1, math.ceil(max(part[2:]) / px))
    px = max(part[2:]) / side
    traced = contour_region(coverage(stage, page, part, side), _SIMPLIFY_PX)
    placed = shapely.transform(traced, lambda points: points * px + part[:2])
    return path_data(placed, px * _STEP_PX)


def path_data(region: Region, step: float) -> str:
    """Path data of a region's rings, rounded to about ``step``.

    >>> path_data(shapely.box(0, 0, 1, 2.004), 0.01)
    'M1 0 1 2 0 2 0 0z'
    """
    digits = max(0, math.ceil(-math.log10(step)))
    rings = [np.round(ring, digits) + 0.0 for ring in oriented_rings(region)]
    numbers = [" ".join(f"{value:.15g}" for value in ring.ravel().tolist()) for ring in rings]
    return "".join(f"M{ring}z" for ring in numbers)


def _view(text: PlacedText, page: Page | None) -> View | None:
    """Box, in the text's own units, that holds all that can show; None if nothing can."""
    if page is None:
        return _reach(text.element)
    matrix = text.matrix[:, :2]
    if abs(np.linalg.det(matrix)) < 1e-12 * np.abs(matrix).max() ** 2:
        return None
    corners = np.array([(0, 0), (page.width, 0), (page.width, page.height), (0, page.height)])
    local = np.linalg.solve(matrix, (corners - text.matrix[:, 2]).T).T
    (left, top), (width, height) = local.min(axis=0).tolist(), np.ptp(local, axis=0).tolist()
    return left, top, width, height


def _reach(text: ET.Element) -> View:
    """As far as the letters could stand from where the text begins, on no page."""
    numbers = [parse_numbers(e.get(name)) for e in text.iter() for name in ("x", "y", "dx", "dy")]
    sizes = [parse_length(e.get("font-size"), _FONT_PX) or _FONT_PX for e in text.iter()]
    width = max(_FONT_PX, *sizes) * (1 + len("".join(text.itertext())))
    reach = sum(abs(number) for each in numbers for number in each) + width
    return -reach, -reach, 2 * reach, 2 * reach


def _drawn_texts(element: ET.Element, but: set[ET.Element]) -> list[ET.Element]:
    """Texts among drawn elements that were neither placed nor referred to."""
    if element.tag == "text":
        return [] if element in but or "id" in element.attrib else [element]
    drawn = (child for child in element if child.tag not in NEVER_DRAWN)
    return [text for child in drawn for text in _drawn_texts(child, but)]


def _wishes(texts: Sequence[PlacedText]) -> Iterable[str]:
    """Lists of families that the texts, or whatever is around them, ask for."""
    elements = [e for text in texts for e in (*text.above, *text.element.iter())]
    return dict.fromkeys(e.attrib["font-family"] for e in elements if "font-family" in e.attrib)
