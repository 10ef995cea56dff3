"""JSON files of tables, bounded in size."""

from __future__ import annotations

import json
from typing import Any

from packwork.errors import ReadError
from packwork.readers.files import read_bytes
from packwork.readers.tables.decoding import decoded
from packwork.readers.tables.format import TableFormat

MAX_JSON_BYTES = 30_000_000
"""Size of a JSON file: its values take up to 25 times as much in memory, three quarters of a
gigabyte. Derived."""


def read_json(file: str, asked: TableFormat) -> Any:
    """What a JSON file holds.

    Raises
    ------
    ReadError
        If it is none, or larger than ``MAX_JSON_BYTES``.

    Examples
    --------
    >>> read_json("no such file.json", TableFormat())
    Traceback (most recent call last):
    packwork.errors.ReadError: no such file.json: there is no such file
    """
    text = decoded(read_bytes(file, MAX_JSON_BYTES), file, asked.encoding).text
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ReadError(file, f"is not JSON ({str(error)[:120]})") from None
