"""Parquet files: what their metadata say is looked at before anything is decoded."""

from __future__ import annotations

import importlib
import io
from collections.abc import Iterable, Sequence
from typing import Any

from packwork.errors import ReadError
from packwork.readers.tables.delimited import check_cells, check_rows

MOST_DECODED_BYTES = 100_000_000
"""Bytes of the columns that are read, once unpacked, by the file's own account; Python's values
take up to six times that. Derived from a gigabyte in all."""

ALL_COLUMNS_CELLS = 200_000
"""Cells up to which all columns are read, for the tooltips of a few thousand marks; of larger
files only those that are asked for. Larger takes memory for nothing that is shown. Chosen."""

_MOST_REASON = 120
_INDEX = "__index_level_"


def rows_of_parquet(file: str, data: bytes, needed: Iterable[str] = ()) -> list[dict[str, Any]]:
    """Rows of a Parquet file, as values of Python.

    What pandas notes in such files for itself is not looked at.

    Parameters
    ----------
    needed
        Columns that are read in any case.

    Raises
    ------
    ReadError
        If it is none, holds more than memory does, or what reads it is not installed.
    """
    try:
        parquet = importlib.import_module("pyarrow.parquet")
        arrow = importlib.import_module("pyarrow")
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "pyarrow":
            raise
        raise ReadError(
            file, "needs pyarrow; install it: pip install pyarrow, or give CSV"
        ) from None
    try:
        opened = parquet.ParquetFile(io.BytesIO(data))
        metadata = opened.metadata
        check_rows(metadata.num_rows, file)
        names = _columns(metadata, opened.schema_arrow.names, set(needed))
        _check_size(file, metadata, names)
        table = parquet.ParquetFile(io.BytesIO(data), read_dictionary=_texts(opened, arrow)).read(
            columns=names, use_threads=False, use_pandas_metadata=False
        )
        columns = {name: _values(table.column(name), arrow) for name in names}
    except MemoryError:
        raise ReadError(file, "needs more memory than there is; give fewer rows") from None
    except (arrow.ArrowException, ValueError, OSError, TypeError, KeyError, OverflowError) as error:
        reason = " ".join(str(error).split())[:_MOST_REASON]
        raise ReadError(file, f"is not Parquet that can be read ({reason})") from None
    return [dict(zip(names, cells, strict=True)) for cells in zip(*columns.values(), strict=True)]


def _columns(metadata: Any, names: Sequence[str], needed: set[str]) -> list[str]:
    """Which columns are read: all of a small file, else those that are needed."""
    own = [name for name in dict.fromkeys(names) if not name.startswith(_INDEX)]
    if metadata.num_rows * len(own) <= ALL_COLUMNS_CELLS:
        return own
    return [name for name in own if name in needed] or own


def _check_size(file: str, metadata: Any, names: Sequence[str]) -> None:
    """Refuse what would not fit into memory, by what the file says of itself.

    Raises
    ------
    ReadError
        Saying how much there may be.
    """
    cells, size = 0, 0
    for group in range(metadata.num_row_groups):
        rows = metadata.row_group(group)
        for k in range(rows.num_columns):
            chunk = rows.column(k)
            if chunk.path_in_schema.partition(".")[0] in names:
                # Lists have more values than rows.
                cells += max(chunk.num_values, rows.num_rows)
                size += chunk.total_uncompressed_size
    check_cells(cells, file)
    if size > MOST_DECODED_BYTES:
        raise ReadError(
            file,
            f"holds {size / 1e6:,.0f} MB in the columns that are read; {MOST_DECODED_BYTES / 1e6:g}"
            " are the most: give fewer rows",
        )


def _texts(opened: Any, arrow: Any) -> list[str]:
    """Columns of texts: each different one is decoded once, however often it stands there."""
    types = arrow.types
    return [
        field.name
        for field in opened.schema_arrow
        if types.is_string(field.type) or types.is_binary(field.type)
    ]


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
    if arrow.types.is_timestamp(values.type):
        # Python's own times know no billionths of a second; nor do charts.
        values = values.cast(arrow.timestamp("us"), safe=False)
    try:
        return list(values.to_pylist())
    except (ValueError, OverflowError):
        return list(values.cast(arrow.string()).to_pylist())
