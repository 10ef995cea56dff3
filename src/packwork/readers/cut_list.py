"""Cut lists: tables of parts, how many of each, and how each may lie."""

from __future__ import annotations

import logging
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from packwork.errors import ReadError
from packwork.phrasing import MOST_NAMED, enumerated
from packwork.readers.reading import exists
from packwork.readers.tables.delimited import ENDINGS, UNICODE_TEXT, TextTable, sheet_of_file
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.table import SPREADSHEETS
from packwork.readers.tables.workbook import ending_of
from packwork.sources import here_of

_LOG = logging.getLogger("packwork")

MAX_LIST_BYTES = 4_000_000
"""Size of a list. Chosen: a thousand bytes for each of its rows."""

MOST_ROWS = 4_000
"""Rows of a list. Chosen: more than there may be parts in a nest."""

COLUMNS: Mapping[str, tuple[str, ...]] = {
    "file": ("file", "path", "drawing"),
    "count": ("count", "quantity", "qty", "pieces"),
    "name": ("name", "part", "label"),
}
"""Names of columns by their meanings, in small letters; the first that is there counts."""

_COUNT = re.compile(r"[0-9]{1,6}(?:[.,]0{0,2})?")


@dataclass(frozen=True, kw_only=True)
class CutListRow:
    """One row: a file as found from here, how many, a name or none, and what else is said.

    ``rules``: cells of other columns by their names, those that are empty left out.
    ``where``: the line, as messages name it.
    """

    file: str
    count: int = 1
    name: str = ""
    rules: Mapping[str, str] = field(default_factory=dict)
    where: str = ""


def is_cut_list(path: str | Path) -> bool:
    """Whether a file of that name is a table.

    Examples
    --------
    >>> is_cut_list("parts.csv"), is_cut_list("part.dxf")
    (True, False)
    """
    return ending_of(str(path)) in {*ENDINGS, *SPREADSHEETS, UNICODE_TEXT}


def read_cut_list(path: str | Path, rules: Collection[str] = ()) -> tuple[CutListRow, ...]:
    """Rows of a table of parts; its files are found from its folder.

    Parameters
    ----------
    rules
        Names of further columns that mean something; others are named in a notice.

    Raises
    ------
    ReadError
        If it is no such table, a count is none, or there is no such file.
    """
    if ending_of(str(path)) in SPREADSHEETS:
        raise ReadError(path, "is a spreadsheet; save it as .xlsx or CSV (UTF-8) and give that")
    sheet = sheet_of_file(str(path), MAX_LIST_BYTES, TableFormat())
    lines = sheet.lines()
    columns = _columns(sheet, next(lines, (1, []))[1], rules)
    rows = tuple(_rows(sheet, lines, columns))
    if not rows:
        raise ReadError(path, "lists no parts; give a row for each below the names of columns")
    home = here_of(Path(path).parent).resolve()
    outside = [row.file for row in rows if not here_of(row.file).resolve().is_relative_to(home)]
    if outside:
        names = enumerated(list(dict.fromkeys(outside)), MOST_NAMED)
        _LOG.warning("%s names files outside its folder: %s", path, names)
    return rows


def _columns(sheet: TextTable, cells: Sequence[str], rules: Collection[str]) -> list[str]:
    """Meaning of each column: one of ``COLUMNS``, of ``rules``, or none."""
    told = [" ".join(cell.split()) for cell in cells]
    names = [name.casefold() for name in told]
    twice = next((name for name in names if name and names.count(name) > 1), None)
    if twice is not None:
        raise ReadError(sheet.file, f"has the column {twice!r} twice; name each once")
    means = [name if name in rules else "" for name in names]
    for meaning, known in COLUMNS.items():
        found = next((name for name in known if name in names), None)
        if found is not None:
            means[names.index(found)] = meaning
    if "file" not in means:
        raise ReadError(
            sheet.file,
            f"has no column 'file', but {enumerated(told, MOST_NAMED) or 'none'}; name the columns "
            "in the first line, as file,count",
        )
    strange = [name for name, meaning in zip(told, means, strict=True) if name and not meaning]
    if strange:
        known_ones = ", ".join((*COLUMNS, *rules))
        _LOG.warning(
            "%s: columns that say nothing here: %s; known are %s",
            sheet.file, enumerated(strange, MOST_NAMED), known_ones,
        )  # fmt: skip
    return means


def _rows(
    sheet: TextTable, lines: Iterator[tuple[int, list[str]]], columns: Sequence[str]
) -> Iterator[CutListRow]:
    folder = Path(sheet.file).parent
    told = f"; {sheet.notice}" if sheet.notice else ""
    for count, (number, cells) in enumerate(lines, start=1):
        if count > MOST_ROWS:
            raise ReadError(sheet.file, f"has more than {MOST_ROWS:,} rows; give several lists")
        where = f"line {number}"
        if any(cells[len(columns) :]):
            many = f"has {len(cells)} cells, the first line names {len(columns)}"
            raise ReadError(sheet.file, f"{where}: {many}")
        said = {name: cell for name, cell in zip(columns, cells, strict=False) if name and cell}
        named = said.pop("file", "")
        if not named:
            raise ReadError(sheet.file, f"{where}: names no file")
        file = folder / named
        if not exists(file):
            raise ReadError(sheet.file, f"{where}: there is no file {str(file)[:200]!r}")
        written = said.pop("count", "" if "count" in columns else "1")
        if not _COUNT.fullmatch(written):
            raise ReadError(
                sheet.file, f"{where}: a count is a whole number from 0, not {written[:20]!r}{told}"
            )
        yield CutListRow(
            file=str(file), count=int(re.split("[.,]", written)[0]), name=said.pop("name", ""),
            rules=said, where=where,
        )  # fmt: skip
