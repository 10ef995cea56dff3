"""Words with weights to items: outlines in the proportions asked for."""

from __future__ import annotations

import base64
import logging
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from shapely import affinity

from packwork.arrays import FloatArray
from packwork.errors import ReadError, RecipeError
from packwork.geometry import affine
from packwork.geometry.curves import Curve
from packwork.geometry.distance import CLEFT
from packwork.geometry.outline import Outline, centre_of_area
from packwork.readers.fonts.fallback import Fonts, open_fonts
from packwork.readers.fonts.glyph_ink import ClearInk
from packwork.readers.fonts.lettering import MOST_COARSE, MOST_WORDS, GlyphPicture, Lettering
from packwork.readers.reading import UnfitError, reading_file
from packwork.readers.regions import Holes, centred, clean_union
from packwork.readers.tables.format import TableFormat
from packwork.readers.words.cooccurrence import cooccurrence_vectors
from packwork.readers.words.options import WeightIs, Word, WordOptions, lines_of
from packwork.readers.words.source import ranked_words
from packwork.scene.item import Item, Label, LiveText, VectorArt

EM_PX = 100.0
"""Height of an em in an item's own units. Any number would do."""

WORD_SPACE = (0.05 * EM_PX, 0.01 * EM_PX)
"""Room that a word keeps from larger ones beside and above itself, where words give way, beside the
margin of all. Larger draws less ink, smaller lets words of one size read as one. By eye."""

LONGEST = 100
"""Characters of one word; no more could be read. Chosen."""

INK = "#2d3748"
"""Colour of words that are given no other."""

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


def word_item(word: Word, fonts: Fonts, holes: Holes = "fill") -> Item:
    """One word as an item: named after it, with a tooltip that tells its weight.

    Examples
    --------
    >>> item = word_item(Word("ox", 2.0), open_fonts([]))
    >>> item.label.title, len(item.outline.rings), len(item.ink.rings)
    ('ox: 2', 2, 3)
    """
    return shaped_word(word, fonts, holes).item


@dataclass(frozen=True, eq=False)
class ShapedWord:
    """A word's outline, and the 2 x 3 map from an em of ``EM_PX`` to it; drawn once asked for."""

    word: Word
    name: str
    drawn: Lettering
    outline: Outline
    ink: Outline
    place: FloatArray
    language: str

    @property
    def item(self) -> Item:
        """The word as an item: named after it, with a tooltip that tells its weight."""
        drawn, text = self.drawn, None
        if drawn.runs and not drawn.pictures:
            text = LiveText(drawn.runs, drawn.path, self.language)
        label = Label(name=self.name, title=f"{self.name}: {self.word.weight:.6g}")
        art = _art(drawn, self.place)
        return Item(
            self.name, self.word.text, self.outline, self.ink, art, label, text,
            coarseness=drawn.coarseness,
        )  # fmt: skip


def shaped_word(
    word: Word,
    fonts: Fonts,
    holes: Holes = "fill",
    em: float = math.inf,
    most_coarse: float = MOST_COARSE,
) -> ShapedWord:
    """One word as fonts draw it, about its outline's centroid; curves as ``lettering_of`` says.

    Examples
    --------
    >>> word = shaped_word(Word("ox", 2.0), open_fonts([]), "keep")
    >>> len(word.outline.rings), word.item.label.title
    (3, 'ox: 2')
    """
    drawn = fonts.lettering(lines_to_set(word), em, most_coarse)
    return _shaped(word, drawn, fonts, holes)


def lines_to_set(word: Word) -> list[str]:
    """Lines of a word; an UnfitError if it has none, or is too long to be read."""
    if len(word.text) > LONGEST:
        raise UnfitError(f"has {len(word.text):,} characters; the most is {LONGEST}")
    lines = lines_of(word.text)
    if not lines:
        raise UnfitError("has no letters")
    return lines


def bent_word(
    word: Word, fonts: Fonts, curve: Curve, start: float, end: float, holes: Holes = "fill"
) -> ShapedWord:
    """One word on one line along a curve, in ems, from one arc length to another.

    Examples
    --------
    >>> arc = Curve(np.array([[0.0, 1.0], [0.3, 0.3], [1.0, 0.0], [1.7, 0.3], [2.0, 1.0]]))
    >>> word = bent_word(Word("oo", 2.0), open_fonts([]), arc, 0.5, 2.5)
    >>> len(word.outline.rings), bool(word.outline.bounds[3] > 20)
    (2, True)
    """
    return _shaped(word, fonts.bent(" ".join(lines_of(word.text)), curve, start, end), fonts, holes)


def _shaped(word: Word, drawn: Lettering, fonts: Fonts, holes: Holes) -> ShapedWord:
    name = " ".join(lines_of(word.text))
    with reading_file(name):
        outline, ink, place = _placed(drawn, holes)
    return ShapedWord(word, name, drawn, outline, ink, place, fonts.language)


def area_shares(items: Sequence[Item], weights: FloatArray, weight_is: WeightIs) -> FloatArray:
    """``(n,)`` areas, in shares, of words whose heights, or areas, are as the weights say.

    Examples
    --------
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


@lru_cache(MOST_WORDS)
def _placed(drawn: Lettering, holes: Holes) -> tuple[Outline, Outline, FloatArray]:
    """Outline and ink about the outline's centroid, and the map that brought them there."""
    covered = drawn.covered
    if not isinstance(covered, ClearInk) or covered.clearance <= CLEFT:
        region = affinity.scale(drawn.region, EM_PX, EM_PX, origin=(0, 0))
        return centred(clean_union(region), holes)
    outline = covered.silhouette if holes == "fill" else covered.ink
    x, y = centre_of_area(outline) * EM_PX
    place = affine.similarity(-x, -y, 0.0, 1.0)
    whole = affine.compose(place, affine.similarity(0.0, 0.0, 0.0, EM_PX))
    placed = outline.mapped(whole)
    # One object where they are the same: measures need not ask whether one holds the other.
    return placed, covered.ink.mapped(whole) if holes == "fill" else placed, place


def _art(drawn: Lettering, place: FloatArray) -> VectorArt:
    scale = affine.similarity(0.0, 0.0, 0.0, EM_PX / drawn.units)
    curves = f'<path fill="{INK}" d="{drawn.path}"/>' if drawn.path else ""
    markup = curves + "".join(map(_image, drawn.pictures))
    return VectorArt(markup, affine.compose(place, scale), is_traced=bool(drawn.pictures))


def _image(picture: GlyphPicture) -> str:
    data = base64.b64encode(picture.png).decode("ascii")
    place = " ".join(f"{value:.10g}" for value in picture.matrix.T.ravel())
    return (
        f'<image width="{picture.width}" height="{picture.height}" transform="matrix({place})"'
        f' preserveAspectRatio="none" xlink:href="data:image/png;base64,{data}"/>'
    )


def _one_language(language: str) -> str:
    """The words' language; empty where several may be meant, or none was named."""
    return "" if language in {"auto", "none"} or "," in language else language
