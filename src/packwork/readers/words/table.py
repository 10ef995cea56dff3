"""Tables of words and weights, also with a column of steps: years, days, chapters."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from packwork.errors import ReadError, RecipeError
from packwork.phrasing import enumerated, number_of
from packwork.readers.tables.cells import is_blank, is_number_like
from packwork.readers.tables.durations import durations
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import (
    MOST_NAMED,
    USUAL,
    Pair,
    PairColumns,
    Pairs,
    pairs_of_rows,
    read_pairs,
)
from packwork.readers.tables.totals import is_sum_last, total_rows
from packwork.readers.words.word import Word

MAX_BYTES = 50_000_000
"""Size of a text or a table: some fifty long novels. Chosen."""


@dataclass(frozen=True, eq=False)
class TableRead:
    """Words of a table, one for each row with a weight; notices, and those of rows with data."""

    words: tuple[Word, ...]
    notices: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()


def read_word_table(file: str, asked: TableFormat, columns: PairColumns = USUAL) -> TableRead:
    """Words of lines ``word,weight``, or of JSON as ``{"bear": 2}``.

    Further columns go under the names of the first line. Rows without a word, or without a
    positive number, are left out and named.
    """
    table = read_pairs(file, asked, MAX_BYTES, columns)
    return words_of(table, file, keeps_totals=asked.keep_totals)


def words_of(table: Pairs, file: str, *, keeps_totals: bool = False) -> TableRead:
    """Words of a table that is read already."""
    sound = [pair for pair in table.rows if pair.is_sound]
    odd = [pair for pair in table.rows if not pair.is_sound]
    if odd and not sound:
        taken = f"; {table.taken}" if table.taken else ""
        instead = f", as {table.instead}" if table.instead else ""
        why = f"{odd[0].where}: {odd[0].wanted('word')}{taken}{instead}"
        raise ReadError(file, "; ".join((why, *table.notices)))
    said: dict[str, list[Pair]] = {}
    for pair in odd:
        said.setdefault(_why(pair), []).append(pair)
    count = len(table.rows)
    notices = {why: _left_out(why, which, count) for why, which in said.items()}
    told = [table.taken] if table.taken else []
    told += [text for why, text in notices.items() if why in _EMPTY]
    numbered = [pair for pair in table.rows if math.isfinite(pair.number)]
    numbers = [pair.number for pair in numbered]
    found = {} if keeps_totals else total_rows([[pair.name] for pair in numbered], numbers)
    which = [numbered[k] for k in found if numbered[k].is_sound]
    if which:
        sound = [pair for k, pair in enumerate(numbered) if k not in found and pair.is_sound]
        told.append(
            f"{_left_out('that is the total of others', which, count)}; --keep-totals makes words "
            "of totals too"
        )
    elif sound and numbered[-1] is sound[-1] and is_sum_last(numbers):
        told.append(
            f"{sound[-1].name[:40]!r} ({sound[-1].where}) is the sum of the others by its weight; "
            "it is a word as they are: take it out of the table if it is none"
        )
    if sound and all(is_number_like(pair.name) for pair in sound):
        told.append("has numbers for words; --label-by names the column that has them")
    return TableRead(
        tuple(Word(pair.name, pair.number, dict(pair.others), _time(pair)) for pair in sound),
        (*table.notices, *told),
        tuple(text for why, text in notices.items() if why not in _EMPTY),
    )


def _time(pair: Pair) -> str:
    """Weight of a pair as a length of time; empty if it is none."""
    return str(pair.written).strip() if durations([pair.written]) else ""


_EMPTY = frozenset({"without a weight", "whose weight is 0"})
"""Why rows are left out that say nothing."""


def _why(pair: Pair) -> str:
    if not pair.name:
        return "without a word"
    if is_blank(pair.written):
        return "without a weight"
    if pair.number == 0:
        return "whose weight is 0"
    return "whose weight is negative" if pair.number < 0 else "whose weight is no number"


def _left_out(why: str, which: Sequence[Pair], count: int) -> str:
    named = [f"{pair.name[:40]} ({pair.where})" if pair.name else pair.where for pair in which]
    rows = number_of(len(which), "row")
    return f"left out {rows} of {count} {why}: {enumerated(named, MOST_NAMED)}"


MOST_STEPS = 1_000
"""Steps of a series at most. Chosen."""

_DAY = re.compile(r"\d{4}(-\d\d){1,2}([T ][0-9:.]+)?")


@dataclass(frozen=True)
class WordSteps:
    """Weights of words by step, in the order of steps, then by word."""

    weights: Mapping[str, Mapping[str, float]]
    notices: tuple[str, ...] = ()


def named_column(said: str) -> tuple[str, str]:
    """File and column of ``talks.csv:year``.

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
    """Words of a table, by its column of steps.

    A word that a step has twice has both weights. Steps that are all numbers, or all days such as
    2026-11-23, come in their order, others in that of the table.
    """
    return _steps(read_word_table(file, asked or TableFormat()), file, column)


def steps_of_rows(rows: Sequence[Mapping[str, Any]], column: str) -> WordSteps:
    """Steps of rows that a program holds.

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
        raise RecipeError(
            "series",
            f"{file} has no column {column[:40]!r} of steps; there are {there}; give a row for "
            "each word and step",
        )
    found = _by_step(table.words, column)
    if not 2 <= len(found) <= MOST_STEPS:
        raise RecipeError(
            "series", f"column {column[:40]!r} says {len(found):,} steps; 2 to {MOST_STEPS:,} go"
        )
    weights = {label: found[label] for label in in_order(list(found))}
    return WordSteps(weights, (*table.notices, *table.lost))


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
