"""Words with weights to items: outlines in the proportions asked for."""

from __future__ import annotations

import logging
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import ReadError, RecipeError
from packwork.readers.fonts.fallback import Fonts, open_fonts
from packwork.readers.reading import UnfitError
from packwork.readers.regions import Holes
from packwork.readers.tables.format import TableFormat
from packwork.readers.words.cooccurrence import cooccurrence_vectors
from packwork.readers.words.options import WeightIs, WordOptions
from packwork.readers.words.shaping import shaped_word
from packwork.readers.words.source import ranked_words
from packwork.readers.words.word import Word, lines_of
from packwork.scene.item import Item

WIDEST_HEIGHTS = 1_000.0
"""Largest height of letters over the smallest; the smallest could not be seen. Chosen."""

_LOG = logging.getLogger("packwork")


@dataclass(frozen=True, eq=False)
class WordsRead:
    """Words as items, one em of each being ``EM_PX``, the largest weights first.

    ``areas`` ``(n,)`` are shares such that heights are as asked for; ``undrawn`` words that
    could not be set, with the reasons; ``found`` the number of different words; ``stopped``
    frequent words of a text that say little; ``vectors`` ``(n, d)`` tell which stand together;
    ``order`` has names and texts of all rows of a table; ``values`` what each of its columns
    holds, by the alphabet.
    """

    items: tuple[Item, ...]
    areas: FloatArray
    words: tuple[Word, ...]
    undrawn: Mapping[str, str]
    found: int
    told: tuple[ReadError, ...] = ()
    stopped: tuple[str, ...] = ()
    vectors: FloatArray | None = None
    order: tuple[tuple[str, str], ...] | None = None
    values: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


def read_word_items(
    options: WordOptions,
    holes: Holes = "fill",
    asked: TableFormat | None = None,
    *,
    is_related: bool = False,
) -> WordsRead:
    """Items of the words that a source holds, with vectors of which stand together if wanted.

    Holes of words are kept with the option ``nest`` too.

    Examples
    --------
    >>> read = read_word_items(WordOptions(source={"bear": 2, "中" * 200: 1}))
    >>> [item.name for item in read.items], list(read.undrawn.values())
    (['bear'], ['has 200 characters; the most is 100'])
    """
    fonts = word_fonts(options)
    holes = "keep" if options.nest else holes
    items: list[Item] = []
    words: list[Word] = []
    undrawn: dict[str, str] = {}
    ranked = ranked_words(options, asked)
    for one in ranked.told:
        _LOG.warning("%s", one)
    asked_for = ranked.words[: options.most]
    is_many = len(asked_for) > MANY
    shown = ems(asked_for, options.weight_is) if is_many else np.full(len(asked_for), np.inf)
    for word, em in zip(asked_for, shown.tolist(), strict=True):
        try:
            items.append(shaped_word(word, fonts, holes, em).item)
            words.append(word)
        except UnfitError as error:
            undrawn[word.text] = str(error)
    if not items:
        first = next(iter(undrawn))
        raise ReadError(first[:40], f"cannot be set, nor any other word: {undrawn[first]}")
    weights = np.array([word.weight for word in words])
    return WordsRead(
        tuple(items),
        area_shares(items, weights, options.weight_is),
        tuple(words),
        undrawn,
        len(ranked.words),
        ranked.told,
        ranked.stopped,
        cooccurrence_vectors(ranked.sentences, words, options.phrases) if is_related else None,
        None
        if ranked.order is None
        else tuple((" ".join(lines_of(text)), text) for text in ranked.order),
        _values(ranked.words),
    )


def _values(words: Sequence[Word]) -> dict[str, tuple[str, ...]]:
    columns = dict.fromkeys(column for word in words for column in word.columns)
    return {
        column: tuple(sorted({word.columns.get(column, "") for word in words}))
        for column in columns
    }


def word_fonts(options: WordOptions) -> Fonts:
    """Fonts that words are set in."""
    return open_fonts(options.fonts, options.font_weight, _one_language(options.language))


MANY = 250
"""Words up to which each one's curves are followed as if it filled the canvas. Larger takes memory;
smaller moves words of clouds that are finished by true outlines. Chosen."""

LETTER = 0.25
"""Area of a letter's silhouette, square ems. Larger follows curves more finely than shows, smaller
leaves more room between words for what curves bulge. Of a bold sans; thin ones have half."""


def ems(words: Sequence[Word], weight_is: WeightIs) -> FloatArray:
    """``(n,)`` height of each word's em, of the side of a square that all words cover, about.

    Examples
    --------
    >>> ems([Word("ox", 2.0), Word("ox", 2.0)], "height").tolist()
    [1.0, 1.0]
    """
    weights, letters = np.array([(word.weight, len(word.text)) for word in words]).T
    heights = weights if weight_is == "height" else np.sqrt(weights)
    if weight_is == "ink":
        heights = heights / np.sqrt(letters)
    return np.asarray(heights / np.sqrt(LETTER * letters @ heights**2))


def area_shares(items: Sequence[Item], weights: FloatArray, weight_is: WeightIs) -> FloatArray:
    """``(n,)`` areas, in shares, of words whose heights, or areas, are as the weights say.

    Examples
    --------
    >>> from packwork.readers.words.shaping import word_item
    >>> ox = word_item(Word("ox", 2.0), open_fonts([]))
    >>> shares = [area_shares([ox, ox], np.array([2.0, 1.0]), k) for k in ("height", "area")]
    >>> [round(float(share[0] / share[1])) for share in shares]
    [4, 2]
    """
    own = np.array([item.outline.area for item in items])
    heights = height_shares(items, weights, weight_is)
    # As numbers of Python, which become infinite without a warning.
    widest = min(float(heights.max()) / float(heights.min()), sys.float_info.max)
    if widest > WIDEST_HEIGHTS:
        raise RecipeError(
            "weight_is",
            f"the largest letters would be {widest:.3g} times as high as the smallest, at most "
            f"{WIDEST_HEIGHTS:g} can be shown; use area, or fewer words",
        )
    # Relative ones, so that no area runs over.
    return np.asarray(own * (heights / heights.max()) ** 2)


def height_shares(items: Sequence[Item], weights: FloatArray, weight_is: WeightIs) -> FloatArray:
    """``(n,)`` heights of words, in shares, whose heights or areas are as the weights say."""
    heights = weights if weight_is == "height" else np.sqrt(weights)
    if weight_is == "ink":
        heights = heights / np.sqrt([item.outline.area for item in items])
    return np.asarray(heights)


def _one_language(language: str) -> str:
    """The words' language; empty where several may be meant, or none was named."""
    return "" if language in {"auto", "none"} or "," in language else language
