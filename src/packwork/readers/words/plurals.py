"""Plurals and their singulars, by rules of suffixes; forms count together if a text has both.

Only rules of which few meet two different words. What they join in spite of that are words such as
"Reis" and "Reise", which are named here. German nouns are told by their capital.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping

from packwork.readers.words.tokens import ENGLISH, is_unspaced

LEAST_STEM = 3
"""Letters that a singular has at least. Smaller joins words such as "as" and "ass". Chosen."""

_UNLIKE = frozenset(
    {
        *("new news", "mean means", "cour cours", "fil fils", "moi mois", "foi fois", "ver vers"),
        *("reis reise", "kohl kohle", "schal schale", "not note", "noten not", "rind rinde"),
        *("rat rate", "rat raten", "watt watte", "watt watten", "kant kante", "pass passe"),
        *("sola sole", "vita vite", "pena pene", "mar mars", "kur kurs", "kur kurse"),
    }
)
"""Pairs, the shorter or earlier first, that are two words."""

_IN_ER = frozenset(
    {
        "amt", "bad", "bild", "blatt", "brett", "buch", "dach", "dorf", "ei", "fach",
        "feld", "geist", "glas", "gras", "haus", "huhn", "kalb", "kind", "kleid", "kraut",
        "lamm", "land", "lied", "licht", "loch", "mann", "nest", "rad", "rand", "schild",
        "schloss", "tal", "tuch", "volk", "wald", "weib", "wort", "wurm",
    }
)  # fmt: skip
"""German nouns whose plural ends in -er, as that of no others: "Arbeiter" is none."""

_LAST_VOWEL = re.compile(r"(a+|o+|u)(u?[^aeiouäöü]*)$")
_UMLAUTS = str.maketrans("aou", "äöü")
_PLAIN = str.maketrans("áéíóúâêô", "aeiouaeo")
_VOWELS = "aeiouáéíóúãõ"


def _english(word: str) -> Iterator[str]:
    if not word.endswith("s"):
        yield word + "s"
    if word.endswith(("s", "x", "z", "ch", "sh", "o")):
        yield word + "es"
    if word.endswith("y"):
        yield word[:-1] + "ies"


def _german(word: str) -> Iterator[str]:
    endings = ["e", "en", "es", "s", "n"] if word[-1] not in "en" else ["n", "s"]
    yield from (word + ending for ending in endings)
    if word in _IN_ER or any(word.endswith(noun) and len(noun) > 3 for noun in _IN_ER):
        yield from (_umlaut(word) + ending for ending in ("er", "ern"))
    elif _umlaut(word) != word:
        yield from (_umlaut(word) + ending for ending in ("", "e", "en", "n"))


def _umlaut(word: str) -> str:
    stem, ending = (word[:-2], word[-2:]) if word.endswith(("el", "er", "en")) else (word, "")
    return _LAST_VOWEL.sub(lambda met: met[1][0].translate(_UMLAUTS) + met[2], stem) + ending


def _french(word: str) -> Iterator[str]:
    yield word + "s"
    if word.endswith(("au", "eu", "ou")):
        yield word + "x"
    if word.endswith(("al", "ail")):
        yield re.sub("ai?l$", "aux", word)


def _spanish(word: str) -> Iterator[str]:
    if word[-1] in _VOWELS:
        yield word + "s"
    elif word.endswith("z"):
        yield word[:-1] + "ces"
    else:
        yield word + "es"
        yield word[:-2] + word[-2].translate(_PLAIN) + word[-1] + "es"


def _portuguese(word: str) -> Iterator[str]:
    if word.endswith("ão"):
        yield from (word[:-2] + ending for ending in ("ões", "ães", "ãos"))
    elif word[-1] in _VOWELS:
        yield word + "s"
    elif word.endswith("l"):
        yield from (word[:-2] + vowel + "is" for vowel in {word[-2], _accented(word[-2])})
    elif word.endswith("m"):
        yield word[:-1] + "ns"
    else:
        yield word + "es"


def _accented(vowel: str) -> str:
    return vowel.translate(str.maketrans("aeou", "áéóú"))


def _italian(word: str) -> Iterator[str]:
    stem, ending = word[:-1], word[-1]
    if ending in "oe":
        yield (stem if stem.endswith("i") else stem + "i")
    if ending == "a":
        yield stem + ("he" if stem[-1] in "cg" else "e")
    if ending == "o" and stem[-1] in "cg":
        yield stem + "hi"


def _dutch(word: str) -> Iterator[str]:
    yield from (word + ending for ending in ("s", "'s", "en"))
    if word.endswith("e"):
        yield word + "n"
    hard = word[:-1] + {"f": "v", "s": "z"}.get(word[-1], word[-1])
    yield hard + "en"
    if re.search(r"[^aeiou][aeiou][^aeiouwxy]$", word):
        yield word + word[-1] + "en"
    yield re.sub(r"([aeou])\1(?=[^aeiou]$)", r"\1", hard) + "en"


_PLURALS: Mapping[str, Callable[[str], Iterator[str]]] = {
    ENGLISH: _english, "de": _german, "fr": _french, "es": _spanish, "pt": _portuguese,
    "it": _italian, "nl": _dutch,
}  # fmt: skip


def without_plurals(
    counts: Counter[str],
    languages: Iterable[str],
    stops: frozenset[str] = frozenset(),
    written: Mapping[str, str] | None = None,
) -> Counter[str]:
    """Counts in which forms of one word are added up, if both are there: under the commoner form.

    English ones count under their singular. A word is left out with all its forms where one of
    these is a stop word.

    Parameters
    ----------
    languages
        Codes of those whose rules hold; those without rules join nothing.
    written
        Word as it is mostly written, by the case-folded one; German is not joined without it.

    Examples
    --------
    >>> dict(without_plurals(Counter(bear=2, bears=3, glass=1, berry=1, berries=1), ["en"]))
    {'bear': 5, 'glass': 1, 'berry': 2}
    >>> dict(without_plurals(Counter(hand=4, hands=3, river=2), ["en"], frozenset({"hands"})))
    {'river': 2}
    >>> dict(without_plurals(Counter(cheval=1, chevaux=2), ["fr"]))
    {'chevaux': 3}
    """
    leads, forms = dict[str, str](), written or {}
    for code in (code for code in languages if code in _PLURALS):
        known = [word for word in counts if len(word) >= LEAST_STEM and not is_unspaced(word[0])]
        if code == "de":
            known = [word for word in known if forms.get(word, word)[0].isupper()]
        there = set(known)
        pairs = ((word, form) for word in known for form in _PLURALS[code](word))
        for word, plural in pairs:
            if plural not in there or plural == word or f"{word} {plural}" in _UNLIKE:
                continue
            one, other = _lead(leads, word), _lead(leads, plural)
            if one != other:
                is_led = code == ENGLISH or counts[one] >= counts[other]
                leads |= {other: one} if is_led else {one: other}
    stopped = {_lead(leads, word) for word in stops}
    merged = Counter[str]()
    for word, count in counts.items():
        if (lead := _lead(leads, word)) not in stopped:
            merged[lead] += count
    return merged


def _lead(leads: Mapping[str, str], word: str) -> str:
    while word in leads:
        word = leads[word]
    return word
