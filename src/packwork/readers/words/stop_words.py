"""Stop words by language."""

from __future__ import annotations

import difflib
from collections import Counter
from collections.abc import Iterable
from functools import cache
from importlib import resources

from packwork.errors import RecipeError
from packwork.readers.files import read_text

MAX_BYTES = 2_000_000
"""Size of a file of stop words. Chosen."""

ENGLISH = "en"

LEAST_SHARE = 0.12
"""Share of a text's words that must be function words of a language for it to be that
one. Running text has 0.3 to 0.5; larger misses lists of headings, smaller finds languages
in lists of names. Chosen."""


def stop_words(language: str) -> frozenset[str]:
    """Function words of languages given by code, case folded: ``en``, or ``en,de``.

    English is a list of our own: that of ``stopwordsiso`` has nouns such as "computer" and
    "world". All others are that package's.

    Raises
    ------
    RecipeError
        If there is no list for a code.

    Examples
    --------
    >>> "the" in stop_words("en"), "und" in stop_words("en,de"), "world" in stop_words("en")
    (True, True, False)
    """
    codes = [code.strip().lower() for code in language.split(",")]
    known = languages()
    for code in codes:
        if code not in known:
            close = difflib.get_close_matches(code, known, n=1)
            hint = f"did you mean {close[0]}?" if close else f"there are {', '.join(known)}"
            raise RecipeError("language", f"there is no list for {code[:20]!r}; {hint}")
    return frozenset().union(*map(_list, codes))


@cache
def languages() -> tuple[str, ...]:
    """Codes of the languages that there are lists for.

    Examples
    --------
    >>> {"ar", "de", "en", "hi", "zh"} <= set(languages())
    True
    """
    import stopwordsiso

    return tuple(sorted({*stopwordsiso.langs(), ENGLISH}))


def guess_language(counts: Counter[str]) -> str | None:
    """Language of a text, by the share of its words that are function words of one.

    Parameters
    ----------
    counts
        How often each case-folded word stands there.

    Examples
    --------
    >>> guess_language(Counter("der bär und die biene in dem wald".split()))
    'de'
    >>> guess_language(Counter(["bear", "honey"])) is None
    True
    """
    total = counts.total()
    if not total:
        return None
    shares = {code: _share(counts, _list(code)) / total for code in languages()}
    best = max(shares, key=lambda code: (shares[code], -len(_list(code))))
    return best if shares[best] >= LEAST_SHARE else None


def own_stop_words(words: str | Iterable[str] | None) -> frozenset[str]:
    """Stop words of a file, one or several a line, or of a list; case folded.

    Raises
    ------
    ReadError
        If the file cannot be read.

    Examples
    --------
    >>> sorted(own_stop_words(["Bear", "fox"]))
    ['bear', 'fox']
    """
    if words is None:
        return frozenset()
    if isinstance(words, str):
        words = read_text(words, MAX_BYTES).replace(",", " ").split()
    return frozenset(word.casefold() for word in words)


@cache
def _list(code: str) -> frozenset[str]:
    if code == ENGLISH:
        place = resources.files("packwork.bundled").joinpath("words", "english.txt")
        return frozenset(place.read_text(encoding="utf-8").split())
    import stopwordsiso

    return frozenset(word.casefold() for word in stopwordsiso.stopwords(code))


def _share(counts: Counter[str], words: frozenset[str]) -> int:
    return sum(counts[word] for word in words)
