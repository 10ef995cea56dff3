"""Vectors that say which items are alike: a row of numbers for each, from arrays and tables."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.errors import ReadError, RecipeError
from packwork.phrasing import enumerated
from packwork.readers.memory.values import GivenVectors
from packwork.readers.reading import read_bytes
from packwork.readers.tables.cells import Written
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.table import Row, Table, read_table
from packwork.sources import stored

MAX_BYTES = 512_000_000
"""Size of an array's file: 100,000 vectors of 600 numbers. Chosen."""

ARRAY = ".npy"

SAME = 1e-12
"""Cosine distance of all vectors from the first below which they say nothing. Chosen."""


@dataclass(frozen=True, eq=False)
class Vectors:
    """Rows of numbers ``(n, d)``, finite, and names of rows, columns and groups that a file has."""

    file: str
    names: tuple[str, ...] | None
    rows: FloatArray
    columns: tuple[str, ...] = ()
    groups: tuple[str, ...] | None = None

    def called(self, name: str) -> FloatArray:
        """``(d,)`` vector of a row by its name, or else the axis of a column.

        Examples
        --------
        >>> found = Vectors("a.csv", ("bear", "fox"), np.eye(2), ("warm", "cold"))
        >>> found.called("Fox").tolist(), found.called("warm").tolist()
        ([0.0, 1.0], [1.0, 0.0])
        """
        wanted = name.casefold()
        for names, vectors in (
            (self.names or (), self.rows),
            (self.columns, np.eye(self.rows.shape[1])),
        ):
            folded = [one.casefold() for one in names]
            if wanted in folded:
                return np.asarray(vectors[folded.index(wanted)])
        there = enumerated([*self.columns, *(self.names or ())], 6) or "rows without names alone"
        raise RecipeError("anchors", f"{self.file} has no {name[:40]!r}; there are {there}")


def read_vectors(file: str, asked: TableFormat | None = None) -> Vectors:
    """Vectors of a file: an array of NumPy, or a table whose columns are their numbers.

    A table's first column may hold names, and one more texts: of what group each is. A first line
    of numbers alone is a row too.
    """
    found = _read(file, asked)
    broken = np.argwhere(~np.isfinite(found.rows))
    if len(broken):
        row, column = broken[0]
        called = f"row {row + 1}" if found.names is None else repr(found.names[row][:40])
        raise ReadError(file, f"{called}: number {column + 1} is none; give each row all numbers")
    _check_apart(found)
    return found


def _read(file: str, asked: TableFormat | None) -> Vectors:
    known = stored(file)
    if isinstance(known, GivenVectors):
        return Vectors(file, known.names, known.rows, known.columns, known.groups)
    if Path(file).suffix.lower() == ARRAY:
        return _of_array(file)
    return _of_table(read_table(file, asked), asked)


def _check_apart(found: Vectors) -> None:
    lengths = np.linalg.norm(found.rows, axis=1)
    if not lengths.any():
        raise ReadError(found.file, "holds zeros alone, which say nothing of any item")
    units = found.rows[lengths > 0] / lengths[lengths > 0, None]
    if len(found.rows) > 1 and (lengths > 0).all() and (1 - units @ units[0]).max() < SAME:
        raise ReadError(found.file, "has vectors of one direction alone; they tell no items apart")


def _of_array(file: str) -> Vectors:
    """An array that the file's own header does not lie about."""
    data = read_bytes(file, MAX_BYTES)
    stream = io.BytesIO(data)
    try:
        version = np.lib.format.read_magic(stream)
        read = {
            (1, 0): np.lib.format.read_array_header_1_0,
            (2, 0): np.lib.format.read_array_header_2_0,
        }[version]
        shape, is_fortran, kind = read(stream)
    except (ValueError, KeyError, SyntaxError, OverflowError) as error:
        why = " ".join(str(error).split())[:80]
        raise ReadError(file, f"is no array of NumPy ({why}); save it by numpy.save") from None
    if len(shape) != 2 or min(shape) < 1:
        raise ReadError(file, f"is an array of shape {shape}; give one row of numbers an item")
    if kind.kind not in "fiu" or kind.hasobject:
        raise ReadError(file, f"holds {kind}, not numbers; save an array of float32 or float64")
    if math.prod(shape) * kind.itemsize != len(data) - stream.tell():
        raise ReadError(file, f"is cut off, or too long, for its shape {shape}")
    flat = np.frombuffer(data, dtype=kind, offset=stream.tell())
    rows = flat.reshape(shape, order="F" if is_fortran else "C")
    return Vectors(file, None, rows.astype(np.float64))


def _of_table(table: Table, asked: TableFormat | None) -> Vectors:
    """Columns of numbers, the first one names unless it is numbers too."""
    first, rows = table.columns[0], _with_first_line(table)
    has_names = any(_number(row.get(first)) is None for row in rows) and _is_text(rows, first)
    columns = table.columns[1:] if has_names else table.columns
    kinds = [column for column in columns if has_names and _is_all_text(rows, column)]
    if len(kinds) > 1:
        told = enumerated([repr(kind) for kind in kinds])
        raise ReadError(table.name, f"has columns of texts, {told}; leave one, which names groups")
    columns = tuple(column for column in columns if column not in kinds)
    if not columns:
        raise ReadError(table.name, "has names alone; give columns of numbers beside them")
    decimal = asked.decimal if asked is not None else None
    cells = [_column(table, rows, column, decimal) for column in columns]
    names = tuple(str(row.get(first)).strip() for row in rows) if has_names else None
    if names is not None and len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise ReadError(table.name, f"has {twice[:40]!r} twice; give each name one row")
    called = tuple(columns) if len(rows) == len(table.rows) else ()
    groups = (
        tuple(" ".join(str(row.get(kinds[0]) or "").split()) for row in rows) if kinds else None
    )
    return Vectors(table.name, names, np.array(cells).T, called, groups)


def _with_first_line(table: Table) -> Sequence[Row]:
    """Rows; what was taken for the names of columns is one too if it is numbers alone."""
    first = [_number(name) for name in table.columns]
    if any(number is None for number in first):
        return table.rows
    return (dict(zip(table.columns, first, strict=True)), *table.rows)


def _is_text(rows: Sequence[Row], column: str) -> bool:
    """Whether no cell is a number as any language writes it, so that they are names."""
    cells = [row.get(column) for row in rows]
    return any(isinstance(cell, str) and any(map(str.isalpha, cell)) for cell in cells)


def _is_all_text(rows: Sequence[Row], column: str) -> bool:
    """Whether no cell could be a number; some may be empty."""
    cells = [cell for row in rows if (cell := row.get(column)) not in (None, "")]
    return bool(cells) and all(
        isinstance(cell, str) and any(map(str.isalpha, cell)) and _number(cell) is None
        for cell in cells
    )


def _column(table: Table, rows: Sequence[Row], column: str, decimal: str | None) -> list[float]:
    """Numbers of a column, NaN for what is none."""
    numbers = [_number(row.get(column)) for row in rows]
    if any(number is None for number in numbers):
        read = table.with_numbers(column, decimal, whole=False).rows
        told = [row.get(column) for row in read]
        offset = len(rows) - len(told)
        for k, cell in enumerate(told, start=offset):
            numbers[k] = cell.number if isinstance(cell, Written) else numbers[k]
    return [math.nan if number is None else number for number in numbers]


def _number(cell: object) -> float | None:
    try:
        return float(cell)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return None


def in_order(vectors: Vectors, names: Sequence[Sequence[str]]) -> tuple[FloatArray, BoolArray]:
    """Vectors of things that go by several names each, and which of them have one.

    Without names in the file there must be a row for each, in their order. Letters' case counts
    only where two names differ by nothing else.

    Examples
    --------
    >>> vectors = Vectors("a.csv", ("Bear", "fox"), np.eye(2))
    >>> in_order(vectors, [["bear", "bear.svg"], ["owl", "owl.svg"]])[1].tolist()
    [True, False]
    """
    found = _places(vectors, names)
    known = np.array([k is not None for k in found])
    rows = np.zeros((len(names), vectors.rows.shape[1]))
    rows[known] = vectors.rows[[k for k in found if k is not None]]
    return rows, known


def groups_in_order(vectors: Vectors, names: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """Groups of things that go by several names each; empty for what is of none."""
    if vectors.groups is None:
        return ("",) * len(names)
    groups = vectors.groups
    return tuple("" if k is None else groups[k] for k in _places(vectors, names))


def _places(vectors: Vectors, names: Sequence[Sequence[str]]) -> Sequence[int | None]:
    """Row of each thing; None for none."""
    if vectors.names is None:
        if len(vectors.rows) != len(names):
            raise ReadError(
                vectors.file,
                f"has {len(vectors.rows):,} rows, and there are {len(names):,} items; give a row "
                "for each, in their order, or a first column of names",
            )
        return range(len(names))
    exact = {name: k for k, name in enumerate(vectors.names)}
    alike = {name.casefold(): k for k, name in reversed(list(enumerate(vectors.names)))}

    def row_of(own: Sequence[str]) -> int | None:
        for by_name, called in ((exact, own), (alike, [name.casefold() for name in own])):
            for name in called:
                if name in by_name:
                    return by_name[name]
        return None

    found = [row_of(own) for own in names]
    if all(k is None for k in found):
        there, asked = ", ".join(vectors.names[:6]), ", ".join(own[0] for own in names[:6])
        raise ReadError(vectors.file, f"names none of the items ({asked} ...), but {there} ...")
    return found
