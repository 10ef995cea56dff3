"""Parquet files, the sizes of their pages checked before anything is decoded.

A reader allocates what each page's header states, so that is what has to be bounded; the sums at
the end of the file may say anything. Arrow's own account of a column ends the whole process where
the file's is spoilt, so that is not asked. Structures are of Thrift's compact protocol (Parquet's
own `parquet.thrift`: `FileMetaData`, `ColumnMetaData`, `PageHeader`).
"""

from __future__ import annotations

import importlib
import io
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from packwork.errors import ReadError
from packwork.installed import command_to_install
from packwork.readers.tables.delimited import check_size

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

    ``rows``, ``values`` and ``stated`` (bytes unpacked) are the file's own account; ``size``
    (bytes unpacked) and ``found`` (values) that of its pages. ``is_shared``: texts are told by
    what they share with the one before; ``is_delta``: in an encoding that Arrow does not read
    as a dictionary.
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
    """All columns of all groups of rows."""
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


MOST_DECODED_BYTES = 100_000_000
"""Bytes of the columns that are read, once unpacked, by their pages' own headers; Python's values
take up to six times that. Derived from a gigabyte in all."""

ALL_COLUMNS_CELLS = 200_000
"""Cells up to which all columns are read, for the tooltips of a few thousand marks; of larger
files only those that are asked for. Larger takes memory for nothing that is shown. Chosen."""

MOST_BYTES_OF_CELL = 1_000_000
"""Of one text. Larger is no name, and where it is no text its bytes are spelt out. Chosen."""

MOST_ROWS_AT_ONCE = 10_000
"""Of texts that share beginnings. Larger saves little time. Chosen."""

_MOST_REASON = 120
_INDEX = "__index_level_"


def rows_of_parquet(file: str, data: bytes, needed: Iterable[str] = ()) -> list[dict[str, Any]]:
    """Rows of a Parquet file, as values of Python, with needed columns in any case.

    What pandas notes in such files for itself is not looked at.
    """
    try:
        parquet = importlib.import_module("pyarrow.parquet")
        arrow = importlib.import_module("pyarrow")
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "pyarrow":
            raise
        raise ReadError(
            file, f"needs pyarrow; install it: {command_to_install(['pyarrow'])}, or give CSV"
        ) from None
    try:
        opened = parquet.ParquetFile(io.BytesIO(data))
        metadata = opened.metadata
        check_size(file, metadata.num_rows)
        names = _columns(metadata, opened.schema_arrow.names, set(needed))
        pieces = [piece for piece in pieces_of(data) if piece.name in names]
        # Lists have more values than rows.
        check_size(file, 0, sum(max(one.values, one.rows, one.found) for one in pieces))
        _check_bytes(file, sum(max(one.size, one.stated) for one in pieces))
        # Each different text is decoded once, however often it stands there.
        texts = [field.name for field in opened.schema_arrow if _is_text(field.type, arrow)]
        table = _read(file, data, names, pieces, texts)
        columns = {name: _values(table.column(name), arrow) for name in names}
    except ReadError:
        raise
    except MemoryError:
        raise ReadError(file, "needs more memory than there is; give fewer rows") from None
    except (arrow.ArrowException, ValueError, OSError, TypeError, KeyError, OverflowError) as error:
        reason = " ".join(str(error).split())[:_MOST_REASON]
        raise ReadError(file, f"is not Parquet that can be read ({reason})") from None
    return [dict(zip(names, cells, strict=True)) for cells in zip(*columns.values(), strict=True)]


def _columns(metadata: Any, names: Sequence[str], needed: set[str]) -> list[str]:
    own = [name for name in dict.fromkeys(names) if not name.startswith(_INDEX)]
    if metadata.num_rows * len(own) <= ALL_COLUMNS_CELLS:
        return own
    return [name for name in own if name in needed] or own


def _check_bytes(file: str, size: int) -> None:
    if size > MOST_DECODED_BYTES:
        raise ReadError(
            file,
            f"holds {size / 1e6:,.0f} MB in the columns that are read; {MOST_DECODED_BYTES / 1e6:g}"
            " are the most: give fewer rows",
        )


def _read(
    file: str,
    data: bytes,
    names: Sequence[str],
    pieces: Sequence[ColumnChunk],
    texts: Sequence[str],
) -> Any:
    """The columns, those of texts with each different one once.

    Texts that are told by what they share with the one before (``DELTA_BYTE_ARRAY``) may be as long
    as all of their pages, in each row; they are unpacked a few rows at a time, and counted.
    """
    arrow = importlib.import_module("pyarrow")
    parquet = importlib.import_module("pyarrow.parquet")
    shared = {piece.name for piece in pieces if piece.is_shared}
    plain = {piece.name for piece in pieces if piece.is_delta}
    opened = parquet.ParquetFile(
        io.BytesIO(data), read_dictionary=[name for name in texts if name not in plain]
    )
    if not shared:
        return opened.read(columns=names, use_threads=False, use_pandas_metadata=False)
    longest = max(piece.size for piece in pieces if piece.is_shared)
    rows = min(max(MOST_DECODED_BYTES // max(longest, 1), 1), MOST_ROWS_AT_ONCE)
    batches, size = [], 0
    for batch in opened.iter_batches(rows, columns=names, use_threads=False):
        size += batch.nbytes
        _check_bytes(file, size)
        batches.append(batch)
    return arrow.Table.from_batches(batches, opened.schema_arrow if not batches else None)


def _is_text(kind: Any, arrow: Any) -> bool:
    return bool(arrow.types.is_string(kind) or arrow.types.is_binary(kind))


def _values(column: Any, arrow: Any) -> list[Any]:
    """Values of a column; texts that are alike share one."""
    found: list[Any] = []
    for chunk in column.chunks:
        if arrow.types.is_dictionary(chunk.type):
            known = [*_plain_values(chunk.dictionary, arrow), None]
            found += [known[-1 if k is None else k] for k in chunk.indices.to_pylist()]
        else:
            found += _plain_values(chunk, arrow)
    return found


def _plain_values(values: Any, arrow: Any) -> list[Any]:
    if _is_text(values.type, arrow):
        compute = importlib.import_module("pyarrow.compute")
        longest = compute.max(compute.binary_length(values)).as_py() or 0
        if longest > MOST_BYTES_OF_CELL:
            raise ValueError(f"a text of {longest:,} bytes, {MOST_BYTES_OF_CELL:,} are the most")
    if arrow.types.is_timestamp(values.type):
        # Python's own times know no billionths of a second; nor do charts.
        values = values.cast(arrow.timestamp("us"), safe=False)
    try:
        return list(values.to_pylist())
    except (ValueError, OverflowError):
        return list(values.cast(arrow.string()).to_pylist())
