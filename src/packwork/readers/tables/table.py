"""Tables from files and from what Python programs hold."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence, Sized
from dataclasses import dataclass, replace
from datetime import timedelta
from typing import Any, TypeAlias

from packwork.errors import ReadError, RecipeError
from packwork.phrasing import no_column
from packwork.readers.reading import read_bytes
from packwork.readers.tables.cells import Written, figure, is_blank, written_numbers
from packwork.readers.tables.decoding import read_json
from packwork.readers.tables.delimited import (
    ENDINGS,
    MOST_ROWS,
    UNICODE_TEXT,
    TextTable,
    check_size,
    sheet_of_file,
)
from packwork.readers.tables.durations import check_durations, written_duration
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.parquet import rows_of_parquet
from packwork.readers.tables.workbook import ending_of

MAX_TABLE_BYTES = 128_000_000
"""Size of a table's file: a million rows of a hundred letters, which take, as text, four times
that at most. Derived from a gigabyte in all."""

JSON = ".json"
PARQUET = (".parquet", ".pq")

SPREADSHEETS = (".xls", ".xlsb", ".ods", ".numbers")
"""Files that hold several tables, pictures and macros."""

Row: TypeAlias = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Table:
    """Rows under named columns; cells that are not there are missing.

    ``usual_decimal`` parts the fraction of a number in a cell of text, where its column does
    not tell; it is empty where that has to be asked. ``notices`` tell of how the table was
    read.
    """

    name: str
    columns: tuple[str, ...]
    rows: tuple[Row, ...]
    usual_decimal: str = "."
    notices: tuple[str, ...] = ()

    def check_column(self, key: str, column: str) -> None:
        """Refuse a column that is not there.

        Examples
        --------
        >>> Table("data", ("a", "b"), ()).check_column("size_by", "c")
        Traceback (most recent call last):
        packwork.errors.RecipeError: size_by: there is no column 'c'; there are a, b
        """
        if column not in self.columns:
            raise RecipeError(key, f"there is no column {no_column(column, self.columns)}")

    def with_numbers(self, column: str, decimal: str | None, *, whole: bool) -> Table:
        """The same table, where the texts of a column know which numbers they are.

        Without a decimal sign, that is told from the column. With ``whole`` the column is
        one of numbers only if all that it holds are some: so categories such as ``1.200``
        need no decision. Dashes and their like are empty cells there.

        Examples
        --------
        >>> table = Table("data", ("kg",), ({"kg": "1,5"}, {"kg": "2 kg"}))
        >>> [row["kg"].number for row in table.with_numbers("kg", None, whole=False).rows]
        [1.5, nan]
        """
        cells = [row.get(column) for row in self.rows]
        if not any(isinstance(cell, str) for cell in cells):
            return self
        if not whole:
            check_durations([cell for cell in cells if not is_blank(cell)], self.name, column)
        try:
            numbers = written_numbers(
                cells, self.name, column, usual=self.usual_decimal, asked=decimal
            )
        except ReadError:
            if whole and not all(_may_be_number(cell) for cell in cells):
                return self
            raise
        if not all(map(math.isnan, numbers)) and (not whole or all(map(_may_be_number, cells))):
            # Dashes say something among texts, such as groups of blood, and nothing among numbers.
            cells = ["" if isinstance(cell, str) and is_blank(cell) else cell for cell in cells]
        rows = tuple(
            {**row, column: Written(cell, number)} if isinstance(cell, str) else row
            for row, cell, number in zip(self.rows, cells, numbers, strict=True)
        )
        return replace(self, rows=rows)


def _may_be_number(cell: Any) -> bool:
    return not isinstance(cell, str) or is_blank(cell) or figure(cell) is not None


def read_table(
    data: str | Sequence[Row], asked: TableFormat | None = None, needed: Iterable[str] = ()
) -> Table:
    """Table of a file (.csv, .tsv, .xlsx, .txt, .json, .parquet), or of rows.

    Of large files the columns that are ``needed`` are read in any case.

    Examples
    --------
    >>> read_table([{"land": "Peru", "kg": 2.0}, {"land": "Kenya"}]).columns
    ('land', 'kg')
    """
    if not isinstance(data, str):
        return _table("data", data)
    said = asked or TableFormat()
    ending = ending_of(data)
    if ending in PARQUET:
        rows = rows_of_parquet(data, read_bytes(data, MAX_TABLE_BYTES), needed)
        return _table(data, [plain_row(row) for row in rows])
    if ending == JSON:
        return _table(data, _rows_of_json(read_json(data, said), data))
    if ending in {*ENDINGS, UNICODE_TEXT}:
        sheet = sheet_of_file(data, MAX_TABLE_BYTES, said)
        table = _table(data, _rows_of_sheet(sheet))
        usual = "." if sheet.delimiter == "," else ""
        told = (sheet.notice,) if sheet.notice else ()
        return replace(table, usual_decimal=usual, notices=told)
    known = ", ".join((*ENDINGS, JSON, PARQUET[0]))
    if ending in SPREADSHEETS:
        raise ReadError(data, "is a spreadsheet; save it as .xlsx or CSV (UTF-8) and give that")
    raise ReadError(data, f"is no table; give a file that ends in {known}")


def _rows_of_sheet(sheet: TextTable) -> list[Row]:
    """Rows by the columns that the first line names; empty cells at the ends are none."""
    lines = iter(sheet.lines())
    first, cells = next(lines, (1, []))
    names = [" ".join(name.split()) for name in cells]
    while names and not names[-1]:
        names.pop()
    names = [name or f"column {k}" for k, name in enumerate(names, start=1)]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise ReadError(
            sheet.file, f"line {first}: names the column {twice[:40]!r} twice; name each once"
        )
    rows = []
    for number, row in lines:
        if any(row[len(names) :]):
            raise ReadError(
                sheet.file,
                f"line {number}: has {len(row)} cells, the first line names {len(names)}; quote "
                "cells that hold the delimiter, and begin with the names of all columns",
            )
        rows.append(dict(zip(names, row, strict=False)))
    return rows


def _rows_of_json(data: Any, file: str) -> list[Row]:
    """Rows of ``[{"land": "Peru"}]`` or of columns ``{"land": ["Peru"]}``."""
    if isinstance(data, dict) and data and all(isinstance(v, list) for v in data.values()):
        lengths = {len(values) for values in data.values()}
        if len(lengths) == 1:
            check_size(file, lengths.pop())
            return [
                dict(zip(data, cells, strict=True)) for cells in zip(*data.values(), strict=True)
            ]
    if isinstance(data, list) and all(isinstance(row, dict) for row in data):
        return data
    raise ReadError(file, 'holds no rows; give [{"land": "Peru", "kg": 2}] or {"land": ["Peru"]}')


def _table(name: str, rows: Sequence[Row]) -> Table:
    check_size(name, len(rows))
    if not rows:
        raise ReadError(name, "has no rows; give a line of column names, then one for each row")
    columns = tuple(dict.fromkeys(key for row in rows for key in row))
    return Table(name, columns, tuple(rows))


def rows_of_frame(data: Any, *, has_row_numbers: bool = True) -> list[dict[str, Any]]:
    """Rows of a data frame (pandas, polars, pyarrow), a dict of columns, or dicts.

    An index of pandas that is more than numbers of rows becomes columns, as ``reset_index`` has
    it; unless ``has_row_numbers`` is false, numbers of rows that were sorted or left out as
    well.

    Examples
    --------
    >>> rows_of_frame({"land": ["Peru", "Kenya"], "kg": [2, 3]})
    [{'land': 'Peru', 'kg': 2}, {'land': 'Kenya', 'kg': 3}]
    """
    data = collected(data)
    if isinstance(data, Sized) and len(data) > MOST_ROWS:
        raise RecipeError("data", f"has more than {MOST_ROWS:,} rows, which are the most")
    if hasattr(data, "columns") and hasattr(data, "to_dicts"):
        return [plain_row(row) for row in data.to_dicts()]
    if hasattr(data, "column_names") and hasattr(data, "to_pylist"):
        return [plain_row(row) for row in data.to_pylist()]
    if hasattr(data, "columns") and hasattr(data, "to_dict"):
        return [plain_row(row) for row in _with_index(data, has_row_numbers).to_dict("records")]
    if isinstance(data, Mapping):
        columns = {str(name): list(cells) for name, cells in data.items() if _is_column(cells)}
        if len(columns) < len(data) or len({len(cells) for cells in columns.values()}) != 1:
            raise RecipeError("data", "use a list of cells for each column, all equally long")
        rows = zip(*columns.values(), strict=True)
        return [plain_row(dict(zip(columns, cells, strict=True))) for cells in rows]
    if isinstance(data, Sequence) and all(isinstance(row, Mapping) for row in data):
        return [plain_row(row) for row in data]
    raise RecipeError(
        "data", "use a file, a data frame, or rows such as [{'land': 'Peru', 'kg': 2}]"
    )


def collected(data: Any) -> Any:
    """A lazy frame's rows as a frame, one more of them than may be at most; all else as it is.

    Examples
    --------
    >>> collected({"land": ["Peru"]})
    {'land': ['Peru']}
    """
    return data.head(MOST_ROWS + 1).collect() if hasattr(data, "collect") else data


def is_frame(data: Any) -> bool:
    """Whether something is a table of pandas, polars or pyarrow.

    Examples
    --------
    >>> is_frame({"land": ["Peru"]})
    False
    """
    ways = ("to_dict", "to_dicts", "to_pylist", "collect")
    return hasattr(data, "columns") and any(hasattr(data, way) for way in ways)


def index_of_frame(data: Any) -> dict[str, str]:
    """Columns that were the index of a data frame of pandas, with their types; else none.

    Examples
    --------
    >>> index_of_frame({"land": ["Peru"]})
    {}
    """
    with_index = _with_index(data, has_row_numbers=True)
    if with_index is data:
        return {}
    names = with_index.columns[: data.index.nlevels]
    return {str(name): str(with_index[name].dtype) for name in names}


def categorical_columns(data: Any) -> tuple[str, ...]:
    """Columns of a data frame of pandas that hold categories, whatever these are called.

    Examples
    --------
    >>> categorical_columns({"land": ["Peru"]})
    ()
    """
    types: Any = getattr(data, "dtypes", None)
    pairs = types.items() if hasattr(types, "items") else ()
    return tuple(str(name) for name, kind in pairs if str(kind) == "category")


def is_count(index: Any) -> bool:
    """Whether an index of pandas has no name and counts rows from 0."""
    is_range = type(index).__name__ == "RangeIndex" and index.name is None
    return is_range and (index.start, index.step) == (0, 1)


def _with_index(frame: Any, has_row_numbers: bool) -> Any:
    """The frame with its index among the columns, unless that only counts the rows."""
    index: Any = getattr(frame, "index", None)
    if index is None or not hasattr(frame, "reset_index"):
        return frame
    has_numbers = index.name is None and getattr(index.dtype, "kind", "") in "iu"
    if is_count(index) or (has_numbers and not has_row_numbers):
        return frame
    try:
        return frame.reset_index()
    except ValueError:
        # A column is called so already.
        return frame


def _is_column(cells: Any) -> bool:
    return isinstance(cells, Iterable) and not isinstance(cells, str | bytes)


def plain_row(row: Mapping[Any, Any]) -> dict[str, Any]:
    """Cells that files can hold: numbers and truth as they are, all else as its text.

    Lengths of time as ``h:mm:ss``.

    Examples
    --------
    >>> import datetime
    >>> plain_row({"n": 2, "day": datetime.date(2024, 5, 1), "x": float("nan")})
    {'n': 2, 'day': '2024-05-01', 'x': None}
    """
    return {str(key): _cell(cell) for key, cell in row.items()}


def _cell(cell: Any) -> Any:
    # Scalars of NumPy alone: cells may hold whole arrays.
    value = cell.item() if getattr(cell, "shape", None) == () else cell
    if isinstance(value, int) and getattr(cell, "dtype", None) is not None:
        kind = cell.dtype.kind
        # Days and lengths of time in nanoseconds, of which NumPy makes whole numbers.
        value = cell.astype(f"{kind}8[us]").item() if kind in {"m", "M"} else value
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        # What is not there is not a number in frames.
        return None if value != value else value
    text = written_duration(value) if isinstance(value, timedelta) else str(value)
    return None if text in {"NaT", "<NA>"} else text
