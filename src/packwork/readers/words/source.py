"""Words and weights counted in texts or taken from tables, the largest first."""

from __future__ import annotations

import contextlib
import sys
from collections import Counter
from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from packwork.errors import ReadError, RecipeError, RowsLostError
from packwork.phrasing import enumerated, number_of
from packwork.readers.reading import exists, read_bytes
from packwork.readers.tables.decoding import Decoded, check_no_document, decoded
from packwork.readers.tables.delimited import ENDINGS, NAMES, UNICODE_TEXT, is_parted_by
from packwork.readers.tables.format import TableFormat
from packwork.readers.tables.pairs import PairColumns
from packwork.readers.tables.workbook import ending_of
from packwork.readers.words.lists import listed_names, told_of
from packwork.readers.words.options import WordOptions
from packwork.readers.words.plurals import without_clitics, without_plurals
from packwork.readers.words.table import MAX_BYTES, read_word_table
from packwork.readers.words.tokens import (
    guess_language,
    is_number,
    is_unspaced,
    matches,
    own_words,
    says_little,
    sentences,
    stop_words,
)
from packwork.readers.words.word import Word, sound
from packwork.sources import note_input

LEAST_TOGETHER = 3
"""How often words must stand together to be a phrase. Chosen."""

PHRASE_SHARE = 0.5
"""Share of the rarer word's places at which it stands in the phrase. Larger finds names
only, smaller any habit of speech. Tried on two novels."""

Sentences = Sequence[Sequence[str]]


def count_forms(sentences: Sentences) -> Counter[str]:
    """Number of times that each written form stands in the sentences.

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


def phrases(sentences: Sentences, most: int, stops: frozenset[str]) -> Counter[str]:
    """Number of times that up to ``most`` words that belong together stand together, as written.

    A phrase neither begins nor ends with a stop word, stands there ``LEAST_TOGETHER``
    times, and at ``PHRASE_SHARE`` of the places of its rarest word. Of words with capitals, as
    names are, once less will do.

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
    together, written = folded(found)
    kept = {
        phrase
        for phrase, count in together.items()
        if count >= LEAST_TOGETHER - all(word[0].isupper() for word in written[phrase].split())
        and count >= PHRASE_SHARE * min(single[word] for word in phrase.split())
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


STANDARD_INPUT = "-"
"""Stands for what is piped into the program."""

_TEXT_ENDINGS = frozenset({".txt", ".md", ".rst", ".text", ".json", *ENDINGS})


@dataclass(frozen=True, eq=False)
class Ranked:
    """Words that could be set, the largest weights first, and what has to be told of their source.

    ``stopped`` are left out as those of the text's language that say little, the most frequent
    first; none where the language was asked for. ``sentences`` are words of a text in their
    order, ``order`` those of all rows of a table.
    """

    words: tuple[Word, ...]
    told: tuple[ReadError, ...] = ()
    stopped: tuple[str, ...] = ()
    sentences: Sequence[Sequence[str]] = ()
    order: tuple[str, ...] | None = None


def read_words(options: WordOptions, asked: TableFormat | None = None) -> list[Word]:
    """Words of a text, a table, standard input or a dict: the largest weights first.

    Of tables nothing is left out but what ``stopwords`` names. Words that weigh the same
    come in the order of the text.

    Examples
    --------
    >>> text = "The bear and the bees: a bear likes honey, and bees make honey for the bear."
    >>> [(word.text, word.weight) for word in read_words(WordOptions(source=text, count=3))]
    [('bear', 3.0), ('bees', 2.0), ('honey', 2.0)]
    """
    return list(ranked_words(options, asked).words[: options.most])


def ranked_words(options: WordOptions, asked: TableFormat | None = None) -> Ranked:
    """All words that could be set, more than ``count`` if there are, as :func:`read_words`.

    Examples
    --------
    >>> len(ranked_words(WordOptions(source={"bear": 2, "fox": 1}, count=1)).words)
    2
    """
    read = _words(options, asked or TableFormat())
    cased = [replace(word, text=_cased(word.text, options.case)) for word in read.words]
    seen = [word for word in cased if sound(word.text).replace("|", "").strip()]
    ranked = sorted(_merged(seen), key=lambda word: -word.weight)
    if not ranked:
        raise ReadError(_name(options), "holds no words that could be set")
    told = read.told
    if unseen := len(cased) - len(seen):
        many = number_of(unseen, "word is", "words are")
        told += (ReadError(_name(options), f"{many} empty, and left out"),)
    order = read.order and tuple(sound(_cased(text, options.case)) for text in read.order)
    return replace(read, words=tuple(ranked), told=told, order=order)


def _words(options: WordOptions, asked: TableFormat) -> Ranked:
    source, columns = options.source, PairColumns(options.label_by, options.size_by)
    stops = own_words(options.stopwords)
    is_table = not isinstance(source, dict) and _is_table(source, asked)
    if any(columns) and not is_table:
        key = "label_by" if options.label_by else "size_by"
        raise RecipeError(key, "names a column; give a table with columns, not a text or weights")
    if isinstance(source, dict):
        read = Ranked(tuple(Word(word, weight) for word, weight in source.items()))
    elif is_table:
        read = _rows(source, asked, columns)
    else:
        text = _text(source, asked)
        read = _counted(text.text, options, stops)
        said = (text.notice, _LIKE_A_TABLE if is_parted_by(NAMES, text.text) else "")
        told = (*read.told, *(ReadError(_name(options), one) for one in said if one))
        return replace(read, told=told)
    fields = WordOptions.model_fields
    idle = [key for key in _OF_TEXTS if getattr(options, key) != fields[key].default]
    if idle:
        flags = enumerated([f"--{key.replace('_', '-')}" for key in idle])
        notice = ReadError(_name(options), f"is no running text, of which {flags} would tell")
        read = replace(read, told=(*read.told, notice))
    if not isinstance(source, dict):
        there = {word.text.casefold() for word in read.words}
        read = replace(read, told=(*read.told, *_unmet(options, there)))
    kept = tuple(word for word in read.words if word.text.casefold() not in stops)
    return replace(read, words=kept, order=tuple(word.text for word in read.words))


_OF_TEXTS = (
    "language", "keep_words", "min_count", "min_word_length", "include_numbers", "regexp",
    "phrases", "plurals",
)  # fmt: skip

_LIKE_A_TABLE = "looks like a table, and its numbers are no weights in a text; name it .csv"


def _counted(text: str, options: WordOptions, own: frozenset[str]) -> Ranked:
    found = list(
        sentences(text, include_numbers=options.include_numbers)
        if options.regexp is None
        else matches(text, options.regexp)
    )
    language = options.language
    if language == "auto":
        language = guess_language(count_forms(found)) or "none"
    codes = [code.strip().lower() for code in language.split(",")]
    is_plain = options.regexp is None and options.phrases == 1
    names = listed_names(text) if is_plain else []
    if names:
        found = [names]
    elif options.regexp is None:
        bare = [without_clitics(words, codes) for words in found]
        if not options.include_numbers:
            bare = [[word for word in words if not is_number(word)] for words in bare]
        found = [words for words in bare if words]
    counts, written = folded(count_forms(found))
    # A capital at the beginning of a sentence tells nothing of how a word is written elsewhere.
    votes = [words[1:] if words[0].istitle() else words for words in found]
    written |= folded(count_forms(votes))[1]
    if not counts:
        hint = " (--include-numbers counts numbers, tables may have emoji)" if text.strip() else ""
        raise ReadError(
            _name(options), f"holds no words{hint}; give a text, or a table of word,weight"
        )
    kept_anyway = own_words(options.keep_words)
    listed = stop_words(language) if language != "none" else frozenset()
    usual = frozenset(word for word in counts if says_little(word, listed)) - kept_anyway
    stops = own | usual
    is_said = options.language != "auto"
    stopped = () if is_said else tuple(w for w, _ in counts.most_common() if w in usual - own)
    if options.phrases > 1:
        several, forms = folded(phrases(found, options.phrases, stops))
        counts, written = without_parts(counts, several), written | forms
    said_much = ((word, n) for word, n in counts.items() if word not in usual)
    kept = Counter(
        {word: n for word, n in said_much if word in kept_anyway or _is_long(word, options)}
    )
    if options.plurals == "merge":
        kept = without_plurals(kept, codes, own, written)
    kept = Counter({word: n for word, n in kept.items() if word not in own})
    words = [Word(written[word], float(n)) for word, n in kept.items() if n >= options.min_count]
    if not words:
        raise ReadError(_name(options), _why_none(counts, kept, options))
    said = tuple(written[word] for word in stopped)
    told = _unmet(options, written)
    if names:
        told += (ReadError(_name(options), told_of(names)),)
    return Ranked(tuple(words), told, said, found)


def _unmet(options: WordOptions, there: Container[str]) -> tuple[ReadError, ...]:
    """Sentences about words to leave out, or to keep, that a source does not hold at all."""
    told = []
    for flag, texts in (("stopwords", options.stopwords), ("keep-words", options.keep_words)):
        # A word with a comma may be several.
        away = [word for word in sorted(own_words(texts)) if word not in there and "," not in word]
        if away:
            text = f"does not hold {enumerated(away)}, which --{flag} names"
            told.append(ReadError(_name(options), text))
    return tuple(told)


def _why_none(counts: Counter[str], kept: Counter[str], options: WordOptions) -> str:
    if not kept:
        named = enumerated([word for word, _ in counts.most_common()])
        many = number_of(
            len(counts), "word, a stop word", "different words, and all are stop words"
        )
        return (
            f"holds {many} or too short ({named}); use --language none, a smaller "
            "--min-word-length, or another text"
        )
    word, most = kept.most_common(1)[0]
    return (
        f"has no word {options.min_count} times; the most frequent, {word[:40]!r}, is there "
        f"{number_of(most, 'time')}; use a smaller --min-count"
    )


def _is_long(word: str, options: WordOptions) -> bool:
    """Whether it has letters enough; one syllable of Korean is a word."""
    return len(word) >= options.min_word_length or "\uac00" <= word <= "\ud7a3"


def _rows(source: str, asked: TableFormat, columns: PairColumns) -> Ranked:
    table = read_word_table(source, asked, columns)
    if not table.words:
        raise ReadError(source, "holds no words; give lines such as bear,2")
    told = [ReadError(source, notice) for notice in table.notices]
    return Ranked(table.words, (*told, *(RowsLostError(source, text) for text in table.lost)))


def _text(source: str, asked: TableFormat) -> Decoded:
    if source == STANDARD_INPUT:
        data = _piped(MAX_BYTES + 1)
        if len(data) > MAX_BYTES:
            raise ReadError("standard input", f"is larger than {MAX_BYTES / 1e6:g} MB")
        return decoded(data, "standard input", asked.encoding)
    if not source.strip():
        raise ReadError("source", "is empty; give a text, or a table of word,weight")
    if exists(source):
        return decoded(read_bytes(source, MAX_BYTES), source, asked.encoding)
    if len(source.split()) < 2 or Path(source[-20:]).suffix.lower() in _TEXT_ENDINGS:
        raise ReadError(
            source[:80],
            "there is no such file; give a text, a table of word,weight, or - for stdin",
        )
    check_no_document(source[:4_000].encode("utf-8", "replace"), source[:20])
    return Decoded(source)


def _piped(most: int) -> bytes:
    """Text that is piped into the program, at most so many bytes."""
    if sys.stdin is None:
        raise ReadError("standard input", "is closed; pipe a text in, or give a file")
    # What is called by another program may have none.
    with contextlib.suppress(OSError, AttributeError):
        note_input(sys.stdin.fileno(), "standard input")
    try:
        return sys.stdin.buffer.read(most)
    except OSError as error:
        raise ReadError("standard input", f"cannot be read: {error.strerror}") from None


def _is_table(source: str, asked: TableFormat) -> bool:
    if len(source) >= 1_000 or "\n" in source:
        return False
    ending = ending_of(source)
    if ending == UNICODE_TEXT and exists(source):
        return is_parted_by("\t", _text(source, asked).text)
    return ending in {".json", *ENDINGS}


def _merged(words: Iterable[Word]) -> list[Word]:
    """Words that read the same become one, their weights added."""
    found: dict[str, Word] = {}
    for word in words:
        text = sound(word.text)
        before = found.get(text)
        if before:
            word = replace(before, weight=before.weight + word.weight, written="")
        found[text] = replace(word, text=text)
    return list(found.values())


def _cased(text: str, case: str) -> str:
    if case == "common":
        return text
    return text.lower() if case == "lower" else text.upper()


def _name(options: WordOptions) -> str:
    source: str | Mapping[str, float] = options.source
    if not isinstance(source, str):
        return "weights"
    return "standard input" if source == STANDARD_INPUT else source[:60]
