"""Tables of words with a column of steps: years, days, chapters."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from packwork.errors import ReadError, RecipeError
from packwork.phrasing import enumerated
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import pairs_of_rows
from packwork.readers.tables.written import is_number_like
from packwork.readers.words.options import Word
from packwork.readers.words.source import MAX_BYTES
from packwork.readers.words.table import TableRead, read_word_table, words_of

MOST_STEPS = 1_000
"""Steps of a series at most. Chosen."""

_DAY = re.compile(r"\d{4}(-\d\d){1,2}([T ][0-9:.]+)?")


@dataclass(frozen=True)
class WordSteps:
    """Weights of words, step by step.

    Parameters
    ----------
    weights
        By step, in their order, then by word.
    notices
        What has to be told of how the table was read.
    """

    column: str
    weights: Mapping[str, Mapping[str, float]]
    notices: tuple[str, ...] = ()


def named_column(said: str) -> tuple[str, str]:
    """File and column of ``talks.csv:year``.

    Raises
    ------
    RecipeError
        If it names no column.

    Examples
    --------
    >>> named_column("talks.csv:year")
    ('talks.csv', 'year')
    """
    file, _, column = said.rpartition(":")
    if not file or not column.strip() or "/" in column or "\\" in column:
        raise RecipeError(
            "series", f"names no column of steps: {said[:60]!r}; write it as talks.csv:year"
        )
    return file, column.strip()


def read_word_steps(file: str, column: str, asked: TableFormat | None = None) -> WordSteps:
    r"""Words of a table, by its column of steps.

    A word that a step has twice has both weights. Steps that are all numbers, or all days such as
    2026-11-23, come in their order, others in that of the table.

    Raises
    ------
    ReadError
        If it is no table of words.
    RecipeError
        If it has no such column, or that says fewer than two steps.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "t.csv")
    ...     _ = path.write_text("year,word,count\n2001,bear,2\n1999,fox,1\n")
    ...     read_word_steps(str(path), "year").weights
    {'1999': {'fox': 1.0}, '2001': {'bear': 2.0}}
    """
    return _steps(read_word_table(file, MAX_BYTES, asked or TableFormat()), file, column)


def steps_of_rows(rows: Sequence[Mapping[str, Any]], column: str) -> WordSteps:
    """Steps of rows that a program holds.

    Raises
    ------
    ReadError, RecipeError
        As there.

    Examples
    --------
    >>> rows = [{"word": "bear", "weight": 2, "year": 9}, {"word": "fox", "weight": 1, "year": 10}]
    >>> list(steps_of_rows(rows, "year").weights)
    ['9', '10']
    """
    return _steps(words_of(pairs_of_rows(rows), "data"), "data", column)


def _steps(table: TableRead, file: str, column: str) -> WordSteps:
    columns = dict.fromkeys(key for word in table.words for key in word.columns)
    if column not in columns:
        there = enumerated(list(columns), 20) if columns else "none but those of words and weights"
        raise RecipeError("series", f"{file} has no column {column[:40]!r}; there are {there}")
    found = _by_step(table.words, column)
    if not 2 <= len(found) <= MOST_STEPS:
        raise RecipeError(
            "series", f"column {column[:40]!r} says {len(found):,} steps; 2 to {MOST_STEPS:,} go"
        )
    weights = {label: found[label] for label in in_order(list(found))}
    return WordSteps(column, weights, (*table.notices, *table.lost))


def _by_step(words: Sequence[Word], column: str) -> dict[str, dict[str, float]]:
    found: dict[str, dict[str, float]] = {}
    for word in words:
        label = " ".join(word.columns.get(column, "").split())
        if not label:
            raise ReadError("series", f"the word {word.text[:40]!r} has no {column[:40]}")
        weights = found.setdefault(label, {})
        weights[word.text] = weights.get(word.text, 0.0) + word.weight
    return found


def in_order(labels: Sequence[str]) -> list[str]:
    """Labels of steps in the order of time, if they tell of it; else as they are.

    Examples
    --------
    >>> in_order(["10", "9"]), in_order(["2026-02", "2025-11"]), in_order(["spring", "autumn"])
    (['9', '10'], ['2025-11', '2026-02'], ['spring', 'autumn'])
    """
    if all(_DAY.fullmatch(label) for label in labels):
        return sorted(labels)
    try:
        numbers = {label: float(label) for label in labels if is_number_like(label)}
    except ValueError:
        return list(labels)
    return sorted(labels, key=numbers.__getitem__) if len(numbers) == len(labels) else list(labels)
