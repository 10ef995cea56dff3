"""Which glyph shows a character: a font's ``cmap``, looked up and never expanded.

A few bytes of that table can claim billions of characters; so its ranges are searched
for the characters asked for, and nothing is listed.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Mapping

import numpy as np

from packwork.readers.unfit import UnfitError

SYMBOL_SHIFT = 0xF000
"""Where fonts of symbols keep the characters below 256."""

_SYMBOL = (3, 0)
_PREFERENCE = ((3, 10), (0, 6), (0, 4), (3, 1), (0, 3), (0, 2), (0, 1), (0, 0), _SYMBOL)
"""Platform and encoding of the tables for Unicode, the widest first."""


def glyph_numbers(cmap: bytes, characters: Iterable[str]) -> dict[str, int]:
    """Number of the glyph that shows each character; 0 where there is none.

    Raises
    ------
    UnfitError
        If no table for Unicode is in a format that can be read.

    Examples
    --------
    >>> header = struct.pack(">HHHHL", 0, 1, 0, 3, 12)
    >>> trimmed = struct.pack(">HHHHHHH", 6, 14, 0, ord("A"), 2, 7, 9)
    >>> glyph_numbers(header + trimmed, "ABC")
    {'A': 7, 'B': 9, 'C': 0}
    """
    encoding, look_up, table = _best_table(cmap)
    numbers = {}
    for character in characters:
        number = look_up(table, ord(character))
        if number == 0 and encoding == _SYMBOL:
            number = look_up(table, SYMBOL_SHIFT + ord(character))
        numbers[character] = number
    return numbers


_Lookup = Callable[[bytes, int], int]


def _best_table(cmap: bytes) -> tuple[tuple[int, int], _Lookup, bytes]:
    (count,) = struct.unpack_from(">H", cmap, 2)
    tables: dict[tuple[int, int], bytes] = {}
    for k in range(count):
        platform, encoding, offset = struct.unpack_from(">HHL", cmap, 4 + 8 * k)
        if (platform, encoding) in _PREFERENCE and len(cmap) >= offset + 8:
            tables.setdefault((platform, encoding), cmap[offset:])
    for key in _PREFERENCE:
        if key in tables:
            (form,) = struct.unpack_from(">H", tables[key])
            if form in _LOOKUPS:
                return key, _LOOKUPS[form], tables[key]
    raise UnfitError("is a font that does not say which glyph shows which character")


def _in_bytes(table: bytes, code: int) -> int:
    return table[6 + code] if code < 256 else 0


def _in_segments(table: bytes, code: int) -> int:
    (size,) = struct.unpack_from(">H", table, 6)
    count = size // 2
    ends = np.frombuffer(table, ">u2", count, 14)
    starts, deltas, offsets = (np.frombuffer(table, ">u2", count, 16 + k * size) for k in (1, 2, 3))
    found = np.flatnonzero((starts <= code) & (code <= ends))
    if not len(found):
        return 0
    k = int(found[0])
    delta, offset = int(deltas[k]), int(offsets[k])
    if offset == 0:
        return (code + delta) & 0xFFFF
    # An offset counts from its own place in the table.
    place = 16 + 3 * size + 2 * k + offset + 2 * (code - int(starts[k]))
    number = int(struct.unpack_from(">H", table, place)[0])
    return (number + delta) & 0xFFFF if number else 0


def _in_run(table: bytes, code: int) -> int:
    first, count = struct.unpack_from(">HH", table, 6)
    if not first <= code < first + count:
        return 0
    return int(struct.unpack_from(">H", table, 10 + 2 * (code - first))[0])


def _in_groups(table: bytes, code: int) -> int:
    start, number = _group(table, code)
    return number + code - start


def _in_shared_groups(table: bytes, code: int) -> int:
    return _group(table, code)[1]


def _group(table: bytes, code: int) -> tuple[int, int]:
    """First character and first glyph of the group that holds ``code``."""
    (count,) = struct.unpack_from(">L", table, 12)
    groups = np.frombuffer(table, ">u4", 3 * count, 16).reshape(-1, 3)
    found = np.flatnonzero((groups[:, 0] <= code) & (code <= groups[:, 1]))
    if not len(found):
        return code, 0
    start, _, number = groups[found[0]]
    return int(start), int(number)


_LOOKUPS: Mapping[int, _Lookup] = {
    0: _in_bytes,
    4: _in_segments,
    6: _in_run,
    12: _in_groups,
    13: _in_shared_groups,
}
