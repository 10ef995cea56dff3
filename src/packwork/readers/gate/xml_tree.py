"""Bytes to an element tree, bounded while it is being built."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from typing import Any

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import XMLParser

from packwork.readers.unfit import UnfitError

MAX_DEPTH = 100
"""Elements inside one another, also after ``use`` has been expanded. Drawings made by
people stay below 40; recursion over the tree stays far from Python's own limit. Chosen."""

MAX_ELEMENTS = 200_000
"""Elements of any kind in one file, metadata included. Chosen."""

MAX_NAMESPACE = 500
"""Letters of a namespace's address: the parser repeats it in every name. Chosen."""


def parse_xml(data: bytes) -> ET.Element:
    """Root of a document without entities and without a document type of its own.

    A plain ``<!DOCTYPE svg PUBLIC ...>`` passes: nothing is fetched for it. An internal
    subset does not, for its entities and default attributes multiply.

    Raises
    ------
    UnfitError
        If it is not well-formed, too deep, too large or declares entities.

    Examples
    --------
    >>> parse_xml(b"<svg><g/></svg>").tag
    'svg'
    """
    parser = XMLParser(target=_BoundedBuilder())
    parser.parser.StartDoctypeDeclHandler = _refuse_internal_subset
    try:
        parser.feed(data)
        root: ET.Element = parser.close()
    except DefusedXmlException:
        raise UnfitError("declares XML entities; save it as plain SVG without them") from None
    except ET.ParseError as error:
        raise UnfitError(f"is not well-formed XML ({error}); save it again as SVG") from None
    except (ValueError, LookupError) as error:
        raise UnfitError(f"has an encoding that cannot be read ({error}); use UTF-8") from None
    return root


def _refuse_internal_subset(
    name: str, system_id: str | None, public_id: str | None, has_internal_subset: int
) -> None:
    if has_internal_subset:
        raise UnfitError(
            f"declares entities or a document type of its own in <!DOCTYPE {name[:20]} [...]>; "
            "save it as plain SVG without them"
        )


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
