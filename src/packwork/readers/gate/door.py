"""Entrance of all SVG files and of their named parts: nothing else parses them.

XML is parsed with limits on size, depth and entities.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
import zlib
from functools import partial

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import XMLParser

from packwork.readers.budget.expansion import MAX_DEPTH, bound_expansion, check_size
from packwork.readers.budget.rendering import drop_wild_filters
from packwork.readers.gate.boxes import (
    prune_clip_paths,
    resolve_clip_shapes,
    resolve_symbols,
    resolve_transforms,
)
from packwork.readers.gate.lengths import resolve_dash_lengths, resolve_lengths, resolve_page_size
from packwork.readers.gate.sanitise import sanitised
from packwork.readers.reading import UnfitError, one_budget
from packwork.readers.svg_syntax.coordinates import read_page
from packwork.readers.svg_syntax.references import drop_dangling, prune_hidden, prune_unused
from packwork.readers.svg_syntax.vocabulary import HREF

MAX_ELEMENTS = 200_000
"""Elements of any kind in one file, metadata included. Chosen."""


_REMEDY = "save it as plain SVG without them"
_DECLARES = f"declares XML entities or a document type of its own; {_REMEDY}"

MAX_NAMESPACE = 500
"""Letters of a namespace's address, which the parser repeats in every name. Chosen."""

MAX_ENTITY = 300
"""Letters of an entity, as some programs declare for the addresses of namespaces. Chosen."""

MAX_ATTRIBUTES = 100
"""Attributes that a document type declares. Chosen."""

MAX_REPLACED = 2_000_000
"""Letters that all entities of a document may come to. Chosen."""


def parse_xml(data: bytes) -> ET.Element:
    """Root of a document, without default attributes and all but the plainest entities.

    A ``<!DOCTYPE svg PUBLIC ...>`` passes: nothing is fetched for it. Its own entities pass if each
    is a short plain text, so that none can multiply; the defaults of attributes are not taken.
    """
    builder = _BoundedBuilder()
    parser = XMLParser(target=builder, forbid_entities=False)
    references = data.count(b"&")
    parser.parser.EntityDeclHandler = partial(_check_entity, references)
    parser.parser.UnparsedEntityDeclHandler = _refuse_declaration
    parser.parser.AttlistDeclHandler = builder.declare_attribute
    # What they give by default is not taken.
    parser.parser.specified_attributes = True
    try:
        parser.feed(data)
        root: ET.Element = parser.close()
    except DefusedXmlException:
        raise UnfitError(_DECLARES) from None
    except ET.ParseError as error:
        raise UnfitError(f"is not well-formed XML ({error}); save it again as SVG") from None
    except (ValueError, LookupError) as error:
        raise UnfitError(f"has an encoding that cannot be read ({error}); use UTF-8") from None
    return root


def _check_entity(
    references: int, name: str, is_parameter: int, value: str | None, *_where: object
) -> None:
    """Refuse an entity that is no short plain text, or that may be repeated too often."""
    is_plain = not is_parameter and value is not None and not set(value) & set("&<%")
    if not is_plain or len(value or "") > MAX_ENTITY:
        raise UnfitError(_DECLARES)
    if references * len(value or "") > MAX_REPLACED:
        raise UnfitError(f"repeats the XML entity {name[:20]!r} too often; {_REMEDY}")


def _refuse_declaration(*_what: object) -> None:
    raise UnfitError(_DECLARES)


class _BoundedBuilder(ET.TreeBuilder):
    """Tree builder that stops as soon as a limit is passed."""

    def __init__(self) -> None:
        super().__init__()
        self._depth = self._count = self._attributes = 0

    def declare_attribute(
        self, element: str, name: str, kind: str, default: str | None, _: bool
    ) -> None:
        """Count what a document type declares: a parser goes over it for each element."""
        self._attributes += 1
        if self._attributes > MAX_ATTRIBUTES or len(default or "") > MAX_ENTITY:
            raise UnfitError(_DECLARES)

    def start_ns(self, prefix: str, uri: str) -> None:
        if len(uri) > MAX_NAMESPACE:
            raise UnfitError(f"has a namespace of {len(uri)} letters; {MAX_NAMESPACE} is the most")

    def start(self, tag: str, attrs: dict[str, str]) -> ET.Element:
        self._depth += 1
        self._count += 1
        if self._depth > MAX_DEPTH:
            raise UnfitError(f"nests its elements more than {MAX_DEPTH} deep; flatten its groups")
        if self._count > MAX_ELEMENTS:
            raise UnfitError(f"has more than {MAX_ELEMENTS:,} elements; simplify it")
        return super().start(tag, attrs)

    def end(self, tag: str) -> ET.Element:
        self._depth -= 1
        return super().end(tag)


MAX_BYTES = 20_000_000
"""Size of an SVG file. Drawings for packing have kilobytes. Chosen."""

_GZIP = b"\x1f\x8b"
_GZIP_BITS = 31
_NAMESPACES = 'xmlns="http://www.w3.org/2000/svg"'
_LINKS = 'xmlns:xlink="http://www.w3.org/1999/xlink"'


def parse_untrusted(data: bytes) -> ET.Element:
    """Clean root of an SVG file's bytes: tags and attributes without namespaces.

    Compressed ones (``.svgz``) are unpacked first. The tree holds only known elements, its
    styles are attributes, its references are local and lead somewhere, and following them all
    leaves it at a sane size.

    >>> root = parse_untrusted(b'<svg><style>.a{fill:red}</style><g class="a"><path/></g></svg>')
    >>> root[0].attrib
    {'fill': 'red'}
    """
    data = unpacked(data)
    with one_budget():
        raw = parse_xml(data)
        check_size(raw)
        root = sanitised(raw)
        resolve_page_size(root)
        page = read_page(root)
        resolve_lengths(root, page)
        resolve_dash_lengths(root)
        prune_clip_paths(root)
        resolve_clip_shapes(root, page)
        resolve_transforms(root, page)
        resolve_symbols(root)
        drop_dangling(root)
        drop_wild_filters(root)
        prune_hidden(root)
        prune_unused(root)
        bound_expansion(root)
        return root


def unpacked(data: bytes) -> bytes:
    """The same bytes, unpacked if they are compressed."""
    if not data.strip():
        raise UnfitError("is empty; give a drawing with at least one shape")
    if data.startswith(_GZIP):
        # Content of a compressed SVG, no more of it than is read.
        unpacking = zlib.decompressobj(wbits=_GZIP_BITS)
        try:
            plain = unpacking.decompress(data, MAX_BYTES + 1)
        except zlib.error:
            raise UnfitError("is a broken compressed SVG (.svgz); save it again") from None
        if not unpacking.eof and len(plain) <= MAX_BYTES:
            raise UnfitError("is a compressed SVG (.svgz) that is cut short; save it again")
        data = plain
    if len(data) > MAX_BYTES:
        raise UnfitError(
            f"has {len(data) // 1_000_000} MB; {MAX_BYTES // 1_000_000} MB are the most for an SVG"
        )
    return data


def serialised(element: ET.Element) -> str:
    r"""Markup of a clean element, no namespaces declared: a fragment of a document.

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
    """Complete SVG document of a clean ``<svg>`` element."""
    spaces = f"{_NAMESPACES} {_LINKS}" if uses_links(root) else _NAMESPACES
    return serialised(root).replace("<svg", f"<svg {spaces}", 1)


def uses_links(element: ET.Element) -> bool:
    """Whether anything inside needs the ``xlink`` prefix."""
    return any(HREF in e.attrib for e in element.iter())


def link_declaration() -> tuple[str, str]:
    """Attribute, as name and value, that declares the ``xlink`` prefix."""
    name, _, value = _LINKS.partition("=")
    return name, value.strip('"')
