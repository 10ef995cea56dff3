"""Tables of names and numbers: words and their weights, items and theirs."""

from __future__ import annotations

import logging
import math
import shlex
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

from packwork.errors import ReadError, RecipeError
from packwork.phrasing import MOST_COLUMNS, enumerated, no_column
from packwork.readers.tables.cells import is_amount, is_blank, written_numbers
from packwork.readers.tables.decoding import read_json
from packwork.readers.tables.delimited import TextTable, check_size, sheet_of_file
from packwork.readers.tables.durations import check_durations
from packwork.readers.tables.format import TableFormat

MOST_NAMED = 6
"""Rows that a notice names. Chosen."""

MAX_TABLE_BYTES = 5_000_000
"""Size of a table, unless it is of words. Chosen."""

NAME_COLUMNS = ("word", "text", "name", "term", "label", "key")
NUMBER_COLUMNS = ("weight", "count", "frequency", "freq", "value", "size", "n")
"""Names under which tables of others keep the two; else the first and second column."""


class PairColumns(NamedTuple):
    """Columns of the names and of the numbers; None for those that are called so, or come first."""

    label_by: str | None = None
    size_by: str | None = None

    def check(self, rows: Sequence[tuple[str, Mapping[str, Any]]]) -> None:
        """Refuse columns that no row has."""
        there = list(dict.fromkeys(str(key) for _, row in rows for key in row))
        for option, column in self._asdict().items():
            if column is not None and column not in there:
                raise RecipeError(option, f"the table has no column {no_column(column, there)}")


USUAL = PairColumns()


@dataclass(frozen=True)
class Pair:
    """A row of such a table: a name or none, a number or NaN, and that as it stands in the file."""

    name: str
    number: float
    written: Any
    where: str
    others: Mapping[str, str] = field(default_factory=dict)

    @property
    def is_sound(self) -> bool:
        """Whether there is a name, and a positive number."""
        return bool(self.name) and math.isfinite(self.number) and self.number > 0

    def wanted(self, noun: str) -> str:
        """Words for what a row that is not sound should have.

        Examples
        --------
        >>> Pair("", 1.0, "1", "line 3").wanted("word")
        'needs a word and a weight, as in bear,2'
        """
        if not self.name or self.written is None:
            return f"needs a {noun} and a weight, as in bear,2"
        return f"a weight must be a positive number, not {str(self.written)[:20]!r}"


@dataclass(frozen=True, eq=False)
class Pairs:
    """Rows of a table of names and numbers, and what has to be told of how they were read.

    ``taken``: which of more than two columns were taken by their place, and how to take others;
    ``instead``: options that would take a column of numbers. Both are empty where names tell.
    """

    rows: tuple[Pair, ...]
    notices: tuple[str, ...] = ()
    taken: str = ""
    instead: str = ""


def read_pairs(
    file: str,
    asked: TableFormat,
    most_bytes: int = MAX_TABLE_BYTES,
    columns: PairColumns = USUAL,
) -> Pairs:
    """Names and numbers of a file: lines of cells, or JSON.

    Its first line may name the columns, and then there may be more of them.
    """
    if file.lower().endswith(".json"):
        return _pairs(_entries(read_json(file, asked), file), file, asked, ".", columns)
    sheet = sheet_of_file(file, most_bytes, asked)
    usual = "." if sheet.delimiter == "," else ""
    found = _pairs(_rows(sheet, any(columns)), file, asked, usual, columns)
    return replace(found, notices=(sheet.notice,) if sheet.notice else ())


def pairs_of_rows(rows: Sequence[Mapping[str, Any]], columns: PairColumns = USUAL) -> Pairs:
    """Names and numbers of rows that a program holds.

    Examples
    --------
    >>> (pair,) = pairs_of_rows([{"word": "bear", "n": 2, "year": 9}]).rows
    >>> pair.name, pair.others
    ('bear', {'year': '9'})
    """
    return _pairs(_entries(list(rows), "data"), "data", TableFormat(), ".", columns)


def _rows(sheet: TextTable, is_named: bool) -> list[tuple[str, Mapping[str, Any]]]:
    lines = list(sheet.lines())
    if not lines:
        return []
    first = lines[0][1]
    named = is_named or (len(first) > 1 and not any(map(is_amount, first)))
    names = [" ".join(name.split()) for name in first] if named else ["word", "weight"]
    rows: list[tuple[str, Mapping[str, Any]]] = []
    for line, cells in lines[1:] if named else lines:
        if any(cells[len(names) :]):
            raise ReadError(
                sheet.file,
                f"line {line}: has {len(cells)} cells, not {len(names)}; quote those that hold the "
                'delimiter, as "1,5", and name further columns in the first line',
            )
        rows.append((f"line {line}", dict(zip(names, cells, strict=False))))
    return rows


def _entries(data: Any, file: str) -> list[tuple[str, Mapping[str, Any]]]:
    """Entries of ``{"bear": 2}``, ``[["bear", 2]]`` or ``[{"word": "bear", "weight": 2}]``."""
    if isinstance(data, dict):
        data = list(data.items())
    if isinstance(data, list):
        check_size(file, len(data))
        if all(isinstance(entry, dict) for entry in data):
            return [(f"entry {k}", entry) for k, entry in enumerate(data, start=1)]
        if all(isinstance(entry, list | tuple) and len(entry) == 2 for entry in data):
            return [
                (f"entry {k}", {"word": word, "weight": weight})
                for k, (word, weight) in enumerate(data, start=1)
            ]
    raise ReadError(file, 'holds no words; give {"bear": 2, "fox": 1} or [["bear", 2]]')


def _pairs(
    rows: Sequence[tuple[str, Mapping[str, Any]]],
    file: str,
    asked: TableFormat,
    usual: str,
    wanted: PairColumns,
) -> Pairs:
    wanted.check(rows)
    columns = [_columns(row, wanted) for _, row in rows]
    cells = [row.get(second) for (_, row), (_, second) in zip(rows, columns, strict=True)]
    name = next((second for _, second in columns), "weight")
    check_durations([cell for cell in cells if not is_blank(cell)], file, name)
    numbers = written_numbers(cells, file, name, usual=usual, asked=asked.decimal)
    return Pairs(
        tuple(
            Pair(
                name=" ".join(text.split()) if isinstance(text := row.get(first), str) else "",
                number=number,
                written=None if cell is None or not str(cell).strip() else cell,
                where=where,
                others={key: str(row[key]) for key in row if key not in (first, second)},
            )
            for (where, row), (first, second), cell, number in zip(
                rows, columns, cells, numbers, strict=True
            )
        ),
        (),
        *_told_of_columns([row for _, row in rows], columns, wanted),
    )


def _told_of_columns(
    rows: Sequence[Mapping[str, Any]], columns: Sequence[tuple[str, str]], wanted: PairColumns
) -> tuple[str, str]:
    """Columns taken of more than two, and options that take others; empty if names tell."""
    if not rows or len(rows[0]) < 3:
        return "", ""
    usual = NAME_COLUMNS, NUMBER_COLUMNS
    if all(
        asked is not None or str(taken).strip().lower() in names
        for asked, taken, names in zip(wanted, columns[0], usual, strict=True)
    ):
        return "", ""
    there = list(map(str, rows[0]))
    first, second = columns[0]
    taken = (
        f"{first} and {second} are taken of the columns {enumerated(there, MOST_COLUMNS)}; "
        "--label-by and --size-by take others"
    )
    numeric = [key for key in rows[0] if all(is_amount(str(row.get(key, ""))) for row in rows)]
    texts = [key for key in rows[0] if key not in numeric]
    if not numeric or not texts:
        return taken, ""
    label = first if first in texts else texts[0]
    return taken, f"--label-by {shlex.quote(str(label))} --size-by {shlex.quote(str(numeric[-1]))}"


def _columns(row: Mapping[str, Any], asked: PairColumns) -> tuple[str, str]:
    keys = list(row)
    by_name = {str(key).strip().lower(): key for key in keys}
    left = [key for key in keys if key != asked.size_by]
    first = asked.label_by or _first(NAME_COLUMNS, by_name) or (left[0] if left else "")
    rest = [key for key in keys if key != first]
    wanted = asked.size_by or _first(NUMBER_COLUMNS, by_name)
    return first, wanted if wanted in rest else rest[0] if rest else ""


def _first(names: Iterable[str], by_name: Mapping[str, str]) -> str | None:
    return next((by_name[name] for name in names if name in by_name), None)


_LOG = logging.getLogger("packwork")


def read_weights(path: str | Path, asked: TableFormat | None = None) -> dict[str, float]:
    """Weights by item name, in the file's order.

    The file has two columns, ``name,weight``; a line that names them may stand on top.
    """
    table = read_pairs(str(path), asked or TableFormat())
    weights: dict[str, float] = {}
    twice = []
    for pair in table.rows:
        if not pair.is_sound:
            raise ReadError(
                path, "; ".join((f"{pair.where}: {pair.wanted('name')}", *table.notices))
            )
        if pair.name in weights:
            twice.append(f"{pair.name[:40]!r} ({pair.where})")
        known = weights.setdefault(pair.name, pair.number)
        if known != pair.number:
            raise ReadError(
                path,
                f"{pair.where}: {pair.name!r} stands there twice, as {known:g} and as "
                f"{pair.number:g}; give it one weight",
            )
    if not weights:
        raise ReadError(path, "holds no weights; give lines such as bear,2")
    repeated = f"says the same again of {enumerated(twice, MOST_NAMED)}; that counts once"
    for notice in (*table.notices, *([repeated] if twice else [])):
        _LOG.warning("%s: %s", path, notice)
    return weights
