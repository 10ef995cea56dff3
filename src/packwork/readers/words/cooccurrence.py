"""Vectors of words by which of them stand near each other in a text.

Positive pointwise mutual information of pairs within a window (K. W. Church and P. Hanks, "Word
association norms, mutual information, and lexicography", Computational Linguistics 16 (1990),
22-29; O. Levy, Y. Goldberg and I. Dagan, "Improving distributional similarity with lessons learned
from word embeddings", TACL 3 (2015), 211-225, doi:10.1162/tacl_a_00134), its symmetric matrix
factorised, so that products of two vectors are near the information of the pair. Modest: it knows
this text and no other.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.readers.words.word import Word

WINDOW = 10
"""Words that lie between the two of a pair at most, and one more. Larger tells topics, smaller
tells phrases. Chosen."""

DIMENSIONS = 64
"""Numbers of a vector at most. Fewer blur, more follow chance. Chosen."""

LEAST_PAIRS = 2
"""Times that a pair has to stand together to count. Once is chance. Chosen."""


MOST_RELATED = 4_000
"""Words that are related at most: more take gigabytes. Chosen."""


def cooccurrence_vectors(
    sentences: Sequence[Sequence[str]], words: Sequence[Word], most: int = 1
) -> FloatArray:
    """``(n, d)`` vectors of the words of a text, by which of them stand near each other."""
    if not sentences:
        raise RecipeError(
            "embeddings",
            "auto reads which words stand together in a text, and a table does not tell; give a "
            "text as the source, or a file of vectors",
        )
    if len(words) > MOST_RELATED:
        raise RecipeError(
            "embeddings", f"auto relates {MOST_RELATED:,} words at most, not {len(words):,}"
        )
    places = places_of(sentences, [word.text for word in words], most)
    shared = information(pairs_within(places, len(words)))
    if not shared.any():
        raise RecipeError(
            "embeddings",
            "auto finds no two of these words together more than once; give a longer text, or a "
            "file of vectors",
        )
    return vectors_of(shared)


def places_of(sentences: Iterable[Sequence[str]], words: Sequence[str], most: int = 1) -> IntArray:
    """Number of the word at each place of a text, -1 of others; a phrase lies at its first word.

    English plurals count as their singulars; ``most`` is the number of words of the longest
    phrase.

    Examples
    --------
    >>> words = ["ran", "White rabbit", "rabbit"]
    >>> places_of([["The", "white", "rabbits", "ran"]], words, 2).tolist()
    [-1, -1, 2, 0]
    >>> places_of([["The", "white", "rabbit", "ran"]], words, 2).tolist()
    [-1, 1, 2, 0]
    """
    known = {word.casefold(): k for k, word in enumerate(words)}
    found: list[int] = []
    for sentence in sentences:
        folded = [word.casefold() for word in sentence]
        for k, word in enumerate(folded):
            spans = (" ".join(folded[k : k + size]) for size in range(most, 1, -1))
            longest = next((known[span] for span in spans if span in known), None)
            found.append(_single(word, known) if longest is None else longest)
    return np.array(found, dtype=np.int64)


def _single(word: str, known: Mapping[str, int]) -> int:
    if word in known:
        return known[word]
    ends = (("ies", "y"), ("es", ""), ("s", "")) if len(word) > 3 and word.endswith("s") else ()
    forms = (word[: -len(end)] + new for end, new in ends if word.endswith(end))
    return next((known[form] for form in forms if form in known), -1)


def pairs_within(places: IntArray, count: int, window: int = WINDOW) -> FloatArray:
    """``(n, n)`` how often two words stand within a window; words that stand beside themselves 0.

    Examples
    --------
    >>> pairs_within(np.array([0, -1, 1, 1]), 2).tolist()
    [[0.0, 2.0], [2.0, 0.0]]
    """
    found = np.zeros(count * count)
    for apart in range(1, min(window, len(places) - 1) + 1):
        first, second = places[:-apart], places[apart:]
        both = (first >= 0) & (second >= 0) & (first != second)
        found += np.bincount(count * first[both] + second[both], minlength=count * count)
    square = found.reshape(count, count)
    return np.asarray(square + square.T)


def information(pairs: FloatArray) -> FloatArray:
    """``(n, n)`` positive pointwise mutual information of pairs, in bits.

    Examples
    --------
    >>> pairs = np.array([[0.0, 4, 0, 0], [4, 0, 0, 0], [0, 0, 0, 4], [0, 0, 4, 0]])
    >>> information(pairs)[0].tolist()
    [0.0, 2.0, 0.0, 0.0]
    """
    total = max(float(pairs.sum()), 1.0)
    each = pairs.sum(axis=1)
    expected = np.outer(each, each) / total
    counted = pairs >= LEAST_PAIRS
    ratio = np.where(counted, pairs / np.where(expected > 0, expected, 1.0), 1.0)
    return np.asarray(np.maximum(np.log2(ratio), 0.0))


def vectors_of(shared: FloatArray, dimensions: int = DIMENSIONS) -> FloatArray:
    """``(n, d)`` vectors whose products are near a symmetric matrix; 0 of what has no partner.

    Examples
    --------
    >>> shared = np.array([[0.0, 2, 0], [2, 0, 0], [0, 0, 0]])
    >>> found = vectors_of(shared)
    >>> round(float(found[0] @ found[1]), 6), found[2].tolist()
    (2.0, [0.0, 0.0, 0.0])
    """
    # A word is most like itself: as its nearest partner at least.
    whole = shared + np.diag(shared.max(axis=1, initial=0.0))
    values, axes = np.linalg.eigh(whole)
    kept = np.argsort(-values)[:dimensions]
    found = axes[:, kept] * np.sqrt(np.maximum(values[kept], 0.0))
    found[shared.max(axis=1, initial=0.0) == 0] = 0.0
    return np.asarray(found)
