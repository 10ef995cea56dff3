"""Word counts of a text: forms, plurals, phrases."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from packwork.readers.words.unspaced import is_unspaced

LEAST_TOGETHER = 3
"""How often words must stand together to be a phrase. Chosen."""

PHRASE_SHARE = 0.5
"""Share of the rarer word's places at which it stands in the phrase. Larger finds names
only, smaller any habit of speech. Tried on two novels."""

Sentences = Sequence[Sequence[str]]


def count_forms(sentences: Sentences) -> Counter[str]:
    """How often each written form stands in the sentences.

    Examples
    --------
    >>> dict(count_forms([["Bear", "bear"], ["bear"]]))
    {'Bear': 1, 'bear': 2}
    """
    return Counter(word for sentence in sentences for word in sentence)


def folded(forms: Counter[str]) -> tuple[Counter[str], dict[str, str]]:
    """Counts by case-folded word, and how each is mostly written.

    Examples
    --------
    >>> counts, written = folded(Counter({"Bear": 1, "bear": 2, "NASA": 5}))
    >>> dict(counts), written["nasa"], written["bear"]
    ({'bear': 3, 'nasa': 5}, 'NASA', 'bear')
    """
    counts: Counter[str] = Counter()
    best: dict[str, tuple[int, str]] = {}
    for form, count in forms.items():
        key = form.casefold()
        counts[key] += count
        # Of two that are as frequent the one without capitals.
        best[key] = max(best.get(key, (0, "")), (count, form))
    return counts, {key: form for key, (_, form) in best.items()}


def without_plurals(counts: Counter[str]) -> Counter[str]:
    """Counts in which English plurals are added to their singular, if that is there.

    Examples
    --------
    >>> dict(without_plurals(Counter(bear=2, bears=3, glass=1, berry=1, berries=1)))
    {'bear': 5, 'glass': 1, 'berry': 2}
    """
    merged = Counter(counts)
    for word in counts:
        single = _singular(word, merged)
        if single is not None:
            merged[single] += merged.pop(word)
    return merged


def phrases(sentences: Sentences, most: int, stops: frozenset[str]) -> Counter[str]:
    """How often up to ``most`` words that belong together stand together, as written.

    A phrase neither begins nor ends with a stop word, stands there ``LEAST_TOGETHER``
    times, and at ``PHRASE_SHARE`` of the places of its rarest word.

    Examples
    --------
    >>> text = [["the", "White", "Rabbit", "ran"]] * 3
    >>> dict(phrases(text, 2, frozenset({"the", "ran"})))
    {'White Rabbit': 3}
    """
    found = Counter(
        part
        for size in range(2, most + 1)
        for sentence in sentences
        for part in _parts(sentence, size)
        if part.split()[0].casefold() not in stops and part.split()[-1].casefold() not in stops
    )
    single, _ = folded(count_forms(sentences))
    together, _ = folded(found)
    kept = {
        phrase
        for phrase, count in together.items()
        if count >= max(LEAST_TOGETHER, PHRASE_SHARE * _rarest(phrase, single))
    }
    return Counter({form: count for form, count in found.items() if form.casefold() in kept})


def without_parts(counts: Counter[str], found: Mapping[str, int]) -> Counter[str]:
    """Counts of words and phrases, each word's less what stands inside of phrases.

    Examples
    --------
    >>> dict(without_parts(Counter(white=3, rabbit=5), {"white rabbit": 3}))
    {'rabbit': 2, 'white rabbit': 3}
    """
    left = Counter(counts)
    for phrase, count in found.items():
        for word in phrase.split():
            left[word] -= count
    return Counter({**{word: n for word, n in left.items() if n > 0}, **found})


def _parts(sentence: Sequence[str], size: int) -> list[str]:
    """Runs of that many words; none in scripts without spaces."""
    spaced = [word for word in sentence if not is_unspaced(word[0])]
    starts = range(len(sentence) - size + 1) if len(spaced) == len(sentence) else ()
    return [" ".join(sentence[start : start + size]) for start in starts]


def _rarest(phrase: str, single: Counter[str]) -> int:
    return min(single[word] for word in phrase.split())


def _singular(word: str, counts: Counter[str]) -> str | None:
    if len(word) < 4 or not word.endswith("s") or word.endswith("ss") or is_unspaced(word[0]):
        return None
    forms = [word[:-1]]
    if word.endswith("ies"):
        forms.append(word[:-3] + "y")
    if word.endswith("es"):
        forms.append(word[:-2])
    return next((form for form in forms if form in counts), None)
