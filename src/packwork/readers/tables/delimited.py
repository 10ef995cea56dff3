"""Lines of cells: CSV and TSV, as programs and spreadsheets write them."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from packwork.errors import ReadError
from packwork.readers.tables.cells import is_number_like
from packwork.readers.tables.decoding import decoded
from packwork.readers.tables.format import TableFormat

ENDINGS = {".csv": ",", ".tsv": "\t", ".tab": "\t"}
"""What parts the cells of a line, by the file's ending, where the lines do not show it."""

NAMES = {",": "commas", ";": "semicolons", "\t": "tabs", "|": "bars"}
"""Delimiters that are looked for, and what they are called."""

TYPED = {"\t": "tab", ";": '";"', "|": '"|"'}
"""Those that a command line needs written in another way."""

MOST_ROWS = 1_000_000
"""Rows of one table. Chosen."""

MOST_CELLS = 4_000_000
"""Cells of one table: some sixty bytes each in memory, and more for the rows that hold them.
Derived."""

SAMPLE_LINES = 200
"""Lines by which the delimiter is told. More take longer and tell little more. Chosen."""

SAMPLE_LETTERS = 1_000 * SAMPLE_LINES
"""Letters of these at most: a thousand a line."""

_DECLARED = re.compile(r'"?sep=(.)"?[ \t]*\r?(?:\n|$)', re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class TextTable:
    """A file of lines of cells, its letters and delimiter known, and how it was read."""

    file: str
    text: str
    delimiter: str
    skipped: int = 0
    notice: str = ""

    def lines(self) -> Iterator[tuple[int, list[str]]]:
        """Number and cells of each line that is not empty, as :func:`lines_of_cells`."""
        for number, cells in lines_of_cells(self.text, self.file, self.delimiter):
            yield number + self.skipped, cells


def read_sheet(data: bytes, file: str, ending: str, asked: TableFormat) -> TextTable:
    r"""A file's lines of cells; its first line may be ``sep=;``, as Excel has it.

    Examples
    --------
    >>> sheet = read_sheet(b"sep=|\nbear|2,5\n", "t.csv", ".csv", TableFormat())
    >>> list(sheet.lines())
    [(2, ['bear', '2,5'])]
    """
    read = decoded(data, file, asked.encoding)
    text, skipped, said = read.text, 0, asked.delimiter
    declared = _DECLARED.match(text)
    if declared is not None:
        text, skipped = text[declared.end() :], 1
        said = said or declared[1]
    delimiter = said or delimiter_of(text, file, ENDINGS.get(ending, ","))
    return TextTable(file, text, delimiter, skipped, read.notice)


def delimiter_of(text: str, file: str, usual: str) -> str:
    r"""Delimiter that parts the lines of a text into equally many cells.

    Of several the one within whose cells the others stand in numbers alone, as the commas of
    ``bear;2,5`` do. Where none parts all lines alike, the usual one.

    Examples
    --------
    >>> delimiter_of("land;kg\nPeru, south;1,5\n", "t.csv", ",")
    ';'
    >>> delimiter_of("bear;2,5\nfox;1,5\n", "t.csv", ",")
    ';'
    """
    sample = _sample(text)
    parted = {mark: _parted(sample, mark) for mark in NAMES}
    alike = [mark for mark, rows in parted.items() if rows and _is_even(rows)]
    plain = [mark for mark in alike if _explains(parted[mark], mark)] or alike
    if len(plain) > 1:
        names = " or ".join(NAMES[mark] for mark in plain)
        flags = " or ".join(f"--delimiter {TYPED.get(mark, mark)}" for mark in plain)
        raise ReadError(file, f"may be parted by {names}; say which: {flags}")
    if plain:
        return plain[0]
    wide = [mark for mark, rows in parted.items() if rows and len(rows[0]) > 1]
    return usual if usual in wide or not wide else wide[0]


def _sample(text: str) -> str:
    head = text[:SAMPLE_LETTERS]
    lines = head.splitlines(keepends=True)
    if len(head) < len(text) and len(lines) > 1:
        lines.pop()
    return "".join(lines[:SAMPLE_LINES])


def _parted(sample: str, delimiter: str) -> list[list[str]]:
    """Rows of a sample, those of nothing left out; none if it is no CSV of that delimiter."""
    reader = csv.reader(io.StringIO(sample, newline=""), delimiter=delimiter)
    try:
        rows = [[cell.strip() for cell in cells] for cells in reader]
    except csv.Error:
        return []
    return [row for row in rows if any(row)]


def _is_even(rows: Sequence[Sequence[str]]) -> bool:
    """Whether all rows have several cells, equally many but for empty ones at their ends."""
    first = len(_trimmed(rows[0]))
    return first > 1 and all(
        len(_trimmed(row)) <= first <= len(row) or first == len(_trimmed(row)) for row in rows
    )


def _trimmed(row: Sequence[str]) -> Sequence[str]:
    end = len(row)
    while end and not row[end - 1]:
        end -= 1
    return row[:end]


def _explains(rows: Sequence[Sequence[str]], delimiter: str) -> bool:
    """Whether other delimiters stand only in the first line and within numbers."""
    others = [mark for mark in NAMES if mark != delimiter]
    return all(
        is_number_like(cell)
        for row in rows[1:] or rows
        for cell in row
        if any(mark in cell for mark in others)
    )


def lines_of_cells(text: str, file: str, separator: str) -> Iterator[tuple[int, list[str]]]:
    r"""Number and cells of each line that is not empty; cells without spaces at their ends.

    Examples
    --------
    >>> list(lines_of_cells("a, b\n\n1,2\n", "t.csv", ","))
    [(1, ['a', 'b']), (3, ['1', '2'])]
    """
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    found, held = 0, 0
    try:
        for cells in reader:
            row = [cell.strip() for cell in cells]
            if any(row):
                found, held = found + 1, held + len(row)
                check_size(file, found - 1, held)
                yield reader.line_num, row
    except csv.Error as error:
        raise ReadError(file, f"line {reader.line_num}: is not CSV ({error})") from None


def check_size(file: str, rows: int, cells: int = 0) -> None:
    """Refuse more rows than ``MOST_ROWS``, and more cells than ``MOST_CELLS``."""
    if rows > MOST_ROWS:
        raise ReadError(file, f"has more than {MOST_ROWS:,} rows; give fewer")
    if cells > MOST_CELLS:
        raise ReadError(file, f"has more than {MOST_CELLS:,} cells; give fewer rows or columns")
