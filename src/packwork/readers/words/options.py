"""Options of words: their source, their fonts and their sizes."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping, Set
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, Field, field_serializer, field_validator

from packwork.errors import RecipeError
from packwork.options import NOT_OFFERED, Group, Offer, Options, Verbs, number_or_auto
from packwork.readers.options import colour_of, texts_of
from packwork.readers.words.word import Word

WeightIs: TypeAlias = Literal["height", "area", "ink"]

Along: TypeAlias = Literal["limbs", "edge"]

ColourOf: TypeAlias = Callable[[Word], str | None]
"""Any CSS colour of a word, by its ``text``, ``weight`` and ``columns``; None leaves the
palette's first."""

MOST_WORDS = 10_000
"""Words in one cloud; more could not be read on any sheet. Chosen."""


MOST_BY_DEFAULT = 100
"""The same unless asked: as many as can be read on a screen. Chosen."""


_TYPE = Offer(group=Group.TYPE)


def _top_and_bottom(texts: Any) -> Any:
    if isinstance(texts, list | tuple) and len(texts) > 2:
        raise RecipeError("ring", f"is a text at the top and one at the bottom, not {len(texts)}")
    return (texts,) if isinstance(texts, str) else texts


def _texts(given: Any) -> Any:
    """Texts of one, or of several; those of a set in an order of their own."""
    if given is None or isinstance(given, str | Path):
        given = () if given is None else (given,)
    if not isinstance(given, Iterable):
        raise ValueError(f"use a text or a list of them, not {given!r}")
    texts = [str(one) if isinstance(one, Path) else one for one in given]
    return sorted(texts) if isinstance(given, Set) else texts


_Named: TypeAlias = Annotated[
    tuple[str, ...],
    BeforeValidator(_texts),
    Offer(takes=str | Path | tuple[str | Path, ...] | Set[str] | None, metavar="WORDS|FILE"),
]


def _path_text(font: Any) -> Any:
    return str(font) if isinstance(font, Path) else font


class WordOptions(Options):
    """Source of words, and the setting of them."""

    offers = Offer(group=Group.PLACED, verbs=Verbs.WORDS)

    source: Annotated[str | dict[str, float], NOT_OFFERED]
    """Text, a table of word,weight (.csv, .xlsx, .json), or - for standard input; in Python
    also the text itself, or a dict of weights."""

    count: Annotated[
        Annotated[int, Field(ge=1, le=MOST_WORDS)] | Literal["auto"],
        BeforeValidator(number_or_auto),
    ] = MOST_BY_DEFAULT
    """How many words at most: those of the largest weights. auto: as many as it takes for the
    container's shape to show."""

    label_by: str | None = None
    """Column that names marks: in files, tooltips and messages, and on marks that have room; of a
    table of words, their column."""

    size_by: str | None = None
    """Column of numbers that sizes are in proportion to. Default: of words the weights; in a chart
    all marks are alike."""

    min_count: Annotated[int, Field(ge=1)] = 1
    """How often a word must stand in the text."""

    language: str = "auto"
    """Whose function words are left out: auto (the language of the text), codes such as en
    or en,de, or none."""

    stopwords: _Named = ()
    """Further words to leave out, with commas between them, or a file of them. A word that is left
    out takes its plural and its other forms along."""

    keep_words: _Named = ()
    """Words to count though they are function words or too short, with commas between them, or a
    file of them."""

    min_word_length: Annotated[int, Field(ge=1)] = 2
    """Letters that a word of a text has at least; one syllable of Korean is a word anyway."""

    include_numbers: bool = False
    """Numbers that stand alone count as words too."""

    regexp: str | None = None
    """What counts as a word of a text, as a regular expression of Python such as [#@]\\w+."""

    phrases: Annotated[int, Field(ge=1, le=4)] = 1
    """2 also counts pairs of words that often stand together, 3 triples too."""

    plurals: Literal["merge", "keep"] = "merge"
    """merge: plurals of English, German, French, Spanish, Portuguese, Italian and Dutch count with
    their singular, if both stand in the text."""

    case: Annotated[Literal["common", "lower", "upper"], _TYPE] = "common"
    """How words are written: as they mostly stand in the text, lower or upper."""

    fonts: Annotated[
        tuple[str, ...],
        texts_of("font"),
        Offer(group=Group.TYPE, flags="--font", takes=str | Path | tuple[str | Path, ...]),
    ] = ()
    """Font file or installed family; the next ones set what the first cannot. Default: a
    bundled black sans, then whatever is installed and has the letters."""

    container_font: Annotated[
        str | None, BeforeValidator(_path_text), Offer(group=Group.TYPE, takes=str | Path | None)
    ] = None
    """Font file or installed family of a container text:WORD, where it is another than the
    words' first."""

    font_weight: Annotated[int, Field(ge=1, le=1_000), _TYPE] = 700
    """Weight of a family or a variable font: 400 is regular, 700 bold."""

    nest: Annotated[bool | None, _TYPE] = None
    """Words may stand in the counters of larger ones, such as in an O. Default: where sizes give
    way."""

    weight_is: Annotated[WeightIs, _TYPE] = "height"
    """What is in the proportion of the weights: height (of the letters), area (of the
    letters: their height by the root) or ink (of the whole word: long ones are lower)."""

    smallest: Annotated[str | float | None, NOT_OFFERED] = None
    """Font size of the smallest word, a length as for the padding: words that would come out
    smaller are left out, the lightest first, and named."""

    largest: Annotated[str | float | None, _TYPE] = None
    """Font size of the largest word at most, a length as for the padding, such as 48pt or 10%;
    all others stay in proportion."""

    repeat: Annotated[Literal["none", "auto"] | None, _TYPE] = None
    """auto: words are set again, smaller and grey, where nothing else finds a place; none: each
    once. Default: none, but words of one weight in letters (text:HELLO) are set again, as large as
    before, for these to be read."""

    along: Along | None = None
    """Words follow curves, and are set again until these are full; the heaviest are a cloud in what
    is left. limbs: the middle of what is long and thin of the container; edge: its edge."""

    ring: Annotated[tuple[str, ...], BeforeValidator(_top_and_bottom)] = ()
    """Text that follows the edge at the top of the container, as on a badge; a second one at its
    bottom. The words lie inside."""

    color_by: Annotated[str | ColourOf | None, _TYPE] = None
    """weight (the palette from small to large), a column of the table, or a picture under
    the words; in Python also a function of a word. Default: neighbours unlike."""

    background: Annotated[str | None, colour_of("background"), NOT_OFFERED] = None
    """Colour behind the words: theirs are made to be read on it. Default: white."""

    contrast: Annotated[float, Field(ge=1, le=21), _TYPE] = 3.0
    """Least contrast of words and background, as WCAG counts it; 1 leaves colours alone."""

    @property
    def most(self) -> int:
        """Words at most; the default for ``auto`` that is not resolved yet."""
        return self.count if isinstance(self.count, int) else MOST_BY_DEFAULT

    @property
    def paper(self) -> str | None:
        """Colour that words are read on; None if it is not known."""
        seen = self.background not in (None, "none", "transparent")
        return self.background if seen else None

    @field_serializer("color_by")
    def _functions_go_by_their_names(self, by: str | ColourOf | None) -> str | None:
        return getattr(by, "__qualname__", repr(by)) if callable(by) else by

    @field_validator("source", mode="before")
    @classmethod
    def _source_holds_weights(cls, source: Any) -> Any:
        if isinstance(source, Path):
            return str(source)
        if not isinstance(source, Mapping):
            return source
        for word, weight in source.items():
            check_weight(str(word), weight)
        return {str(word): float(weight) for word, weight in source.items()}

    @field_validator("regexp")
    @classmethod
    def _regexp_compiles(cls, pattern: str | None) -> str | None:
        try:
            re.compile(pattern or "")
        except (re.error, RecursionError, OverflowError) as error:
            raise RecipeError("regexp", f"is no regular expression: {error}") from None
        return pattern


def check_weight(word: str, weight: object) -> None:
    """Refuse what is no positive number.

    Examples
    --------
    >>> check_weight("bear", -1)
    Traceback (most recent call last):
    packwork.errors.RecipeError: source: the weight of 'bear' must be a positive number, not -1
    """
    try:
        value = float(weight)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        value = math.nan
    if not (math.isfinite(value) and value > 0):
        raise RecipeError(
            "source",
            f"the weight of {word[:40]!r} must be a positive number, not {str(weight)[:20]}",
        )
