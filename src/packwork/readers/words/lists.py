"""Lists of names, one a line, told from running text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from packwork.readers.words.tokens import guess_language, sentences

MOST_LINES = 300
"""Lines of a list at most. More are data, or verses. Chosen."""

MOST_WORDS = 3
"""Words of a line at most. Chosen."""


def listed_names(text: str) -> list[str]:
    r"""Lines of a list of names; none of any other text.

    Lines are of one to three words without marks between, some of several, and all of them
    have no language: verses have one.

    Examples
    --------
    >>> listed_names("Ben\nOma Ilse\n\nZoë"), listed_names("Let it be\nlet it be\nto be me")
    (['Ben', 'Oma Ilse', 'Zoë'], [])
    """
    lines = [" ".join(line.split()) for line in text.splitlines() if line.strip()]
    if not 3 <= len(lines) <= MOST_LINES or all(" " not in line for line in lines):
        return []
    words = [_words_of(line) for line in lines]
    forms = Counter(word for own in words for word in own)
    return lines if all(words) and guess_language(forms) is None else []


def told_of(lines: Sequence[str]) -> str:
    """Notice about a list of names, by one of them that has several words."""
    name = next(line for line in lines if " " in line)
    return f"is a list: {name[:40]!r} is one word, as every line is; --regexp '\\w+' parts them"


def _words_of(line: str) -> list[str]:
    """Words of a line that has few of them and nothing else; none of another."""
    words = [word for run in sentences(line) for word in run]
    is_plain = " ".join(words) == line.replace("’", "'")
    return words if is_plain and len(words) <= MOST_WORDS else []
