"""Tables of weights: which share of the area each item asks for."""

from __future__ import annotations

import csv
import io
import math
from pathlib import Path

from packwork.errors import ReadError
from packwork.readers.files import read_text

MAX_TABLE_BYTES = 5_000_000
"""Size of a table. Chosen."""


def read_weights(path: str | Path) -> dict[str, float]:
    r"""Weights by item name, in the file's order.

    The file has two columns, ``name,weight``, in UTF-8; that very line may stand on top.

    Raises
    ------
    ReadError
        With the line's number, if a weight is not a positive finite number, a name is
        missing or stands twice, or a line has other than two cells.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "weights.csv")
    ...     _ = file.write_text("name,weight\nbear,2\nfox,0.5\n")
    ...     read_weights(file)
    {'bear': 2.0, 'fox': 0.5}
    """
    reader = csv.reader(io.StringIO(read_text(path, MAX_TABLE_BYTES), newline=""), strict=True)
    weights: dict[str, float] = {}
    try:
        for cells in reader:
            row = [cell.strip() for cell in cells]
            if not any(row) or (not weights and _is_header(row)):
                continue
            name, weight = _entry(path, reader.line_num, row)
            if name in weights:
                raise ReadError(path, f"line {reader.line_num}: {name!r} stands there twice")
            weights[name] = weight
    except csv.Error as error:
        raise ReadError(path, f"line {reader.line_num}: is not CSV ({error})") from None
    if not weights:
        raise ReadError(path, "holds no weights; give lines such as bear,2")
    return weights


def _is_header(row: list[str]) -> bool:
    return len(row) == 2 and row[1].lower() == "weight"


def _entry(path: str | Path, line: int, row: list[str]) -> tuple[str, float]:
    if len(row) != 2 or not row[0]:
        raise ReadError(path, f"line {line}: needs a name and a weight, as in bear,2")
    try:
        weight = float(row[1])
    except ValueError:
        weight = math.nan
    if not (math.isfinite(weight) and weight > 0):
        raise ReadError(
            path, f"line {line}: a weight must be a positive number, not {row[1][:20]!r}"
        )
    return row[0], weight
