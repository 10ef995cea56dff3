"""JSON of files from elsewhere: its values are counted before any is made."""

from __future__ import annotations

import json
import re
from typing import Any, NoReturn

from packwork.readers.reading import UnfitError

MAX_PARTS = 6_000_000
"""Commas, colons and brackets outside of texts: they take 0.8 GB at most when read. Measured."""

MAX_PARTS_IN_LINES = 24_000_000
"""The same of a file whose features are read one by one: as arrays they take 0.6 GB. Measured."""

_SIGNS = (b",", b":", b"[", b"{")
_TEXTS = re.compile(rb'"[^"\\]*(?:\\.[^"\\]*)*"', re.DOTALL)


def is_read(data: bytes) -> bool:
    """True for JSON of no more values than may be read.

    Examples
    --------
    >>> is_read(b'{"a": [1, 2]}')
    True
    """
    # Drawings in texts have commas of their own.
    return _parts(data) <= MAX_PARTS or _parts(_TEXTS.sub(b"", data)) <= MAX_PARTS


def check_size(data: bytes) -> None:
    """Refuse JSON of more values than may be read."""
    if not is_read(data):
        raise UnfitError(f"holds more than {MAX_PARTS:,} numbers and lists; simplify it")


def parsed(text: str, before: int = 0) -> Any:
    """Value of JSON that is not too large; numbers in it are finite.

    ``before``: lines of the file above it.

    Examples
    --------
    >>> parsed('{"a": [1, 2]}')
    {'a': [1, 2]}
    """
    check_size(text.encode("utf-8", "surrogatepass"))
    try:
        return json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        raise UnfitError(f"is not JSON (line {before + error.lineno}: {error.msg})") from None
    except (RecursionError, ValueError) as error:
        raise UnfitError(f"is not JSON that can be read ({str(error)[:80]})") from None


def opened_collection(text: str) -> tuple[Any, list[str]]:
    r"""A collection without its features and the texts of these, where each has a line of its own.

    Of other JSON the whole value, and no texts.

    Examples
    --------
    >>> opened_collection('{"items":1,"features":[\n{"type":"Feature","id":4}\n]}\n')
    ({'items': 1, 'features': []}, ['{"type":"Feature","id":4}'])
    """
    head, *lines = text.rstrip("\n").split("\n")
    is_ours = head.endswith('"features":[') and lines[-1:] == ["]}"]
    if not is_ours or not all(line.startswith('{"type":"Feature",') for line in lines[:-1]):
        return parsed(text), []
    if sum(_parts(line.encode("utf-8", "surrogatepass")) for line in lines) > MAX_PARTS_IN_LINES:
        raise UnfitError(f"holds more than {MAX_PARTS_IN_LINES:,} numbers and lists; simplify it")
    return parsed(f"{head}]}}"), [line.removesuffix(",") for line in lines[:-1]]


def _parts(data: bytes) -> int:
    return sum(map(data.count, _SIGNS))


def _refuse_constant(name: str) -> NoReturn:
    raise UnfitError(f"holds the number {name}; give finite numbers")
