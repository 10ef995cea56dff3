"""Decoded sizes of the columns of a Parquet file, from the headers of its pages.

A reader allocates what each page's header states, so that is what has to be bounded; the sums at
the end of the file may say anything. Arrow's own account of a column ends the whole process where
the file's is spoilt, so that is not asked. Structures are of Thrift's compact protocol (Parquet's
own `parquet.thrift`: `FileMetaData`, `ColumnMetaData`, `PageHeader`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

MOST_PAGES = 100_000
"""Of one column; a page has a thousand rows or more. Larger takes seconds to walk. Chosen."""

DELTA_BYTE_ARRAY = 7
"""Number of the encoding of texts by what they share with the one before."""

DELTA_LENGTH_BYTE_ARRAY = 6
"""Number of the encoding of texts behind all of their lengths."""

_DEEPEST = 12
_TRUE, _FALSE, _BYTE, _DOUBLE, _BINARY, _LIST, _STRUCT = 1, 2, 3, 7, 8, 9, 12
_WHOLE = (4, 5, 6)
_LONG_LIST = 15
_UNPACKED, _PACKED, _DATA, _DATA_2 = 2, 3, 5, 8
_COUNT = 1
_TAIL = 8
"""Bytes behind the structure at a file's end: its length, and Parquet's mark."""

Fields: TypeAlias = dict[int, Any]


@dataclass(frozen=True)
class ColumnChunk:
    """One column of one group of rows.

    Parameters
    ----------
    name
        Of the column; of one in a structure, the structure's.
    rows, values, stated
        By the file's own account; ``stated`` are its bytes unpacked.
    size, found
        Bytes unpacked, and values, by the headers of its pages.
    is_shared
        Whether texts are told by what they share with the one before.
    is_delta
        Whether texts are in an encoding that Arrow does not read as a dictionary.
    """

    name: str
    rows: int
    values: int
    stated: int
    size: int
    found: int
    is_shared: bool
    is_delta: bool


def pieces_of(data: bytes) -> list[ColumnChunk]:
    """All columns of all groups of rows.

    Raises
    ------
    ValueError
        If the file's account of itself cannot be read, one has more than ``MOST_PAGES`` pages, or
        sizes below nothing.
    """
    length = int.from_bytes(data[-_TAIL:-4], "little")
    begin = len(data) - _TAIL - length
    if begin < 0 or data[-4:] != b"PAR1":
        raise ValueError("the file's account of itself is missing")
    try:
        whole, _ = _struct(data, begin, 0)
        return [_piece(data, chunk[3], int(group[3])) for group in whole[4] for chunk in group[1]]
    except (IndexError, KeyError, TypeError, AttributeError):
        raise ValueError("the file's account of itself is spoilt") from None


def _piece(data: bytes, told: Fields, rows: int) -> ColumnChunk:
    size = found = 0
    for number, header in enumerate(_headers(data, told)):
        if number == MOST_PAGES:
            raise ValueError(f"a column of more than {MOST_PAGES:,} pages")
        size += header[_UNPACKED]
        counts = header.get(_DATA) or header.get(_DATA_2) or {}
        found += max(counts.get(_COUNT, 0), 0)
    name = told[3][0].decode("utf-8", errors="replace")
    is_shared = DELTA_BYTE_ARRAY in told[2]
    is_delta = is_shared or DELTA_LENGTH_BYTE_ARRAY in told[2]
    return ColumnChunk(name, rows, told[5], told[6], size, found, is_shared, is_delta)


def _headers(data: bytes, told: Fields) -> Iterator[Fields]:
    """One after the other, as far as they can be read: a reader stops there, too."""
    # The dictionary's page comes first, where there is one.
    place = min(told[9], told.get(11) or told[9])
    end = min(place + told[7], len(data))
    while 0 <= place < end:
        try:
            header, place = _struct(data, place, 0)
            packed, unpacked = int(header[_PACKED]), int(header[_UNPACKED])
        except (IndexError, KeyError, TypeError):
            return
        if min(packed, unpacked) < 0:
            raise ValueError("a page of a size below nothing")
        yield header
        place += packed


def _struct(data: bytes, place: int, depth: int) -> tuple[Fields, int]:
    if depth > _DEEPEST:
        raise IndexError
    found: Fields = {}
    number = 0
    while data[place]:
        step, kind = data[place] >> 4, data[place] & 15
        place += 1
        if step:
            number += step
        else:
            number, place = _number(data, place)
        if kind in {_TRUE, _FALSE}:
            found[number] = kind == _TRUE
        else:
            found[number], place = _value(data, place, kind, depth)
    return found, place + 1


def _value(data: bytes, place: int, kind: int, depth: int) -> tuple[Any, int]:
    if kind in {_TRUE, _FALSE, _BYTE}:
        return data[place], place + 1
    if kind in _WHOLE:
        return _number(data, place)
    if kind == _DOUBLE:
        return None, place + 8
    if kind == _BINARY:
        length, place = _varint(data, place)
        return data[place : place + length], place + length
    if kind == _LIST:
        return _list(data, place, depth)
    if kind == _STRUCT:
        return _struct(data, place, depth + 1)
    # Sets and maps: Parquet has none.
    raise IndexError


def _list(data: bytes, place: int, depth: int) -> tuple[list[Any], int]:
    if depth > _DEEPEST:
        raise IndexError
    length, kind = data[place] >> 4, data[place] & 15
    place += 1
    if length == _LONG_LIST:
        length, place = _varint(data, place)
    if length > len(data):
        raise IndexError
    found = []
    for _ in range(length):
        value, place = _value(data, place, kind, depth + 1)
        found.append(value)
    return found, place


def _number(data: bytes, place: int) -> tuple[int, int]:
    value, place = _varint(data, place)
    return (value >> 1) ^ -(value & 1), place


def _varint(data: bytes, place: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        byte = data[place]
        place += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            return value, place
        if shift > 63:
            raise IndexError
