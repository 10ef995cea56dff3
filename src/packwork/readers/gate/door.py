"""Entrance of all SVG files: parsed, sanitised and bounded in size; nothing else parses them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
import zlib

from packwork.readers.account import one_budget
from packwork.readers.budget.expansion import bound_expansion, check_size
from packwork.readers.budget.filters import settle_filters
from packwork.readers.gate.plain.cuts import settle_cuts, settle_stencils
from packwork.readers.gate.plain.dash_units import settle_dash_units
from packwork.readers.gate.plain.moves import settle_moves
from packwork.readers.gate.plain.symbols import settle_symbols
from packwork.readers.gate.plain.units import settle_root, settle_units
from packwork.readers.gate.sanitise import sanitised
from packwork.readers.gate.xml_tree import parse_xml
from packwork.readers.svg_syntax.page import read_page
from packwork.readers.svg_syntax.references import drop_dangling, prune_hidden, prune_unused
from packwork.readers.svg_syntax.vocabulary import HREF
from packwork.readers.unfit import UnfitError

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
