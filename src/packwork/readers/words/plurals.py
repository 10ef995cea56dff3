"""Plurals and their singulars, by rules of suffixes; what hangs on other words.

Forms count together if a text has both. Only rules of which few meet two different words; a form
that two words could have, as "casi" of "caso" and "casa", is joined to none. What is joined in
spite of that are words such as "Reis" and "Reise", which are named here. German nouns are told by
their capital.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence, Set

from packwork.readers.words.tokens import ENGLISH, is_unspaced

LEAST_STEM = 3
"""Letters that a singular has at least. Smaller joins words such as "as" and "ass". Chosen."""

_UNLIKE = frozenset(
    {
        *("new news", "mean means", "cour cours", "fil fils", "moi mois", "foi fois", "ver vers"),
        *("fond fonds", "mar mars", "reis reise", "kohl kohle", "schal schale", "not note"),
        *("rind rinde", "rat rate", "watt watte", "kant kante", "pass passe", "kur kurs"),
        *("kur kurse", "fall falle", "mark marke", "hall halle", "lag lage", "mal male"),
        *("rund runde", "eck ecke", "blut blüte", "gut güte", "dio dios", "carlo carlos"),
        *("marco marcos", "luca lucas", "avó avós", "deu deus", "cai cais", "sola sole"),
        *("vita vite", "pena pene", "sala sale", "botta botte", "fama fame", "corta corte"),
        *("colla colle", "ander anders", "jonge jongen", "jong jongen"),
    }
)
"""Pairs, the shorter or earlier first, that are two words."""

_IN_ER = frozenset(
    {
        "amt", "bad", "band", "bild", "blatt", "brett", "buch", "dach", "dorf", "ei", "fach",
        "feld", "geist", "glas", "grab", "gras", "haus", "huhn", "kalb", "kind", "kleid", "kraut",
        "lamm", "land", "lied", "licht", "loch", "mann", "nest", "rad", "rand", "schild",
        "schloss", "tal", "tuch", "volk", "wald", "weib", "wort", "wurm",
    }
)  # fmt: skip
"""German nouns whose plural ends in -er, as that of no others: "Arbeiter" is none."""

_IN_EN = frozenset(
    {
        "ansicht", "antwort", "arbeit", "art", "bahn", "burg", "bär", "fabrik", "fahrt", "form",
        "frau", "frist", "fürst", "gefahr", "geburt", "gewalt", "graf", "held", "herr", "last",
        "mensch", "nachricht", "pflicht", "prinz", "schicht", "schlacht", "schrift", "schuld",
        "spur", "tat", "tür", "uhr", "wahl", "welt", "zahl", "zeit",
    }
)  # fmt: skip
"""Such whose plural ends in -en, beside those that end as ``_EN_AFTER``: "Polen" is no plural."""

_EN_AFTER = ("ung", "heit", "keit", "schaft", "ion", "tät", "ist", "ent", "ant")

_BY_UMLAUT = frozenset(
    {
        "apfel", "boden", "bruder", "garten", "hafen", "kasten", "laden", "mantel", "mutter",
        "nagel", "ofen", "tochter", "vater", "vogel",
    }
)  # fmt: skip
"""Such whose plural has another vowel alone, as "Bürger" is none of "Burger"."""

_LAST_VOWEL = re.compile(r"(aa?|oo?|u)(u?[^aeiouäöü]*)$")
_UMLAUTS = str.maketrans("aou", "äöü")
_PLAIN = str.maketrans("áéíóúâêô", "aeiouaeo")
_IN_AOS = frozenset(
    {"chão", "cidadão", "cristão", "grão", "irmão", "mão", "pagão", "órfão", "órgão"}
)
_IN_AES = frozenset({"alemão", "capelão", "capitão", "catalão", "cão", "escrivão", "pão"})
_VOWELS = "aeiouáéíóúãõ"


def _english(word: str) -> Iterator[str]:
    if not word.endswith("s"):
        yield word + "s"
    if word.endswith(("s", "x", "z", "ch", "sh", "o")):
        yield word + "es"
    if word.endswith("y"):
        yield word[:-1] + "ies"


def _german(word: str) -> Iterator[str]:
    if word.endswith("e"):
        yield word + "n"
    elif word.endswith(("el", "er", "en")):
        yield word + "s"
        if not word.endswith("en"):
            yield word + "n"
        if word in _BY_UMLAUT:
            yield _umlaut(word)
    else:
        yield from (word + "s", word + "es")
        if _is_of(word, _IN_ER):
            yield _umlaut(word) + "er"
        elif _is_of(word, _IN_EN) or word.endswith(_EN_AFTER):
            yield word + "en"
        else:
            yield from {word + "e", _umlaut(word) + "e"}


def _is_of(word: str, nouns: frozenset[str]) -> bool:
    """Whether a word is one of those nouns, or ends in one as compounds do."""
    return word in nouns or any(word.endswith(noun) and len(noun) > 3 for noun in nouns)


def _with_datives(word: str, there: Set[str]) -> Iterator[str]:
    """German plurals that are there, and their datives; of two in -e the one with an umlaut."""
    forms = [form for form in _german(word) if form in there]
    if word + "e" in forms and _umlaut(word) + "e" in forms and _umlaut(word) != word:
        forms.remove(word + "e")
    for form in forms:
        yield form
        if form.endswith(("e", "er")):
            yield form + "n"


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
        ending = "ãos" if word in _IN_AOS else "ães" if word in _IN_AES else "ões"
        yield word[:-2] + ending
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
    if ending == "o" or word.endswith(_I_AFTER):
        yield (stem if stem.endswith("i") else stem + "i")
    if ending == "a":
        yield stem + ("he" if stem[-1] in "cg" else "e")
    if ending == "o" and stem[-1] in "cg":
        yield stem + "hi"


_I_AFTER = ("ione", "tore", "sore", "gnore", "more", "iore", "ente", "iere", "male", "nale", "rale")
"""Ends of Italian words whose -e becomes -i; other words in -e are often plurals themselves."""


def _dutch(word: str) -> Iterator[str]:
    hard = word[:-1] + {"f": "v", "s": "z"}.get(word[-1], word[-1])
    if word.endswith("e") and not word.endswith("ee"):
        yield from (word + "s", word + "n")
    elif word[-1] in "aiouy":
        yield word + "'s"
    elif len(word) > 4 and word.endswith(("el", "er", "en", "em", "aar")):
        yield word + "s"
    elif word in _LENGTHENED:
        yield from {word + "en", hard + "en"}
    elif re.search(r"(?<![aeiou])[aeiou][^aeiouwxy]$", word):
        yield word + word[-1] + "en"
    elif re.search(r"([aeou])\1[^aeiou]$", word):
        yield word[:-2] + hard[-1] + "en"
    else:
        yield from {word + "en", hard + "en"}


_LENGTHENED = frozenset(
    {
        "bad", "dag", "dak", "gat", "gebed", "glas", "god", "hof", "lot", "oorlog", "pad", "slag",
        "spel", "vat", "verdrag", "weg",
    }
)  # fmt: skip
"""Dutch words whose short vowel is a long one in the plural, as "dagen"."""

_PLURALS: Mapping[str, Callable[[str], Iterator[str]]] = {
    ENGLISH: _english, "de": _german, "fr": _french, "es": _spanish, "pt": _portuguese,
    "it": _italian, "nl": _dutch,
}  # fmt: skip


def without_plurals(
    counts: Counter[str],
    languages: Collection[str],
    stops: frozenset[str] = frozenset(),
    written: Mapping[str, str] | None = None,
) -> Counter[str]:
    """Counts in which forms of one word are added up, if both are there: under the commoner form.

    A form that two words could have counts by itself, and so do forms of forms. English ones count
    under their singular. A word is left out with all its forms where one of these is a stop word.

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
    single, forms = _singulars(counts, languages, written or {}), defaultdict[str, list[str]](list)
    for word in counts:
        forms[single.get(word, word)].append(word)
    groups = [sorted(group, key=lambda word: word in single) for group in forms.values()]
    merged = Counter[str]()
    for group in groups:
        if stops.isdisjoint(group):
            lead = group[0] if ENGLISH in languages else max(group, key=counts.__getitem__)
            merged[lead] = sum(counts[word] for word in group)
    return merged


def _singulars(
    counts: Counter[str], languages: Collection[str], written: Mapping[str, str]
) -> dict[str, str]:
    """Singular of each plural, both of them there; none where two singulars could own it."""
    owners = defaultdict[str, set[str]](set)
    for code in (code for code in languages if code in _PLURALS):
        known = [word for word in counts if len(word) >= LEAST_STEM and not is_unspaced(word[0])]
        if code == "de":
            known = [word for word in known if written.get(word, word)[0].isupper()]
        there = set(known)
        for word in known:
            found = _with_datives(word, there) if code == "de" else _PLURALS[code](word)
            for form in there.intersection(found) - {word}:
                if f"{word} {form}" not in _UNLIKE:
                    owners[form].add(word)
    # A plural has none of its own.
    own = {plural: words - owners.keys() for plural, words in owners.items()}
    return {plural: min(words) for plural, words in own.items() if len(words) == 1}


_CLITICS = {
    "ca": re.compile(r"^[dlmnst]'|'(?:ls?|ns?|[mt])$", re.IGNORECASE),
    "fr": re.compile(
        r"^(?:[cdjlmnst]|(?:jus|lors|puis|quoi)?qu)'"
        r"|(?:-(?:t|je|tu|ils?|elles?|on|nous|vous|ce|moi|toi|lui|leur|les?|la|en|y|l\u00e0|ci))+$",
        re.IGNORECASE,
    ),
    "it": re.compile(
        r"^(?:[cdlmnstv]|gl|(?:d[ae]|ne|su|co|que|a|be)ll|quest|(?:ness|alc|qualc|ciasc)?un"
        r"|tutt|anch|com|cos|dov|quand)'",
        re.IGNORECASE,
    ),
    "pt": re.compile(r"^[Dd]'|(?:-(?:me|te|se|lhes?|[nv]os|[nl]?[oa]s?))+$"),
}
"""Articles, pronouns and prepositions that hang on words: "l'été", "dell'anno", "dit-il"."""


def without_clitics(words: Sequence[str], languages: Iterable[str]) -> list[str]:
    """Words without the articles and pronouns that hang on them in four languages.

    Examples
    --------
    >>> without_clitics(["répondit-elle", "a-t-on", "arc-en-ciel", "d'aujourd'hui"], ["fr"])
    ['répondit', 'a', 'arc-en-ciel', "aujourd'hui"]
    """
    found = list(words)
    for clitics in (_CLITICS[code] for code in languages if code in _CLITICS):
        found = [clitics.sub("", word).strip("'-") or word for word in found]
    return found
