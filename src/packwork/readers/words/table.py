"""Tables of words and weights: CSV, TSV and JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from packwork.errors import ReadError
from packwork.readers.tables.delimited import check_rows, lines_of_cells
from packwork.readers.words.word import Word

WORD_COLUMNS = ("word", "text", "name", "term", "label", "key")
WEIGHT_COLUMNS = ("weight", "count", "frequency", "freq", "value", "size", "n")
"""Names under which tables of others keep the two; else the first and second column."""


def rows_of_csv(text: str, file: str, separator: str) -> list[Word]:
    r"""Words of lines ``word,weight``, further columns under the names of the first line.

    Raises
    ------
    ReadError
        With the line's number, if a word or a weight is missing or no positive number.

    Examples
    --------
    >>> rows_of_csv("word,weight,kind\nbear,2,animal\n", "t.csv", ",")
    [Word(text='bear', weight=2.0, columns={'kind': 'animal'})]
    >>> rows_of_csv("bear\t2\n", "t.tsv", "\t")[0].weight
    2.0
    """
    words: list[Word] = []
    names: Sequence[str] | None = None
    for line, row in lines_of_cells(text, file, separator):
        if names is None:
            names = row if _is_header(row) else ["word", "weight"]
            if names is row:
                continue
        words.append(_word(dict(zip(names, row, strict=False)), file, f"line {line}"))
    return words


def rows_of_json(text: str, file: str) -> list[Word]:
    """Words of ``{"bear": 2}``, ``[["bear", 2]]`` or ``[{"word": "bear", "weight": 2}]``.

    Raises
    ------
    ReadError
        If it is none of these.

    Examples
    --------
    >>> rows_of_json('{"bear": 2}', "t.json") == rows_of_json('[["bear", 2]]', "t.json")
    True
    """
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ReadError(file, f"is not JSON ({error})") from None
    words: list[Word] = []
    for number, entry in enumerate(_entries(data, file), start=1):
        words.append(_word(entry, file, f"entry {number}"))
        check_rows(len(words), file)
    return words


def _entries(data: Any, file: str) -> Iterable[Mapping[str, Any]]:
    if isinstance(data, dict):
        return _pairs(data.items())
    if isinstance(data, list) and all(isinstance(entry, dict) for entry in data):
        return data
    if isinstance(data, list) and all(isinstance(e, list) and len(e) == 2 for e in data):
        return _pairs(data)
    raise ReadError(file, 'holds no words; give {"bear": 2, "fox": 1} or [["bear", 2]]')


def _pairs(pairs: Iterable[Sequence[Any]]) -> Iterator[Mapping[str, Any]]:
    return ({"word": word, "weight": weight} for word, weight in pairs)


def _is_header(row: Sequence[str]) -> bool:
    return len(row) > 1 and not any(map(_is_number, row))


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _word(row: Mapping[str, Any], file: str, where: str) -> Word:
    keys = list(row)
    by_name = {key.strip().lower(): key for key in keys}
    first = next((by_name[n] for n in WORD_COLUMNS if n in by_name), keys[0] if keys else "")
    rest = [key for key in keys if key != first]
    second = next((by_name[n] for n in WEIGHT_COLUMNS if n in by_name), rest[0] if rest else "")
    text, weight = row.get(first), row.get(second)
    if not isinstance(text, str) or not text.strip() or weight is None:
        raise ReadError(file, f"{where}: needs a word and a weight, as in bear,2")
    try:
        value = float(weight)
    except (TypeError, ValueError):
        value = math.nan
    if not (math.isfinite(value) and value > 0) or isinstance(weight, bool):
        met = repr(str(weight)[:20])
        raise ReadError(file, f"{where}: a weight must be a positive number, not {met}")
    others = {key: str(row[key]) for key in rest if key != second}
    return Word(text.strip(), value, others)
