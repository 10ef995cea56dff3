"""XML parsing with limits on size, depth and entities."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from functools import partial
from typing import Any

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import XMLParser

from packwork.readers.budget.expansion import MAX_DEPTH
from packwork.readers.reading import UnfitError

MAX_ELEMENTS = 200_000
"""Elements of any kind in one file, metadata included. Chosen."""

MAX_NAMESPACE = 500
"""Letters of a namespace's address: the parser repeats it in every name. Chosen."""


_REMEDY = "save it as plain SVG without them"
_DECLARES = f"declares XML entities or a document type of its own; {_REMEDY}"

MAX_ENTITY = 300
"""Letters of an entity, as some programs declare for the addresses of namespaces. Chosen."""

MAX_ATTRIBUTES = 100
"""Attributes that a document type declares. Chosen."""

MAX_REPLACED = 2_000_000
"""Letters that all entities of a document may come to. Chosen."""


def parse_xml(data: bytes) -> ET.Element:
    """Root of a document, without default attributes and all but the plainest entities.

    A ``<!DOCTYPE svg PUBLIC ...>`` passes: nothing is fetched for it. Its own entities
    pass if each is a short plain text, so that none can multiply, and a few lists of attributes,
    whose defaults are not taken.

    Raises
    ------
    UnfitError
        If it is not well-formed, too deep, too large or declares other entities.

    Examples
    --------
    >>> parse_xml(b"<svg><g/></svg>").tag
    'svg'
    """
    parser = XMLParser(target=_BoundedBuilder(), forbid_entities=False)
    references = data.count(b"&")
    parser.parser.EntityDeclHandler = partial(_check_entity, references)
    parser.parser.UnparsedEntityDeclHandler = _refuse_declaration
    parser.parser.AttlistDeclHandler = _AttributeLists().declare
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


class _AttributeLists:
    """Counts the attributes that a document type declares: a parser goes over them per element."""

    def __init__(self) -> None:
        self._count = 0

    def declare(self, element: str, name: str, kind: str, default: str | None, _: bool) -> None:
        """Refuse one that is too much."""
        self._count += 1
        if self._count > MAX_ATTRIBUTES or len(default or "") > MAX_ENTITY:
            raise UnfitError(_DECLARES)


def _refuse_declaration(*_what: object) -> None:
    raise UnfitError(_DECLARES)


class _BoundedBuilder:
    """Tree builder that stops as soon as a limit is passed."""

    def __init__(self) -> None:
        self._builder = ET.TreeBuilder()
        self._depth = 0
        self._count = 0

    def start_ns(self, prefix: str, uri: str) -> None:
        if len(uri) > MAX_NAMESPACE:
            raise UnfitError(f"has a namespace of {len(uri)} letters; {MAX_NAMESPACE} is the most")

    def start(self, tag: str, attrs: dict[str, str]) -> Any:
        self._depth += 1
        self._count += 1
        if self._depth > MAX_DEPTH:
            raise UnfitError(f"nests its elements more than {MAX_DEPTH} deep; flatten its groups")
        if self._count > MAX_ELEMENTS:
            raise UnfitError(f"has more than {MAX_ELEMENTS:,} elements; simplify it")
        return self._builder.start(tag, attrs)

    def end(self, tag: str) -> Any:
        self._depth -= 1
        return self._builder.end(tag)

    def data(self, text: str) -> None:
        self._builder.data(text)

    def close(self) -> ET.Element:
        return self._builder.close()
