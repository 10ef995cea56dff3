"""References inside a clean drawing: lookup, dangling ones, unused elements, pictures."""

from __future__ import annotations

import base64
import binascii
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator

from packwork.readers.pictures.decode import picture_size
from packwork.readers.svg_syntax.coordinates import parse_numbers
from packwork.readers.svg_syntax.vocabulary import (
    GRADIENTS,
    GROUPS,
    HREF,
    NEVER_DRAWN,
    SHAPES,
    TEXTS,
)

MAX_ENCODED = 15_000_000
"""Letters of one embedded picture in base64, about 11 MB of file. Chosen."""

_HEAD = re.compile(r"data:image/(png|jpeg|jpg|webp|gif)\s*;\s*base64\s*,", re.IGNORECASE)


def embedded_size(reference: str) -> tuple[int, int] | None:
    """Width and height in pixels of an embedded picture, None if it is not usable."""
    data = embedded_bytes(reference)
    return None if data is None else picture_size(data)


def embedded_bytes(reference: str) -> bytes | None:
    """Bytes of an embedded picture."""
    head = _HEAD.match(reference)
    if head is None or len(reference) > MAX_ENCODED:
        return None
    try:
        return base64.b64decode(re.sub(r"\s+", "", reference[head.end() :]), validate=True)
    except (binascii.Error, ValueError):
        return None


_URL = re.compile(r"url\(#([^()]+)\)")
_PAINTS = GRADIENTS | {"pattern"}
_PAINT_NAMES = frozenset({"fill", "stroke"})
_UNSEEN = frozenset({"clipPath", "mask", "pattern", "marker"})
_USABLE = SHAPES | GROUPS | TEXTS | {"image"}
_TARGETS = {
    "fill": _PAINTS,
    "stroke": _PAINTS,
    "clip-path": {"clipPath"},
    "mask": {"mask"},
    "filter": {"filter"},
    "marker-start": {"marker"},
    "marker-mid": {"marker"},
    "marker-end": {"marker"},
}


def elements_by_id(root: ET.Element) -> dict[str, ET.Element]:
    """First element of each id, in document order.

    >>> list(elements_by_id(ET.fromstring('<svg><g id="a"/><g/></svg>')))
    ['a']
    """
    found: dict[str, ET.Element] = {}
    for element in root.iter():
        if "id" in element.attrib:
            found.setdefault(element.attrib["id"], element)
    return found


def referenced_ids(element: ET.Element) -> Iterator[tuple[str, str]]:
    """Attribute and id for each reference the element itself makes.

    >>> list(referenced_ids(ET.Element("g", {"fill": "url(#a) red"})))
    [('fill', 'a')]
    """
    for name, value in element.attrib.items():
        if name == HREF and value.startswith("#"):
            yield name, value[1:]
        elif "url(" in value:
            for target in _URL.findall(value):
                yield name, target


def paint_server(value: str) -> str | None:
    """Id of the gradient or pattern that a paint names, None for a colour."""
    match = _URL.match(value)
    return None if match is None else match.group(1)


def rename_references(element: ET.Element, renamed: Callable[[str], str]) -> None:
    """Rewrite the element's own id and all ids it refers to, in place.

    >>> use = ET.Element("use", {"id": "u", "xlink:href": "#a"})
    >>> rename_references(use, lambda name: "x-" + name)
    >>> use.attrib
    {'id': 'x-u', 'xlink:href': '#x-a'}
    """
    for name, value in element.attrib.items():
        if name == "id":
            element.attrib[name] = renamed(value)
        elif name == HREF and value.startswith("#"):
            element.attrib[name] = "#" + renamed(value[1:])
        elif "url(" in value:
            element.attrib[name] = _URL.sub(lambda m: f"url(#{renamed(m.group(1))})", value)


def drop_dangling(root: ET.Element) -> None:
    """Take out references to nothing or to the wrong kind; paints fall back, in place.

    Programs disagree about them: some hide the element, some paint it black. Patterns
    may paint plain shapes only, whose size is known, not what masks and groups hold.

    >>> root = ET.fromstring('<svg><path fill="url(#none) red" mask="url(#none)"/></svg>')
    >>> drop_dangling(root)
    >>> root[0].attrib
    {'fill': 'red'}
    """
    _drop_dangling(root, elements_by_id(root), is_seen=True)


def prune_hidden(root: ET.Element) -> None:
    """Take out what never shows where it stands, in place: hidden layers, lost pictures.

    What something refers to stays.

    >>> root = ET.fromstring('<svg><g display="none"><text>a</text></g><image/><g/></svg>')
    >>> prune_hidden(root)
    >>> ET.tostring(root).decode()
    '<svg><g /></svg>'
    """
    used = {target for element in root.iter() for _, target in referenced_ids(element)}
    for parent in list(root.iter()):
        for child in list(parent):
            is_hidden = child.get("display") == "none" and child.tag not in NEVER_DRAWN
            is_lost = child.tag == "image" and HREF not in child.attrib
            is_lost |= child.tag == "svg" and _is_flat(child)
            if (is_hidden or is_lost) and not any(e.get("id") in used for e in child.iter()):
                parent.remove(child)


def _is_flat(element: ET.Element) -> bool:
    """Whether a viewport has no width or no height; viewers differ about these."""
    sides = (parse_numbers(element.get(name)) for name in ("width", "height"))
    return any(side and side[0] <= 0 for side in sides)


def prune_unused(root: ET.Element) -> None:
    """Take out never-drawn elements that nothing drawn refers to, and ids without use, in place.

    >>> text = '<svg><defs><path id="a"/><g id="b"/></defs><g fill="url(#a)" id="c"/></svg>'
    >>> root = ET.fromstring(text)
    >>> prune_unused(root)
    >>> ET.tostring(root).decode()
    '<svg><defs><path id="a" /></defs><g fill="url(#a)" /></svg>'
    """
    used = _reachable(root)
    first = elements_by_id(root)
    for parent in root.iter():
        for child in list(parent):
            if child.tag in NEVER_DRAWN:
                _prune(parent, child, used)
    for element in root.iter():
        name = element.get("id", "")
        if name not in used or first[name] is not element:
            element.attrib.pop("id", None)


def _drop_dangling(element: ET.Element, by_id: dict[str, ET.Element], *, is_seen: bool) -> None:
    for name, target in list(referenced_ids(element)):
        found = by_id.get(target)
        if found is None or not _fits(element, name, found):
            _detach(element, name, "none")
        elif name != HREF and found.tag == "pattern" and not (is_seen and element.tag in SHAPES):
            _detach(element, name, "gray")
    for child in element:
        _drop_dangling(child, by_id, is_seen=is_seen and child.tag not in _UNSEEN)


def _fits(element: ET.Element, name: str, target: ET.Element) -> bool:
    if name in _TARGETS:
        return target.tag in _TARGETS[name]
    if name != HREF:
        return False
    if element.tag in _PAINTS:
        return target.tag in _PAINTS
    if element.tag == "textPath":
        return target.tag in SHAPES
    return element.tag == "use" and target.tag in _USABLE


def _detach(element: ET.Element, name: str, otherwise: str) -> None:
    fallback = _URL.sub("", element.attrib.pop(name)).strip()
    if name in _PAINT_NAMES:
        element.set(name, fallback or otherwise)


def _reachable(root: ET.Element) -> set[str]:
    """Ids that drawn elements refer to, directly or through others."""
    by_id = elements_by_id(root)
    used: set[str] = set()
    waiting = list(_drawn(root))
    while waiting:
        for _, target in referenced_ids(waiting.pop()):
            if target not in used and target in by_id:
                used.add(target)
                waiting.extend(by_id[target].iter())
    return used


def _drawn(element: ET.Element) -> Iterator[ET.Element]:
    yield element
    for child in element:
        if child.tag not in NEVER_DRAWN:
            yield from _drawn(child)


def _prune(parent: ET.Element, element: ET.Element, used: set[str]) -> None:
    """Drop ``element`` from ``parent`` unless it or something inside it is used."""
    if element.get("id") in used:
        return
    for child in list(element):
        _prune(element, child, used)
    if len(element) == 0:
        parent.remove(element)
