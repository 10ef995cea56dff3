"""Tables from files, and from what Python programs hold."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from packwork.errors import ReadError, RecipeError
from packwork.readers.files import read_bytes, read_text
from packwork.readers.tables.delimited import ENDINGS, check_rows, lines_of_cells
from packwork.readers.tables.frames import rows_of_parquet

MAX_TABLE_BYTES = 256_000_000
"""Size of a table's file: a million rows of a few hundred letters. Chosen."""

JSON = ".json"
PARQUET = (".parquet", ".pq")

Row: TypeAlias = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Table:
    """Rows under named columns.

    Parameters
    ----------
    name
        For messages: the file, or ``data``.
    columns
        In the order of the file.
    rows
        Cells by column; those that are not there are missing.
    """

    name: str
    columns: tuple[str, ...]
    rows: tuple[Row, ...]

    def check_column(self, key: str, column: str) -> None:
        """Refuse a column that is not there.

        Raises
        ------
        RecipeError
            About the option ``key``, saying which columns there are.

        Examples
        --------
        >>> Table("data", ("a", "b"), ()).check_column("size_by", "c")
        Traceback (most recent call last):
        packwork.errors.RecipeError: size_by: there is no column 'c'; there are a, b
        """
        if column not in self.columns:
            there = ", ".join(self.columns[:20])
            raise RecipeError(key, f"there is no column {column[:40]!r}; there are {there}")


def read_table(data: str | Sequence[Row]) -> Table:
    """Table of a file (.csv, .tsv, .json, .parquet), or of rows.

    Raises
    ------
    ReadError
        If it cannot be read or has no rows.

    Examples
    --------
    >>> read_table([{"land": "Peru", "kg": 2.0}, {"land": "Kenya"}]).columns
    ('land', 'kg')
    """
    if not isinstance(data, str):
        return _table("data", data)
    ending = Path(data).suffix.lower()
    if ending in PARQUET:
        return _table(data, rows_of_parquet(data, read_bytes(data, MAX_TABLE_BYTES)))
    if ending == JSON:
        return _table(data, _rows_of_json(read_text(data, MAX_TABLE_BYTES), data))
    if ending in ENDINGS:
        return _table(data, _rows_of_csv(read_text(data, MAX_TABLE_BYTES), data, ENDINGS[ending]))
    known = ", ".join((*ENDINGS, JSON, PARQUET[0]))
    raise ReadError(data, f"is no table; give a file that ends in {known}")


def _rows_of_csv(text: str, file: str, separator: str) -> list[Row]:
    lines = iter(lines_of_cells(text, file, separator))
    _, names = next(lines, (0, []))
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise ReadError(file, f"line 1: names the column {twice[:40]!r} twice; name each once")
    rows = []
    for number, cells in lines:
        if len(cells) > len(names):
            raise ReadError(
                file, f"line {number}: has {len(cells)} cells, the first line names {len(names)}"
            )
        rows.append(dict(zip(names, cells, strict=False)))
    return rows


def _rows_of_json(text: str, file: str) -> list[Row]:
    """Rows of ``[{"land": "Peru"}]`` or of columns ``{"land": ["Peru"]}``."""
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ReadError(file, f"is not JSON ({error})") from None
    if isinstance(data, dict) and data and all(isinstance(v, list) for v in data.values()):
        lengths = {len(values) for values in data.values()}
        if len(lengths) == 1:
            return [
                dict(zip(data, cells, strict=True)) for cells in zip(*data.values(), strict=True)
            ]
    if isinstance(data, list) and all(isinstance(row, dict) for row in data):
        return data
    raise ReadError(file, 'holds no rows; give [{"land": "Peru", "kg": 2}] or {"land": ["Peru"]}')


def _table(name: str, rows: Iterable[Mapping[str, Any]]) -> Table:
    kept = tuple({str(key): cell for key, cell in row.items()} for row in rows)
    check_rows(len(kept), name)
    if not kept:
        raise ReadError(name, "has no rows; give a line of column names, then one for each row")
    columns = tuple(dict.fromkeys(key for row in kept for key in row))
    return Table(name, columns, kept)
