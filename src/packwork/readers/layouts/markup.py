"""Text inside elements of an SVG, byte for byte as it stands in the file."""

from __future__ import annotations

import re
from collections.abc import Set
from xml.parsers import expat

_START = re.compile(rb"""<[^<>"']*(?:"[^"]*"[^<>"']*|'[^']*'[^<>"']*)*>""")
_ENCODED = re.compile(rb"""^\s*<\?xml[^>]*encoding\s*=\s*["'](?!utf-8["'])""", re.IGNORECASE)


def insides(data: bytes, wanted: Set[int]) -> dict[int, str]:
    """Text between the tags of elements, by their number in the document's order.

    Parameters
    ----------
    data
        A document that has been parsed before, so that it is known to be harmless.
    wanted
        Numbers of the elements; the root's is 0.

    Returns
    -------
    dict
        Nothing for a document that is not in UTF-8, or declares entities.

    Examples
    --------
    >>> insides(b'<svg><g a="1>0"> <path/></g><g/></svg>', {1, 3})
    {1: ' <path/>', 3: ''}
    """
    if _ENCODED.match(data) or b"<!ENTITY" in data or data.startswith((b"\xff", b"\xfe", b"\xef")):
        return {}
    found: dict[int, str] = {}
    open_: list[int | None] = []
    count = 0
    parser = expat.ParserCreate()

    def begin(_name: str, _attributes: dict[str, str]) -> None:
        nonlocal count
        tag = _START.match(data, parser.CurrentByteIndex) if count in wanted else None
        open_.append(None if tag is None else tag.end())
        if tag is not None:
            found[count] = ""
            numbers.append(count)
        count += 1

    def end(_name: str) -> None:
        start, stop = open_.pop(), parser.CurrentByteIndex
        if start is not None:
            # An empty element ends where it begins.
            found[numbers.pop()] = data[start:stop].decode("utf-8") if stop >= start else ""

    numbers: list[int] = []
    parser.StartElementHandler, parser.EndElementHandler = begin, end
    try:
        parser.Parse(data, True)
    except (expat.ExpatError, UnicodeDecodeError):
        return {}
    return found
