"""A word and its weight, and what of its text is written."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Word:
    """One word or phrase and its weight.

    Parameters
    ----------
    text
        As it is to be written; ``|`` begins a new line.
    weight
        Positive.
    columns
        Other cells of its row.
    written
        Weight as its table has it, if that is a length of time; else empty.
    """

    text: str
    weight: float
    columns: Mapping[str, str] = field(default_factory=dict)
    written: str = ""


def lines_of(text: str) -> list[str]:
    """Lines of a word as it is written, none of them empty.

    Examples
    --------
    >>> lines_of("polar |bear")
    ['polar', 'bear']
    """
    lines = (" ".join(line.split()) for line in text.split("|"))
    return [line for line in lines if line]


def as_one_line(text: str) -> str:
    """A word's text as items are named after it.

    Examples
    --------
    >>> as_one_line(" polar |bear")
    'polar bear'
    """
    return " ".join(lines_of(sound(text)))


def sound(text: str) -> str:
    r"""Text without control characters, lone surrogates and idle spaces, composed.

    Examples
    --------
    >>> sound("  a\x00b\n\ud800 c ")
    'ab c'
    """
    spaced = "".join(" " if c.isspace() else c for c in text)
    kept = (c for c in spaced if unicodedata.category(c) not in {"Cc", "Cs", "Cn"})
    return " ".join(unicodedata.normalize("NFC", "".join(kept)).split())
