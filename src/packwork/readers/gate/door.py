"""Entrance of all SVG files and of their named parts: nothing else parses them."""

from __future__ import annotations

import copy
import re
import xml.etree.ElementTree as ET
import zlib

from packwork.readers.budget.expansion import bound_expansion, check_size
from packwork.readers.budget.filters import settle_filters
from packwork.readers.gate.plain.cuts import settle_cuts, settle_stencils
from packwork.readers.gate.plain.moves import settle_moves, settle_symbols
from packwork.readers.gate.plain.units import settle_dash_units, settle_root, settle_units
from packwork.readers.gate.sanitise import sanitised
from packwork.readers.gate.xml_tree import parse_xml
from packwork.readers.reading import UnfitError, one_budget
from packwork.readers.svg_syntax.page import read_page
from packwork.readers.svg_syntax.references import drop_dangling, prune_hidden, prune_unused
from packwork.readers.svg_syntax.vocabulary import HREF

MAX_BYTES = 20_000_000
"""Size of an SVG file. Drawings for packing have kilobytes. Chosen."""

_GZIP = b"\x1f\x8b"
_GZIP_BITS = 31
_NAMESPACES = 'xmlns="http://www.w3.org/2000/svg"'
_LINKS = 'xmlns:xlink="http://www.w3.org/1999/xlink"'


def admit(data: bytes) -> ET.Element:
    """Clean root of an SVG file's bytes: tags and attributes without namespaces.

    Compressed ones (``.svgz``) are unpacked first. The tree holds only known elements, its
    styles are attributes, its references are local and lead somewhere, and following them all
    leaves it at a sane size.

    Raises
    ------
    UnfitError
        If the bytes are no SVG or pass a limit.

    Examples
    --------
    >>> root = admit(b'<svg><style>.a{fill:red}</style><path class="a" d="M0 0h9v9z"/></svg>')
    >>> root[0].attrib
    {'d': 'M0 0h9v9z', 'fill': 'red'}
    """
    data = unpacked(data)
    with one_budget():
        return _admitted(data)


def unpacked(data: bytes) -> bytes:
    """The same bytes, unpacked if they are compressed.

    Raises
    ------
    UnfitError
        If there are none, or too many.

    Examples
    --------
    >>> unpacked(b"<svg/>")
    b'<svg/>'
    """
    if not data.strip():
        raise UnfitError("is empty; give a drawing with at least one shape")
    if data.startswith(_GZIP):
        data = _unpacked(data)
    if len(data) > MAX_BYTES:
        raise UnfitError(
            f"has {len(data) // 1_000_000} MB; {MAX_BYTES // 1_000_000} MB are the most for an SVG"
        )
    return data


def _admitted(data: bytes) -> ET.Element:
    raw = parse_xml(data)
    check_size(raw)
    root = sanitised(raw)
    settle_root(root)
    page = read_page(root)
    settle_units(root, page)
    settle_dash_units(root)
    settle_stencils(root)
    settle_cuts(root, page)
    settle_moves(root, page)
    settle_symbols(root)
    drop_dangling(root)
    settle_filters(root)
    prune_hidden(root)
    prune_unused(root)
    bound_expansion(root)
    return root


def _unpacked(data: bytes) -> bytes:
    """Content of a compressed SVG, no more of it than is read."""
    unpacking = zlib.decompressobj(wbits=_GZIP_BITS)
    try:
        plain = unpacking.decompress(data, MAX_BYTES + 1)
    except zlib.error:
        raise UnfitError("is a broken compressed SVG (.svgz); save it again") from None
    if not unpacking.eof and len(plain) <= MAX_BYTES:
        raise UnfitError("is a compressed SVG (.svgz) that is cut short; save it again")
    return plain


def serialised(element: ET.Element) -> str:
    r"""Markup of a clean element, no namespaces declared: a fragment of a document.

    Examples
    --------
    >>> serialised(ET.Element("g", {"id": 'a"b'}))
    '<g id=\'a"b\'/>'
    """
    # Loads the web client of Python with it; drawings that were read before need neither.
    from xml.sax.saxutils import escape, quoteattr

    attributes = "".join(f" {name}={quoteattr(value)}" for name, value in element.attrib.items())
    inside = escape(element.text or "") + "".join(serialised(child) for child in element)
    tail = escape(element.tail or "")
    if not inside:
        return f"<{element.tag}{attributes}/>{tail}"
    return f"<{element.tag}{attributes}>{inside}</{element.tag}>{tail}"


def document(root: ET.Element) -> str:
    """Complete SVG document of a clean ``<svg>`` element.

    Examples
    --------
    >>> document(ET.Element("svg", {"width": "9"}))
    '<svg xmlns="http://www.w3.org/2000/svg" width="9"/>'
    """
    spaces = f"{_NAMESPACES} {_LINKS}" if uses_links(root) else _NAMESPACES
    return serialised(root).replace("<svg", f"<svg {spaces}", 1)


def uses_links(element: ET.Element) -> bool:
    """Whether anything inside needs the ``xlink`` prefix.

    Examples
    --------
    >>> uses_links(ET.Element("use", {"xlink:href": "#a"}))
    True
    """
    return any(HREF in e.attrib for e in element.iter())


def link_declaration() -> tuple[str, str]:
    """Attribute, as name and value, that declares the ``xlink`` prefix.

    Examples
    --------
    >>> link_declaration()[0]
    'xmlns:xlink'
    """
    name, _, value = _LINKS.partition("=")
    return name, value.strip('"')


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
