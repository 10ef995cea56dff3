"""Lines of cells: CSV and TSV, as programs and spreadsheets write them."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from packwork.errors import ReadError
from packwork.phrasing import enumerated, number_of
from packwork.readers.reading import read_bytes
from packwork.readers.tables import workbook
from packwork.readers.tables.cells import is_amount, is_number_like
from packwork.readers.tables.decoding import decoded
from packwork.readers.tables.format import TableFormat

ENDINGS = {".csv": ",", ".tsv": "\t", ".tab": "\t", **dict.fromkeys(workbook.ENDINGS, "\t")}
"""What parts the cells of a line, by the file's ending, where the lines do not show it."""

UNICODE_TEXT = ".txt"
"""Ending of a table with tabs in UTF-16, as Excel writes one with letters of all scripts."""

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

MOST_TITLES = 5
"""Lines above a table at most that are taken for titles. More are a list. Chosen."""

_YEAR = re.compile(r"(?:1[5-9]|20)\d\d")
_DECLARED = re.compile(r'"?sep=(.)"?[ \t]*\r?(?:\n|$)', re.IGNORECASE)


@dataclass(frozen=True)
class Head:
    """Lines above the rows of a table, up to the ``last``, and what they say.

    ``titles`` are not of the table; ``names`` of columns are joined of two rows, else empty.
    """

    last: int = 0
    titles: tuple[str, ...] = ()
    names: tuple[str, ...] = ()

    @property
    def notice(self) -> str:
        """Sentence about both; empty if all is plain."""
        named = [repr(title[:40]) for title in self.titles]
        what = number_of(len(named), "line above the table is", "lines above the table are")
        said = [f"{what} left out: {enumerated(named)}"] if named else []
        if self.names:
            said.append(f"two rows of headings name the columns {enumerated(self.names, 6)}")
        return "; ".join(said)


NO_HEAD = Head()


@dataclass(frozen=True, eq=False)
class TextTable:
    """A file of lines of cells, its letters and delimiter known, and how it was read."""

    file: str
    text: str
    delimiter: str
    skipped: int = 0
    notice: str = ""
    head: Head = field(default_factory=lambda: NO_HEAD)

    def lines(self) -> Iterator[tuple[int, list[str]]]:
        """Number and cells of each line that is not empty, as :func:`lines_of_cells`.

        Those of titles above the table are left out, headings in two rows are one.
        """
        if self.head.names:
            yield self.head.last + self.skipped, list(self.head.names)
        for number, cells in lines_of_cells(self.text, self.file, self.delimiter):
            if number > self.head.last:
                yield number + self.skipped, cells


def sheet_of_file(file: str, most: int, asked: TableFormat) -> TextTable:
    """Lines of cells of a file of at most ``most`` bytes: text, or one sheet of a workbook.

    Raises
    ------
    ReadError
        If it cannot be read, or is no table.
    """
    path, name = workbook.parted(file)
    ending, data = workbook.ending_of(file), read_bytes(path, most)
    if ending not in workbook.ENDINGS:
        return read_sheet(data, file, ending, asked)
    text, told = workbook.text_of_sheet(data, path, name, check_size)
    head = _head(_parted(_sample(text), "\t"))
    notice = "; ".join(filter(None, (told, head.notice)))
    return TextTable(file, text, "\t", notice=notice, head=head)


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
    delimiter = said or delimiter_of(text, file, {**ENDINGS, UNICODE_TEXT: "\t"}.get(ending, ","))
    head = _head(_parted(_sample(text), delimiter))
    notice = "; ".join(filter(None, (read.notice, head.notice)))
    return TextTable(file, text, delimiter, skipped, notice, head)


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
    parted = {mark: _rows_below(_parted(sample, mark)) for mark in NAMES}
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


def is_parted_by(marks: Iterable[str], text: str) -> bool:
    r"""Whether one of some marks parts all lines into equally many cells, with a column of numbers.

    Examples
    --------
    >>> texts = "land\tkg\nPeru\t2\n", "\tA bear,\n\tand 2 bees\n"
    >>> [is_parted_by("\t;", text) for text in texts]
    [True, False]
    """
    sample = _sample(text)
    return any(_has_numbers(_rows_below(_parted(sample, mark))) for mark in marks)


def _has_numbers(rows: Sequence[Sequence[str]]) -> bool:
    """Whether rows are of equally many cells, and a column holds numbers below its first cell."""
    if len(rows) < 2 or not _is_even(rows):
        return False
    columns = ([cell for cell in column if cell] for column in zip(*rows[1:], strict=False))
    return any(column and all(map(is_amount, column)) for column in columns)


def _sample(text: str) -> str:
    head = text[:SAMPLE_LETTERS]
    lines = head.splitlines(keepends=True)
    if len(head) < len(text) and len(lines) > 1:
        lines.pop()
    return "".join(lines[:SAMPLE_LINES])


def _parted(sample: str, delimiter: str) -> list[tuple[int, list[str]]]:
    """Numbers and cells of a sample's lines; none if it is no CSV of that delimiter."""
    reader = csv.reader(io.StringIO(sample, newline=""), delimiter=delimiter)
    try:
        return [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader]
    except csv.Error:
        return []


def _rows_below(lines: Sequence[tuple[int, list[str]]]) -> list[list[str]]:
    """Rows of a table that are not empty, without titles above it."""
    last = _titles_end(lines)
    return [row for number, row in lines if number > last and any(row)]


def _head(lines: Sequence[tuple[int, list[str]]]) -> Head:
    """Titles and joined headings above the rows of a table."""
    last = _titles_end(lines)
    titles = tuple(
        " ".join(filter(None, row)) for number, row in lines if number <= last and any(row)
    )
    rows = [(number, row) for number, row in lines if number > last and any(row)][:3]
    names = _joined([row for _, row in rows])
    return Head(rows[1][0] if names else last, titles, names)


def _titles_end(lines: Sequence[tuple[int, list[str]]]) -> int:
    """Number of the last line of titles above a table; 0 if there are none.

    Titles are up to ``MOST_TITLES`` lines without a number, above names of columns, of which there
    are more than any title has cells, and then numbers. They have one cell each, or an empty line
    parts them from the table. All else is of the table, and refused or named there.
    """
    filled = [[cell for cell in row if cell] for _, row in lines]
    there = [k for k, row in enumerate(filled) if row]
    for at, k in enumerate(there[1 : MOST_TITLES + 1], start=1):
        above = [filled[title] for title in there[:at]]
        widest = max(map(len, above))
        if any(map(is_number_like, (cell for row in above for cell in row))):
            return 0
        is_parted = widest == 1 or k - there[at - 1] > 1
        # Names in two rows have no empty line between them.
        rows = 2 if k + 1 in there else 1
        below = (cell for other in there[at + 1 :][:rows] for cell in filled[other])
        is_wider = len(filled[k]) > widest and _are_names(filled[k])
        if is_parted and is_wider and any(map(is_amount, below)):
            return lines[k][0] - 1
    return 0


def _are_names(cells: Sequence[str]) -> bool:
    """Whether cells may name columns: no numbers, or several years or times, but not the first.

    Examples
    --------
    >>> [_are_names(row.split()) for row in ("Land kg", "Land 2023 2024", "Bear 2000", "Fox 2 3")]
    [True, True, False, False]
    """
    numbers = [cell for cell in cells if is_amount(cell)]
    are_years = all(_YEAR.fullmatch(cell) or ":" in cell for cell in numbers)
    return not numbers or (are_years and len(set(numbers)) > 1 and cells[0] not in numbers)


def _joined(rows: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """Names of columns of which the first row has some that reach over several of the second.

    Examples
    --------
    >>> _joined([["Land", "2023", "", "2024"], ["", "kg", "EUR", "kg"], ["Peru", "1", "2", "3"]])
    ('Land', '2023 kg', '2023 EUR', '2024 kg')
    """
    if len(rows) < 3 or any(map(is_number_like, filter(None, rows[1]))):
        return ()
    width = max(len(_trimmed(row)) for row in rows[:2])
    upper, lower = ([*row, *[""] * width][:width] for row in rows[:2])
    gaps = [k for k in range(1, width) if not upper[k]]
    names, over = [], ""
    for k in range(width):
        over = upper[k] or over
        names.append(f"{over} {lower[k]}".strip())
    is_over = bool(gaps) and not lower[0] and all(lower[1:])
    has_numbers = any(map(is_amount, rows[2][1:]))
    return tuple(names) if is_over and has_numbers and len(set(names)) == width else ()


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
        is_amount(cell)
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
