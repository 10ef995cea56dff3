"""JSON of files from elsewhere: its values are counted before any is made."""

from __future__ import annotations

import json
import re
from typing import Any, NoReturn

from packwork.readers.reading import UnfitError

MAX_PARTS = 6_000_000
"""Commas, colons and brackets outside of texts: they take 0.8 GB at most when read. Measured."""

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


def parsed(text: str) -> Any:
    """Value of JSON that is not too large; numbers in it are finite.

    Examples
    --------
    >>> parsed('{"a": [1, 2]}')
    {'a': [1, 2]}
    """
    check_size(text.encode("utf-8", "surrogatepass"))
    try:
        return json.loads(text, parse_constant=_refuse_constant)
    except json.JSONDecodeError as error:
        raise UnfitError(f"is not JSON (line {error.lineno}: {error.msg})") from None
    except (RecursionError, ValueError) as error:
        raise UnfitError(f"is not JSON that can be read ({str(error)[:80]})") from None


def _parts(data: bytes) -> int:
    return sum(map(data.count, _SIGNS))


def _refuse_constant(name: str) -> NoReturn:
    raise UnfitError(f"holds the number {name}; give finite numbers")
