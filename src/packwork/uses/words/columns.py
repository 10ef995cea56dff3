"""Columns of the words' table beside the words and their weights, to put them in an order by."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.phrasing import enumerated
from packwork.pipeline.job import Job
from packwork.readers.tables.written import written_numbers
from packwork.readers.words.items import WordsRead

FEW = 6
"""Columns that a message names. Chosen."""


def column_values(read: WordsRead, job: Job, column: str) -> FloatArray | None:
    """``(n,)`` what a column says of the job's items; None if there is no such column.

    Numbers are what they say; other cells, dates too, are in the order of the alphabet.

    Raises
    ------
    ReadError
        If it is not plain how its numbers are written.
    RecipeError
        If an item has nothing there.
    """
    pairs = zip(read.items, read.words, strict=True)
    cells = {item: word.columns.get(column, "").strip() for item, word in pairs}
    if not any(cells.values()):
        return None
    empty = [item.name for item in job.items if not cells.get(item)]
    if empty:
        have = "has" if len(empty) == 1 else "have"
        raise RecipeError("arrange", f"{enumerated(empty)} {have} nothing in {column[:40]!r}")
    texts = [cells[item] for item in job.items]
    numbers = np.array(written_numbers(texts, "words", column, usual=".", asked=job.recipe.decimal))
    if np.isfinite(numbers).all():
        return numbers
    order = np.unique([text.casefold() for text in texts], return_inverse=True)[1]
    return np.asarray(order, dtype=np.float64)


def columns_there(read: WordsRead) -> str:
    """Columns that there are, for messages; empty if there are none."""
    return ", ".join(list(dict.fromkeys(key for word in read.words for key in word.columns))[:FEW])
