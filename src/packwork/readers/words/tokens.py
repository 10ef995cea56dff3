"""Tokenisation of texts in any script."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator

from packwork.readers.words.matching import found_in
from packwork.readers.words.unspaced import is_unspaced, segments
from packwork.readers.words.word import sound

JOINERS = "\u200c\u200d"
"""Unseen characters that belong to words of Persian and Indian scripts."""

_ADDRESS = re.compile(r"(?:https?://|www\.)\S+|\S+@\S+\.\w+")
_APOSTROPHES = dict.fromkeys(map(ord, "\u2018\u2019\u02bc\uff07"), "'")
_POSSESSIVE = re.compile(r"'[sS]$")


def sentences(text: str, *, include_numbers: bool = False) -> Iterator[list[str]]:
    """Words that follow each other with nothing but spaces between them, as they are written.

    A word is letters, marks and digits, with apostrophes inside; numbers alone and addresses
    of the web are none. Text of scripts without spaces is segmented.

    Examples
    --------
    >>> list(sentences("The bear's honey, don't! हिन्दी 42 https://x.org/a"))
    [['The', 'bear', 'honey'], ["don't"], ['हिन्दी']]
    """
    for run in _runs(_ADDRESS.sub("\n", unicodedata.normalize("NFC", text))):
        words = [word for token in run.split() for word in _words(token, include_numbers)]
        if words:
            yield words


def matches(text: str, pattern: str) -> Iterator[list[str]]:
    r"""What a regular expression finds, line by line; control characters and idle spaces off.

    Raises
    ------
    RecipeError
        If it does not come to an end.

    Examples
    --------
    >>> list(matches("a #bear and\n#honey", r"#\w+"))
    [['#bear'], ['#honey']]
    """
    lines = unicodedata.normalize("NFC", text).splitlines()
    for found in found_in(pattern, lines):
        words = [word for match in found if (word := sound(match))]
        if words:
            yield words


def _runs(text: str) -> list[str]:
    """Text between marks of punctuation."""
    plain = text.translate(_APOSTROPHES)
    table = {ord(character): _in_words(character) for character in set(plain)}
    return plain.translate(table).split("\n")


def _in_words(character: str) -> str:
    """What of a character is left in words: itself, nothing, a space or an end of the run."""
    if character in JOINERS or character == "'":
        return character
    category = unicodedata.category(character)
    if category[0] in "LMN":
        return character
    if category == "Cf":
        return ""
    return " " if character.isspace() and character not in "\f\v" else "\n"


def _words(token: str, include_numbers: bool) -> Iterator[str]:
    word = _POSSESSIVE.sub("", token.strip("'" + JOINERS))
    if any(is_unspaced(character) for character in word):
        yield from segments(word)
    elif word and (include_numbers or not _is_number(word)):
        yield word


def _is_number(word: str) -> bool:
    return all(unicodedata.category(character)[0] == "N" for character in word)
