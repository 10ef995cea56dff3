"""Counts and lists of names in messages: one row, two rows, a, b, c and 4 more."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence

MOST_NAMED = 3
"""Names in a line that stands for more, unless said otherwise. Chosen."""


MOST_COLUMNS = 20
"""Columns that a message names. Chosen."""


def number_of(count: int, one: str, several: str | None = None) -> str:
    """A number with its noun in the singular or the plural, and with what follows the noun.

    Parameters
    ----------
    one
        What is said of one, without the number.
    several
        What is said of any other number; None for ``one`` and an s.

    Examples
    --------
    >>> number_of(1, "row"), number_of(2, "row"), number_of(1200, "item is", "items are")
    ('1 row', '2 rows', '1,200 items are')
    """
    return f"{count:,} {one if count == 1 else several or f'{one}s'}"


def enumerated(names: Sequence[str], most: int = MOST_NAMED) -> str:
    """Names with commas between them, and how many there are beyond the first few.

    Examples
    --------
    >>> enumerated(["a", "b"]), enumerated(list("abcdef"))
    ('a, b', 'a, b, c and 3 more')
    """
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def meant(typed: str, known: Iterable[str]) -> str:
    """A question after the known name that is nearest to what was typed; empty if none is near.

    Examples
    --------
    >>> meant("umsatz", ["Ort", "Umsatz"]), meant("x", ["Ort"])
    ('did you mean Umsatz?', '')
    """
    by_case = {name.casefold(): name for name in known}
    close = difflib.get_close_matches(typed.casefold(), by_case, n=1)
    return f"did you mean {by_case[close[0]]}?" if close else ""


def no_column(asked: str, there: Sequence[str]) -> str:
    """End of "there is no column": the one asked for, those that may be meant, those there are.

    Examples
    --------
    >>> no_column("umsatz", ["Ort", "Umsatz"]), no_column("x", [])
    ("'umsatz'; did you mean Umsatz? there are Ort, Umsatz", "'x'; there are none")
    """
    near = meant(asked, there)
    listed = enumerated(there, MOST_COLUMNS) or "none"
    return f"{asked[:40]!r}; {near}{' ' if near else ''}there are {listed}"


_FLAG = re.compile(r"(?<![\w-])--?([a-z][a-z-]*)")

_OTHERWISE = {"loss": "losses", "n": "count"}
"""Options whose flag is no name of theirs."""


def in_python(text: str) -> str:
    """A message in which options have Python's names instead of flags.

    Examples
    --------
    >>> in_python("use --size-ratio 3, or -n 9; well-made")
    'use size_ratio 3, or count 9; well-made'
    """
    return _FLAG.sub(lambda m: _OTHERWISE.get(m[1], m[1].replace("-", "_")), text)


def one_of(*choices: str) -> str:
    """Choices with commas between them, and ``or`` before the last.

    Examples
    --------
    >>> one_of("a"), one_of("a", "b", "c")
    ('a', 'a, b or c')
    """
    *others, last = choices
    return f"{', '.join(others)} or {last}" if others else last
