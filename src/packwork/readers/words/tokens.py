"""Tokenisation of texts in any script, by spaces or a regular expression; stop words.

Python's matching tries one way after the other and knows no limit: ``(a+)+$`` takes longer
than the world is old on forty letters, and no look at a pattern tells all of its kind. What
cannot be known beforehand is stopped.
"""

from __future__ import annotations

import difflib
import json
import re
import statistics
import subprocess
import sys
import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib import resources
from typing import Any

from packwork.errors import RecipeError
from packwork.offspring import END_WITH_PARENT
from packwork.readers.reading import exists, is_folder, read_text
from packwork.readers.words.word import sound
from packwork.recipe_paths import is_like_a_path

MAX_BYTES = 2_000_000
"""Size of a file of words to leave out, or to keep. Chosen."""

ENGLISH = "en"

LEAST_SHARE = 0.12
"""Share of a text's words that must be function words of a language for it to be that one. Larger
misses lists of headings, smaller finds languages in lists of names. Chosen."""

LEAST_FOUND = 3
"""Function words from which a text has a language. More leave them in sentences of a few words,
fewer take names for them. Chosen."""


def stop_words(language: str) -> frozenset[str]:
    """Function words of languages given by code, case folded: ``en``, or ``en,de``.

    English is a list of our own: that of ``stopwordsiso`` has nouns such as "computer" and
    "world". All others are that package's; those of ten languages without their nouns and
    adjectives, such as "Mensch" and "вода", and some with what they lack, such as "aufs".

    Examples
    --------
    >>> "the" in stop_words("en"), "und" in stop_words("en,de"), "mensch" in stop_words("de")
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


def guess_language(forms: Counter[str]) -> str | None:
    """Language of a text, by the share of its words that are function words of one.

    Three at least, one of them without a capital or thrice as often as the others: lists of names
    have some ("Mia", "Per"), lists of titles begin with one. Words are given as they are written.

    Examples
    --------
    >>> guess_language(Counter("der Bär und die Biene in dem Wald".split()))
    'de'
    >>> guess_language(Counter(["Mia", "Tom", "Per", "Sara"])) is None
    True
    """
    often = LEAST_FOUND * statistics.median(forms.values() or [0])
    told = (form for form, n in forms.items() if often <= n < len(forms) or not form.istitle())
    small = set(map(str.casefold, told))
    counts, total = Counter[str](), forms.total()
    for form, n in forms.items():
        counts[form.casefold()] += n
    shares = {
        code: sum(counts[word] for word in _list(code)) / total
        for code in languages()
        if not small.isdisjoint(_list(code))
    }
    if not shares:
        return None
    best = max(shares, key=lambda code: (shares[code], -len(_list(code))))
    return best if shares[best] >= max(LEAST_SHARE, LEAST_FOUND / total) else None


def own_words(texts: Iterable[str]) -> frozenset[str]:
    """Words given, case folded: of files, one or several a line, and of words with commas between.

    Raises
    ------
    ReadError
        If a file is not there that is like a path, or is no text.

    Examples
    --------
    >>> sorted(own_words(["Polar bear", "fox,owl"]))
    ['fox', 'fox,owl', 'owl', 'polar bear']
    """
    return frozenset(word.casefold() for text in texts for word in _words_given(text))


def _words_given(text: str) -> list[str]:
    if (exists(text) and not is_folder(text)) or is_like_a_path(text):
        return read_text(text, MAX_BYTES).replace(",", " ").split()
    # A word of a table may have a comma in it.
    return [text.strip(), *(word.strip() for word in text.split(",") if word.strip())]


@cache
def _list(code: str) -> frozenset[str]:
    if code == ENGLISH:
        return frozenset(_bundled("english.txt").split())
    import stopwordsiso

    usual = frozenset(word.casefold() for word in stopwordsiso.stopwords(code))
    return usual - _words_of("content.txt", code) | _words_of("further.txt", code)


def _words_of(name: str, code: str) -> frozenset[str]:
    """Words of a language, case folded: the package's that say something, or those it lacks."""
    lines = (line.split() for line in _bundled(name).splitlines())
    return frozenset(word.casefold() for first, *words in lines if first == code for word in words)


@cache
def _bundled(name: str) -> str:
    place = resources.files("packwork.bundled").joinpath("words", name)
    return place.read_text(encoding="utf-8")


_HAN = "\u3005\u3400-\u4dbf\u4e00-\u9fff\uf900-\ufaff\U00020000-\U0003ffff"
_KANA = "\u3041-\u3096\u30a1-\u30fa\u30fc"
_THAI = "\u0e01-\u0e4e"
_UNSPACED = re.compile(f"[{_HAN}{_KANA}{_THAI}]")
_KANA_RUN = re.compile(f"[{_KANA}]")
_THAI_RUN = re.compile(f"[{_THAI}]")
_PIECES = re.compile(f"[{_HAN}{_KANA}]+|[{_THAI}]+|[^{_HAN}{_KANA}{_THAI}]+")
_HIRAGANA = re.compile("[\u3041-\u3096]+")

_TRADITIONAL = frozenset("個們來時國學為說會對過還沒這裡與從開門問東車馬見長風飛魚龍愛書")

_PARTICLES = (
    "でした", "ました", "ません", "ます", "です", "から", "まで", "より", "など", "には", "では",
    "とは", "だけ", "ほど", "は", "が", "を", "に", "で", "と", "も", "の", "へ", "や", "だ", "な",
)  # fmt: skip
"""What the phrases of the Japanese segmenter end in, longest first."""

MOST_AT_ONCE = 10_000
"""Characters that are segmented in one go; the rest is cut there. Chosen."""


def is_unspaced(character: str) -> bool:
    """Whether a character belongs to a script that is written without spaces.

    Examples
    --------
    >>> [is_unspaced(character) for character in "语กa"]
    [True, True, False]
    """
    return _UNSPACED.match(character) is not None


def segments(text: str) -> list[str]:
    """Words of a text without spaces; single Han characters and kana endings are left out.

    BudouX segments, into phrases: of Japanese ones the particles at the end are taken off.

    Examples
    --------
    >>> segments("我们的世界"), segments("日本の自然と文化")
    (['我们', '世界'], ['日本', '自然', '文化'])
    """
    found: list[str] = []
    for piece in _PIECES.findall(text):
        if not is_unspaced(piece[0]):
            found += [piece] if len(piece) > 1 and not piece.isnumeric() else []
            continue
        language = _language(piece)
        for start in range(0, len(piece), MOST_AT_ONCE):
            words = _segmenter(language).parse(piece[start : start + MOST_AT_ONCE])
            found += [_bare(word) for word in words] if language == "ja" else words
    return [
        word
        for word in found
        if 1 < len(word) <= LONGEST and not (len(word) < 3 and _HIRAGANA.fullmatch(word))
    ]


def _language(piece: str) -> str:
    if _THAI_RUN.match(piece):
        return "th"
    if _KANA_RUN.search(piece):
        return "ja"
    return "zh-hant" if _TRADITIONAL.intersection(piece) else "zh-hans"


@cache
def _segmenter(language: str) -> Any:
    import budoux

    return {
        "th": budoux.load_default_thai_parser,
        "ja": budoux.load_default_japanese_parser,
        "zh-hans": budoux.load_default_simplified_chinese_parser,
        "zh-hant": budoux.load_default_traditional_chinese_parser,
    }[language]()


def _bare(phrase: str) -> str:
    """A Japanese phrase without the particles that end it."""
    while True:
        ending = next((p for p in _PARTICLES if phrase.endswith(p)), "")
        rest = phrase.removesuffix(ending) if ending else phrase
        if not ending or _HIRAGANA.fullmatch(rest) or not rest:
            return phrase
        phrase = rest


MOST_SECONDS = 20.0
"""After which a match is given up: a plain pattern goes through a long novel in a tenth of one.
Chosen."""

_WORK = f"""{END_WITH_PARENT}
import json, re
try:
    import resource
    # Elsewhere than on Linux too, a match that takes long is not left behind.
    resource.setrlimit(resource.RLIMIT_CPU, (2 * {MOST_SECONDS:.0f}, 2 * {MOST_SECONDS:.0f}))
except (ImportError, ValueError, OSError):
    pass
asked = json.loads(sys.stdin.buffer.read())
known = re.compile(asked["pattern"])
found = [known.findall(text) if asked["groups"] else [m.group() for m in known.finditer(text)]
         for text in asked["texts"]]
sys.stdout.buffer.write(json.dumps(found).encode())
"""


def found_in(pattern: str, texts: Sequence[str], *, groups: bool = False) -> list[list[Any]]:
    r"""All that a regular expression, which compiles, finds in each text.

    With ``groups`` as ``re.findall`` has it: groups, where there are some, in place of the
    whole.

    Examples
    --------
    >>> found_in(r"#\w+", ["a #bear and", "#honey"])
    [['#bear'], ['#honey']]
    >>> found_in(r"(\w)(\w)", ["ox"], groups=True)
    [[['o', 'x']]]
    """
    if not sys.executable:  # a program that holds Python in it
        known = re.compile(pattern)
        return [
            known.findall(text) if groups else [match.group() for match in known.finditer(text)]
            for text in texts
        ]
    asked = {"pattern": pattern, "texts": list(texts), "groups": groups}
    try:
        done = subprocess.run(  # noqa: S603 - our own words, the pattern comes as data
            [sys.executable, "-I", "-c", _WORK],
            input=json.dumps(asked).encode(),
            capture_output=True,
            timeout=MOST_SECONDS,
            check=True,
        )
    except subprocess.TimeoutExpired:
        raise RecipeError(
            "regexp",
            f"takes more than {MOST_SECONDS:g} s on this text; use a plainer one, with no "
            "repeat of what repeats",
        ) from None
    except (OSError, subprocess.CalledProcessError) as error:
        raise RecipeError("regexp", f"cannot be matched ({type(error).__name__})") from None
    found: list[list[Any]] = json.loads(done.stdout)
    return found


JOINERS = "\u200c\u200d"
"""Unseen characters that belong to words of Persian and Indian scripts."""

_ADDRESS = re.compile(r"(?:https?://|www\.)\S+|(?<![^\s@])[^\s@]+@[^\s@]+\.\w+")
_SIGNS = re.compile(r"[^\w\s]{100}")
"""Runs of marks that are cut before they are normalised, which takes the square of their length."""

_APOSTROPHES = dict.fromkeys(map(ord, "\u2018\u2019\u02bc\uff07"), "'")
_POSSESSIVE = re.compile(r"'[sS]$")
_HYPHENS = dict.fromkeys(map(ord, "\u2010\u2011\ufe63\uff0d"), "-")
_DASH = re.compile(r"(?<![^\s-])-|-(?![^\s-])")
"""A hyphen that stands for a dash, or ends a word: none of two words that it joins."""

LONGEST = 200
"""Letters of a word at most: what is longer is data that stands in a text. Chosen."""


def sentences(text: str, *, include_numbers: bool = False) -> Iterator[list[str]]:
    """Words that follow each other with nothing but spaces between them, as they are written.

    A word is letters, marks and digits, with apostrophes and hyphens inside; numbers alone,
    addresses of the web and what is longer than ``LONGEST`` are none. Text of scripts without
    spaces is segmented.

    Examples
    --------
    >>> list(sentences("The bear's honey, don't! हिन्दी 42 https://x.org/a"))
    [['The', 'bear', 'honey'], ["don't"], ['हिन्दी']]
    >>> list(sentences("Twenty-six e-mails - and 3-4 Ein- und Ausgänge"))
    [['Twenty-six', 'e-mails'], ['and', 'Ein'], ['und', 'Ausgänge']]
    """
    for run in _runs(_ADDRESS.sub("\n", _normal(text))):
        words = [word for token in run.split() for word in _words(token, include_numbers)]
        if words:
            yield words


def matches(text: str, pattern: str) -> Iterator[list[str]]:
    r"""Matches of a regular expression, line by line; control characters and idle spaces off.

    Examples
    --------
    >>> list(matches("a #bear and\n#honey", r"#\w+"))
    [['#bear'], ['#honey']]
    """
    for found in found_in(pattern, _normal(text).splitlines()):
        words = [word for match in found if (word := sound(match))]
        if words:
            yield words


def _normal(text: str) -> str:
    return unicodedata.normalize("NFC", _SIGNS.sub("\\g<0>\f", text))


def _runs(text: str) -> list[str]:
    plain = _DASH.sub("\f", text.translate(_APOSTROPHES | _HYPHENS))
    table = {ord(character): _in_words(character) for character in set(plain)}
    return plain.translate(table).split("\n")


def _in_words(character: str) -> str:
    """A character in words: itself, nothing, a space or an end of the run."""
    if character in JOINERS or character in "'-":
        return character
    category = unicodedata.category(character)
    if category[0] in "LMN":
        return character
    if category == "Cf":
        return ""
    return " " if character.isspace() and character not in "\f\v" else "\n"


def _words(token: str, include_numbers: bool) -> Iterator[str]:
    word = _POSSESSIVE.sub("", token.strip("'-" + JOINERS))
    if any(is_unspaced(character) for character in word):
        yield from segments(word)
    elif len(word) > LONGEST or not any(map(str.isalnum, word)):
        return
    elif include_numbers or not is_number(word):
        yield word


def is_number(word: str) -> bool:
    """Whether a word is of digits alone, and of hyphens between them."""
    return all(unicodedata.category(character)[0] == "N" for character in word.replace("-", ""))


def says_little(word: str, stops: frozenset[str]) -> bool:
    """Whether a word is a function word, or hyphens join it of nothing else.

    Examples
    --------
    >>> [says_little(word, frozenset({"up", "to"})) for word in ("up-to", "up-date", "to")]
    [True, False, True]
    """
    return word in stops or ("-" in word and stops.issuperset(word.split("-")))
