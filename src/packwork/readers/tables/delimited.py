"""Lines of cells: CSV and TSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator

from packwork.errors import ReadError

ENDINGS = {".csv": ",", ".tsv": "\t", ".tab": "\t"}
"""What parts the cells of a line, by the file's ending."""

MOST_ROWS = 1_000_000
"""Rows of one table. Chosen."""


def lines_of_cells(text: str, file: str, separator: str) -> Iterator[tuple[int, list[str]]]:
    r"""Number and cells of each line that is not empty; cells without spaces at their ends.

    Raises
    ------
    ReadError
        With the line's number, if it is not CSV, or there are more than ``MOST_ROWS``.

    Examples
    --------
    >>> list(lines_of_cells("a, b\n\n1,2\n", "t.csv", ","))
    [(1, ['a', 'b']), (3, ['1', '2'])]
    """
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    found = 0
    try:
        for cells in reader:
            row = [cell.strip() for cell in cells]
            if any(row):
                found += 1
                check_rows(found - 1, file)
                yield reader.line_num, row
    except csv.Error as error:
        raise ReadError(file, f"line {reader.line_num}: is not CSV ({error})") from None


def check_rows(count: int, file: str) -> None:
    """Refuse more rows than ``MOST_ROWS``.

    Raises
    ------
    ReadError
        Saying how many there may be.
    """
    if count > MOST_ROWS:
        raise ReadError(file, f"has more than {MOST_ROWS:,} rows; give fewer")
