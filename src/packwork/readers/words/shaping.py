"""Words as fonts draw them: outlines, and items where they are asked for."""

from __future__ import annotations

import base64
import math
from dataclasses import dataclass
from functools import lru_cache

from shapely import affinity

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.curves import Curve
from packwork.geometry.distance import CLEFT
from packwork.geometry.outline import Outline, centre_of_area
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.fonts.glyph_ink import ClearInk
from packwork.readers.fonts.lettering import MOST_COARSE, MOST_WORDS, GlyphPicture, Lettering
from packwork.readers.reading import UnfitError, reading_file
from packwork.readers.regions import Holes, centred, clean_union
from packwork.readers.words.word import Word, lines_of
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


def word_item(word: Word, fonts: Fonts, holes: Holes = "fill") -> Item:
    """One word as an item: named after it, with a tooltip that tells its weight.

    Examples
    --------
    >>> from packwork.readers.fonts.fallback import open_fonts
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
        weight = self.word.written or f"{self.word.weight:.6g}"
        label = Label(name=self.name, title=f"{self.name}: {weight}")
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
    >>> from packwork.readers.fonts.fallback import open_fonts
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
    >>> from packwork.readers.fonts.fallback import open_fonts
    >>> import numpy as np
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
