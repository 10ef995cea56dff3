"""Counts of words and of pairs that belong together, under the other package's names."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Container, Iterable, Mapping, Sequence
from importlib import resources
from itertools import pairwise

from packwork.readers.words.tokens import found_in

__all__ = ["process_tokens", "score", "unigrams_and_bigrams"]


def process_tokens(
    words: Iterable[str],
    normalize_plurals: bool = True,
) -> tuple[dict[str, int], dict[str, str]]:
    """Counts by the form that each word mostly has, and that form by each lower-case word.

    A word that ends in one "s" counts as its singular where that is among the words.

    Examples
    --------
    >>> process_tokens(["Bear", "bears", "bear", "bear"])
    ({'bear': 4}, {'bear': 'bear', 'bears': 'bear'})
    """
    cases: dict[str, Counter[str]] = {}
    for word in words:
        cases.setdefault(word.lower(), Counter())[word] += 1
    singular: dict[str, str] = {}
    for key in list(cases) if normalize_plurals else ():
        if key.endswith("s") and not key.endswith("ss") and key[:-1] in cases:
            singular[key] = key[:-1]
            for form, count in cases.pop(key).items():
                cases[key[:-1]][form[:-1]] += count
    counts, forms = _settled(cases)
    for plural, key in singular.items():
        while key in singular:  # of "basss", "bass" and "bas" each leads to the next
            key = singular[key]
        forms[plural] = forms[key]
    return counts, forms


def unigrams_and_bigrams(
    words: Sequence[str],
    stopwords: Container[str],
    normalize_plurals: bool = True,
    collocation_threshold: float = 30,
) -> dict[str, int]:
    """Counts of words and of pairs whose score is above a threshold.

    Words lose the places that they have in such pairs (Manning, Raghavan and Schütze,
    "Foundations of Statistical Natural Language Processing", 5.3.4). Stop words are in lower
    case; they are neither words nor parts of pairs.

    Examples
    --------
    >>> words = "white rabbit and white rabbit and bears and bees".split()
    >>> unigrams_and_bigrams(words, {"and"}, collocation_threshold=5)
    {'bears': 1, 'bees': 1, 'white rabbit': 2}
    """
    kept = [word for word in words if word.lower() not in stopwords]
    pairs = [
        f"{first} {second}"
        for first, second in pairwise(words)
        if first.lower() not in stopwords and second.lower() not in stopwords
    ]
    counts, forms = process_tokens(kept, normalize_plurals)
    single, total = dict(counts), len(kept)
    for pair, count in process_tokens(pairs, normalize_plurals)[0].items():
        first, second = (forms[word.lower()] for word in pair.split(" "))
        if score(count, single[first], single[second], total) > collocation_threshold:
            counts[first] -= count
            counts[second] -= count
            counts[pair] = count
    return {word: count for word, count in counts.items() if count > 0}


def score(count_bigram: int, count1: int, count2: int, n_words: int) -> float:
    """Dunning's likelihood ratio of a pair: how much more often it stands than by chance.

    0 where one of the two is all that there is.

    Examples
    --------
    >>> score(2, 2, 2, 6) > score(1, 2, 2, 6)
    True
    """
    if n_words <= count1 or n_words <= count2:
        return 0.0
    rest, others = count2 - count_bigram, n_words - count1
    chance = count2 / n_words
    apart = _log(count_bigram, count1, chance) + _log(rest, others, chance)
    together = _log(count_bigram, count1, count_bigram / count1)
    together += _log(rest, others, rest / others)
    return -2 * (apart - together)


def _settled(cases: Mapping[str, Counter[str]]) -> tuple[dict[str, int], dict[str, str]]:
    forms = {key: max(found, key=lambda form: found[form]) for key, found in cases.items()}
    return {forms[key]: found.total() for key, found in cases.items()}, forms


def _log(hits: int, trials: int, chance: float) -> float:
    likely, unlikely = max(chance, 1e-10), max(1 - chance, 1e-10)
    return math.log(likely) * hits + math.log(unlikely) * (trials - hits)


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
