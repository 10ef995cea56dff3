"""Texts to words as programs of the other package expect them."""

from __future__ import annotations

import re
from importlib import resources

from packwork.readers.words.tokens import found_in

STOPWORDS: set[str] = set(
    resources.files("packwork.bundled")
    .joinpath("words", "english-short.txt")
    .read_text(encoding="utf-8")
    .split()
)
"""The 192 words that the other package leaves out: the usual short list of English (ranks.nl) and
some of web pages. Programs add to it; ``packwork words`` has longer ones, of many languages."""

_VARIANTS = frozenset(map(chr, range(0xFE00, 0xFE10)))
"""Marks that choose how the letter before them is drawn; alone they are no words."""

_PLAIN, _LONGER = r"\w[\w']*", r"\w[\w']+"


def tokens(
    text: str, regexp: str | None, *, include_numbers: bool, min_word_length: int
) -> list[str]:
    """Words of a text, possessive endings taken off.

    Examples
    --------
    >>> tokens("The bear's 3 bees", None, include_numbers=False, min_word_length=0)
    ['The', 'bear', 'bees']
    """
    if regexp is None:
        found = re.findall(_PLAIN if min_word_length <= 1 else _LONGER, text)
    else:
        (found,) = found_in(regexp, [text], groups=True)
    words = [word[:-2] if word.lower().endswith("'s") else word for word in found]
    words = [word for word in words if not (word and _VARIANTS.issuperset(word))]
    if not include_numbers:
        words = [word for word in words if not word.isdigit()]
    return [word for word in words if len(word) >= min_word_length]
