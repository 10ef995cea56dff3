"""Tables of words and weights: CSV, TSV and JSON."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from packwork.errors import ReadError
from packwork.phrasing import enumerated, number_of
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import MOST_NAMED, Pair, Pairs, read_pairs
from packwork.readers.tables.table import total_row
from packwork.readers.words.options import Word


@dataclass(frozen=True, eq=False)
class TableRead:
    """Words of a table.

    Parameters
    ----------
    words
        One per row that has a word and a weight.
    notices
        What has to be told of how it was read.
    lost
        What has to be told of rows with data that are left out.
    """

    words: tuple[Word, ...]
    notices: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()


def read_word_table(file: str, most_bytes: int, asked: TableFormat) -> TableRead:
    r"""Words of lines ``word,weight``, or of JSON as ``{"bear": 2}``.

    Further columns go under the names of the first line. Rows without a word, or without a
    positive number, are left out and named.

    Raises
    ------
    ReadError
        If it is no table, or no row has both.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "t.csv")
    ...     _ = path.write_text("word,weight,kind\nbear,2,animal\nfox,,\n")
    ...     read = read_word_table(str(path), 1_000, TableFormat())
    >>> read.words
    (Word(text='bear', weight=2.0, columns={'kind': 'animal'}),)
    >>> read.notices
    ('left out 1 row of 2 without a weight: fox (line 3)',)
    """
    return words_of(read_pairs(file, most_bytes, asked), file)


def words_of(table: Pairs, file: str) -> TableRead:
    """Words of a table that is read already.

    Raises
    ------
    ReadError
        If no row has a word and a weight.
    """
    sound = [pair for pair in table.rows if pair.is_sound]
    odd = [pair for pair in table.rows if not pair.is_sound]
    if odd and not sound:
        raise ReadError(file, f"{odd[0].where}: {odd[0].wanted('word')}")
    said: dict[str, list[Pair]] = {}
    for pair in odd:
        said.setdefault(_why(pair), []).append(pair)
    count = len(table.rows)
    notices = {why: _left_out(why, which, count) for why, which in said.items()}
    told = [text for why, text in notices.items() if why in _EMPTY]
    total = total_row([pair.name for pair in sound], [pair.number for pair in sound])
    if total is not None:
        told.append(
            f"{sound[total].name[:40]!r} ({sound[total].where}) looks like the sum of the others; "
            "it is a word as they are: take it out of the table if it is none"
        )
    return TableRead(
        tuple(Word(pair.name, pair.number, dict(pair.others)) for pair in sound),
        (*table.notices, *told),
        tuple(text for why, text in notices.items() if why not in _EMPTY),
    )


_EMPTY = frozenset({"without a weight", "whose weight is 0"})
"""Why rows are left out that say nothing."""


def _why(pair: Pair) -> str:
    if not pair.name:
        return "without a word"
    if pair.written is None:
        return "without a weight"
    if pair.number == 0:
        return "whose weight is 0"
    return "whose weight is negative" if pair.number < 0 else "whose weight is no number"


def _left_out(why: str, which: Sequence[Pair], count: int) -> str:
    """Sentence about rows that are not set."""
    named = [f"{pair.name[:40]} ({pair.where})" if pair.name else pair.where for pair in which]
    rows = number_of(len(which), "row")
    return f"left out {rows} of {count} {why}: {enumerated(named, MOST_NAMED)}"
