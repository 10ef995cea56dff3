"""Parts of an SVG of ours that are drawn otherwise than measured: looks and places added by others.

Our files place each item by one ``transform`` and state what else they hold. Whatever a browser
reads besides (styles, strokes and markers of a copy, clips round the items) is named, and a file
that has any is not certified. Drawings themselves are followed with all that they say.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from packwork.geometry.lattice import Lattice
from packwork.geometry.polygon import Region
from packwork.phrasing import number_of
from packwork.readers.gate.sanitise import safe_value
from packwork.readers.layouts.arts import LINK
from packwork.readers.layouts.foreign_svg import (
    LOST_CONTAINER,
    LOST_ITEMS,
    declared,
    group_named,
    is_of_lines,
    layers_beside,
    tag,
    unmeasured,
)
from packwork.readers.layouts.sheet import tile_of
from packwork.readers.svg_syntax.coordinates import parse_length, parse_transform, view_box
from packwork.readers.svg_syntax.vocabulary import ATTRIBUTES, ELEMENTS, PROPERTIES, RENAMED

_COLOURING = frozenset({"fill", "fill-opacity", "color", "opacity", "display", "visibility"})
_HARMLESS = frozenset(
    {"id", "class", "style", "lang", "role", "tabindex", "cursor", "pointer-events",
     "shape-rendering", "image-rendering", "color-rendering", "enable-background"}
)  # fmt: skip
_OF_ROOT = frozenset(
    {"width", "height", "viewBox", "x", "y", "version", "baseProfile", "preserveAspectRatio",
     "zoomAndPan", "contentScriptType", "contentStyleType", "overflow"}
)  # fmt: skip
_OF_LINKS = frozenset({"href", "target", "rel", "type", "download", "hreflang"})
_OF_LINES = frozenset(
    {"stroke", "stroke-width", "stroke-opacity", "stroke-linejoin", "stroke-linecap",
     "stroke-miterlimit", "stroke-dasharray", "stroke-dashoffset", "paint-order", "fill-rule", "d",
     "points"}
)  # fmt: skip
_LONG = frozenset({"d", "points"})
_OF_DRAWINGS = ATTRIBUTES | _HARMLESS | {"href", "unicode-bidi"}
_MOVING = frozenset(
    {"transform", "translate", "rotate", "scale", "transform-origin", "transform-box"}
)
_GEOMETRY = frozenset({"d", "points", "x", "y", "cx", "cy", "r", "rx", "ry", "width", "height"})
"""Of styles; what is measured, and all that we write, has attributes instead."""

_SOURCES = frozenset({"path", "g", "image", "rect", "circle", "ellipse", "polygon"})
_ACTING = re.compile(r"animate\w*|set|script|foreignObject|handler|listener")
_SILENT = frozenset({"title", "desc", "metadata"})
_SPACES = ("", "{http://www.w3.org/2000/svg}")
_LINKED = re.compile(r"url\(\s*['\"]?#([^'\")\s]+)")
_HIDING = {
    "display": re.compile(r"none"), "visibility": re.compile(r"hidden|collapse"),
    "opacity": re.compile(r"-.*|[+]?[0.]+(e.*)?%?"), "fill": re.compile(r"none|transparent"),
}  # fmt: skip
_OWN_STYLE = re.compile(
    r"(?:@font-face\{[^{}]*\}|#items text\{font-kerning:normal;white-space:pre\}|\s"
    r"|@supports \(vector-effect:non-scaling-stroke\)\{@media screen\{\[data-lines=cut\] path,"
    r"path\[data-lines\],path\[data-item\]\{vector-effect:non-scaling-stroke;stroke-width:1px\}\}\})*"
)
_OWN_MOTION = re.compile(
    r'(?:\[id="[^"]*"\]\{animation:way-[^{};]*\}|\s'
    r"|@keyframes way-[\w-]+\{(?:[\d.]+%\{[^{}]*\})*\})*"
    r"@media \(prefers-reduced-motion:reduce\)\{[^{}]*\{animation:none!important\}\}\s*"
)
_MOTION = "items move: what is measured is the last picture"
_FILTERS = "what filters paint beyond the shapes is not measured"
_UNCOUNTED = "that all its items are there, as the file does not say how many (data-count)"

_SAME = 1e-6
"""Share by which sides of a page may differ. Larger than rounding, less than is seen. Chosen."""

Met: TypeAlias = tuple[str, str]
"""What is met, and of what."""


def examined(
    root: ET.Element, data: bytes, drawn: Sequence[ET.Element], sources: Sequence[ET.Element],
    container: Region, size: tuple[float, float],
) -> tuple[list[str], list[str]]:  # fmt: skip
    """Sentences about changes of a file, and about all of it that has to be believed.

    Of files without our groups, which promise nothing, only the latter. ``drawn`` and
    ``sources`` are the element of each item and the one that draws it; region and page size are
    in canvas units.

    Examples
    --------
    >>> import shapely
    >>> root = ET.fromstring('<svg><g id="items"/></svg>')
    >>> examined(root, b"", [], [], shapely.box(0, 0, 1, 1), (1.0, 1.0))[1]
    ['has no group named container any more: the page is taken for it']
    """
    items, walls = group_named(root, "items"), group_named(root, "container")
    lost = [*([LOST_ITEMS] if items is None else []), *([LOST_CONTAINER] if walls is None else [])]
    unseen = () if items is None else unmeasured(root)
    if lost:
        return [], [*unseen, *lost]
    changed = [*changes(root, data, drawn, sources), *cropped(container, size)]
    return changed, [*unseen, *believed(root)]


def changes(
    root: ET.Element, data: bytes, drawn: Sequence[ET.Element], sources: Sequence[ET.Element]
) -> list[str]:
    """Sentences about parts that are drawn otherwise than they are measured.

    Examples
    --------
    >>> text = '<svg><g id="container"/><g id="items"><path style="transform:scale(3)"/></g></svg>'
    >>> root = ET.fromstring(text)
    >>> item = root[1][0]
    >>> changes(root, text.encode(), [item], [item])
    ['item 1: style (transform) changes what is drawn, and is not measured']
    """
    met: dict[str, list[str]] = {}
    for what, where in (
        *_of_document(root, data),
        *_of_frame(root),
        *_of_items(root, drawn, sources),
    ):
        found = met.setdefault(what, [])
        if where not in found:
            found.append(where)
    lines = []
    for what, places in met.items():
        more = f" and {number_of(len(places) - 1, 'other')}" if len(places) > 1 else ""
        lines.append(f"{places[0]}{more}: {what} changes what is drawn, and is not measured")
    items = group_named(root, "items")
    stated = None if items is None else items.get("data-count")
    if stated is not None and stated.strip() != str(len(drawn)):
        known = stated[:9] if stated.strip().isdecimal() else f"{stated[:9]!r}"
        lines.append(f"{len(drawn)} of {known} items are in the file")
    return lines


def cropped(container: Region, size: tuple[float, float]) -> list[str]:
    """That a page does not hold its container, as ours do; else nothing.

    Examples
    --------
    >>> import shapely
    >>> cropped(shapely.box(0, 0, 4, 4), (4, 4)), len(cropped(shapely.box(0, 0, 4, 4), (3, 4)))
    ([], 1)
    """
    left, top, right, bottom = container.bounds
    width, height = size
    least = -_SAME * max(width, height)
    if min(left, top, width - right, height - bottom) >= least:
        return []
    return ["the page was cropped: the container reaches beyond it"]


def believed(root: ET.Element) -> list[str]:
    """Sentences about films, filters and missing counts, for which a file has to be believed.

    Examples
    --------
    >>> believed(ET.fromstring('<svg><g id="items" data-gap="0" data-count="2"/></svg>'))
    []
    """
    styles = [_text(e) for e in root.iter() if tag(e) == "style"]
    found = [_MOTION] if any(_OWN_MOTION.fullmatch(text) for text in styles) else []
    if any("filter" in e.attrib or "filter" in declared(e) for e in root.iter()):
        found.append(_FILTERS)
    items = group_named(root, "items")
    said = {} if items is None else items.attrib
    if "data-gap" in said and "data-count" not in said:
        found.append(_UNCOUNTED)
    return found


def _of_document(root: ET.Element, data: bytes) -> Iterator[Met]:
    # Of files in UTF-16, too.
    plain = data.replace(b"\0", b"")
    if b"<?xml-stylesheet" in plain:
        yield "the style sheet", "the file"
    if b"<!ATTLIST" in plain:
        yield "the list of attributes", "the file"
    for element in root.iter():
        name = tag(element)
        if name == "style":
            text = _text(element)
            if not (_OWN_STYLE.fullmatch(text) or _OWN_MOTION.fullmatch(text)):
                yield "the style sheet", "the file"
        elif _ACTING.fullmatch(name):
            yield f"the <{name}>", "the file"
        for key in element.attrib:
            if key[:2] == "on" and key.isalpha():
                yield key, f"a <{name}>"


def _of_frame(root: ET.Element) -> Iterator[Met]:
    """Changes that act on the page, the groups, and the copies of items elsewhere."""
    yield from _odd(root, _OF_ROOT | _COLOURING, "the page")
    yield from _page(root)
    for name in ("container", "items"):
        group = group_named(root, name)
        if group is None:
            continue
        more = frozenset() if name == "items" and not is_of_lines(group) else _OF_LINES
        hides = name == "items"
        yield from _odd(group, _COLOURING | {"transform"} | more, f"the group {name}", hides=hides)
        for line in () if hides else group:
            if tag(line) not in _SILENT:
                yield from _odd(line, _COLOURING | more, "the container's line", hides=False)
    for layer in layers_beside(root):
        is_engraved = layer.get("data-lines") == "engrave"
        for one in layer.iter() if is_engraved else (layer, *layer):
            where = "a layer of the nest" if one is layer else "what goes with a part"
            if tag(one) in {"g", "path"}:
                yield from _odd(one, _COLOURING | _OF_LINES | {"transform"}, where)
    if tile_of(root) and all(group.get("id") != "images" for group in root):
        yield "the lack of the group images", "the file"
    for group in root:
        if tag(group) in {"defs", "style"} or group.get("id") in {"items", "artwork"}:
            continue
        if group.get("id") == "images" and tile_of(root):
            yield from _of_images(root, group)
            continue
        for element in group.iter():
            if tag(element) == "use":
                yield "a copy of an item", "the file outside the group items"


def _of_images(root: ET.Element, group: ET.Element) -> Iterator[Met]:
    """Changes of the images of items that cross the edge of a tile."""
    view, items = view_box(root), group_named(root, "items")
    if view is None or items is None:
        return
    lattice = Lattice.of_canvas(view[2], view[3], str(tile_of(root)))
    names = {f"#{element.get('id')}" for element in items.iter() if "id" in element.attrib}
    seen = set[tuple[str, int, int]]()
    yield from _odd(group, frozenset(), "the group images")
    for image in group:
        yield from _odd(image, frozenset({"href", "transform"}), "an image beyond the edge")
        place = parse_transform(image.get("transform"))
        column = round(place[0, 2] / lattice.width)
        away = place[1, 2] - column * lattice.drop
        off = (place[0, 2] - column * lattice.width, math.remainder(away, lattice.height))
        is_moved = not np.array_equal(place[:, :2], np.eye(2))
        if is_moved or max(map(abs, off)) > _SAME * max(view[2:]):
            yield "its place", "an image beyond the edge"
        shown = image.get("href") or image.get(LINK) or ""
        seen.add((shown, column, round(away / lattice.height)))
        if tag(image) != "use" or shown not in names - {"#items"}:
            yield "what it shows", "an image beyond the edge"
    if group.get("data-count", "") != str(len(seen)) or len(seen) != len(group):
        yield "their number", "images beyond the edge"


def _page(root: ET.Element) -> Iterator[Met]:
    view, fit = view_box(root), root.get("preserveAspectRatio", "")
    if "none" in fit or "slice" in fit:
        yield "preserveAspectRatio", "the page"
    sides = [root.get(side, "") for side in ("width", "height")]
    if view is None or not all(sides) or any("%" in side for side in sides):
        return
    wide, high = (parse_length(side, 0.0) or 0.0 for side in sides)
    if abs(wide * view[3] - high * view[2]) > _SAME * wide * view[3]:
        yield "width and height, not in the proportion of the viewBox,", "the page"


def _of_items(
    root: ET.Element, drawn: Sequence[ET.Element], sources: Sequence[ET.Element]
) -> Iterator[Met]:
    first: dict[str, ET.Element] = {}
    for element in root.iter():
        first.setdefault(element.get("id", ""), element)
    group = group_named(root, "items")
    for outer in () if group is None else group:
        if outer not in drawn and tag(outer) == "a":
            yield from _odd(outer, _OF_LINKS, "a link")
    for layer in layers_beside(root):
        for one in layer if layer.get("data-lines") == "artwork" else ():
            yield from ((what, "artwork of a part") for what in _of_drawing(one, first))
    seen: set[ET.Element] = set()
    for number, (one, source) in enumerate(zip(drawn, sources, strict=True), start=1):
        name = one.get("data-name", "")
        where = f"item {number} ({name[:40]})" if name else f"item {number}"
        if source is not one:
            yield from _odd(one, _COLOURING | {"transform", "href"}, where)
            if "href" in one.attrib and LINK in one.attrib and one.get("href") != one.get(LINK):
                yield "the second link", where
            if first.get(source.get("id", "")) is not source:
                yield "the second drawing of one id", where
        if source not in seen:
            seen.add(source)
            yield from ((what, where) for what in _of_drawing(source, first))


def _of_drawing(source: ET.Element, first: Mapping[str, ET.Element]) -> Iterator[str]:
    name = tag(source)
    if name not in _SOURCES:
        yield f"the <{name}>"
    for key in declared(source).keys() & _MOVING:
        yield f"style ({key})"
    for key in source.attrib.keys() & (_MOVING - {"transform"}):
        yield key
    if _hides(source):
        yield "what hides it"
    own = set(source.iter())
    for element in own:
        space, _, local = str(element.tag).rpartition("}")
        if (space and f"{space}}}" not in _SPACES) or local in _SILENT | {"style"}:
            continue
        if local not in ELEMENTS | RENAMED.keys() and not _ACTING.fullmatch(local):
            yield f"the <{local}>"
        for key, value in element.attrib.items():
            if key in ATTRIBUTES - _LONG and value.strip():
                is_read = safe_value(value) is not None
            else:
                is_read = key in _OF_DRAWINGS or _is_foreign(key) or key[:2] == "on"
            if not is_read:
                yield key
        for key, value in declared(element).items():
            if not _is_colour_only(key, value) and not (
                key in PROPERTIES - _GEOMETRY and safe_value(value) is not None
            ):
                yield f"style ({key})"
        for target in _targets(element):
            there = first.get(target)
            if there is not None and there not in own and not _is_twin(there, own):
                yield f"what it takes from outside (#{target[:40]})"


def _odd(
    element: ET.Element, known: frozenset[str], where: str, *, hides: bool = True
) -> Iterator[Met]:
    """Attributes and styles of an element that are not known to change nothing."""
    for key, value in element.attrib.items():
        bare = "href" if key == LINK else key
        is_known = bare in known | _HARMLESS or _is_foreign(key) or bare[:2] == "on"
        if not (is_known or (bare in {"x", "y"} and parse_length(value, 0.0) == 0)):
            yield bare, where
    of_paint = known & (_COLOURING | _OF_LINES) - _GEOMETRY
    for key, value in declared(element).items():
        if key not in of_paint and not _is_colour_only(key, value):
            yield f"style ({key})", where
    if hides and _hides(element):
        yield "what hides it", where


def _is_colour_only(key: str, value: str) -> bool:
    """Whether a declaration moves and adds nothing, whatever it stands on."""
    if key in _COLOURING | _HARMLESS or key[:1] == "-" or key == "mix-blend-mode":
        return True
    return key == "isolation" or (key == "stroke" and value == "none")


def _is_foreign(key: str) -> bool:
    """Whether an attribute says nothing to a browser of how an element is drawn."""
    if key[:5] in {"data-", "aria-"}:
        return True
    return key[:1] == "{"


def _hides(element: ET.Element) -> bool:
    """Whether an element itself, or its style, lets nothing be seen."""
    looks = {**element.attrib, **declared(element)}
    if tag(element) not in {"path", "use"} or "stroke" in looks:
        looks.pop("fill", None)
    return any(rule.fullmatch(looks.get(key, "").strip()) for key, rule in _HIDING.items())


def _targets(element: ET.Element) -> Iterator[str]:
    for key, value in element.attrib.items():
        if key in {"href", LINK}:
            if value.strip().startswith("#"):
                yield value.strip()[1:]
        elif "url(" in value:
            yield from _LINKED.findall(value)


def _is_twin(there: ET.Element, own: set[ET.Element]) -> bool:
    """Whether an element of the same id in a drawing says the same."""
    text = ET.tostring(there).strip()
    return any(e.get("id") == there.get("id") and ET.tostring(e).strip() == text for e in own)


def _text(element: ET.Element) -> str:
    return "".join(element.itertext())
