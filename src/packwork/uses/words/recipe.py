"""Options of ``words`` to the recipe of a run."""

from __future__ import annotations

import logging
import os
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from datetime import timedelta
from typing import Any

from packwork.errors import RecipeError
from packwork.options import Verbs
from packwork.phrasing import enumerated, number_of
from packwork.readers.options import TEXT_PREFIX
from packwork.readers.tables.pairs import MOST_NAMED, PairColumns, pairs_of_rows
from packwork.readers.tables.table import is_frame, plain_row, rows_of_frame
from packwork.readers.words.options import WordOptions, check_weight
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.pictures import check_no_names, known_palette
from packwork.recipe.refusals import validated
from packwork.recipe.verbs import with_defaults
from packwork.recipe_paths import AROUND, check_names
from packwork.scene.contrast import readable
from packwork.scene.palette import palette_colours

_LOG = logging.getLogger("packwork")

PALETTE = "ink"
"""Colours of words that are given none."""

RAMP = "viridis"
"""Colours from small to large, where none are given."""

CATEGORIES = "tol-muted"
"""Colours of a column's values, where none are given: dark enough for words, and unlike."""

WEIGHT = "weight"

PAPER = "white"
"""What words are read on where no background is given."""


def words_recipe(
    container: str, source: object, *, add: Sequence[str] = (), **options: Any
) -> Recipe:
    """Recipe that sets words, from the options of ``words`` and of all runs alike.

    Parameters
    ----------
    source
        As :class:`WordOptions` has it; anything with ``items()`` is a table of weights.

    Examples
    --------
    >>> recipe = words_recipe("heart", {"bear": 2, "fox": 1}, count=1, palette="yellow")
    >>> recipe.words.count, recipe.palette, recipe.sizes
    (1, ('#999a1b',), 'auto')
    """
    if "fonts" not in options and options.get("font") is not None:
        # As ``--font`` is meant; the container's own is given beside ``fonts``.
        options["fonts"] = options.pop("font")
    own = {key: options.pop(key) for key in list(options) if key in WordOptions.model_fields}
    asked = _word_options({"source": _plain_source(source, own), **own})
    chosen = with_defaults(Verbs.WORDS, options)
    if (font := _container_font(asked, container)) is not None and chosen.get("font") is None:
        chosen["font"] = font
    chosen["palette"] = words_colours(chosen.get("palette"), asked, container)
    return make_recipe(container=container, items=list(add), words=asked, **chosen)


def _container_font(asked: WordOptions, container: str) -> str | None:
    """Font of a container of words: its own, or else the words' first."""
    if container.startswith(TEXT_PREFIX):
        return asked.container_font or next(iter(asked.fonts), None)
    if asked.container_font is not None:
        raise RecipeError(
            "container_font", f"sets a container of words, as in text:HELLO, not {container!r}"
        )
    return None


def _word_options(values: Mapping[str, Any]) -> WordOptions:
    given = {key: value for key, value in values.items() if value is not None}
    check_names({"words": given})
    return validated(WordOptions, given)


def _plain_source(source: object, own: dict[str, Any]) -> object:
    """Tables of other libraries as a dict: a Series, or two columns of a frame.

    ``own``: options, of which those that say which columns are taken out; else the first two.
    """
    if source is None or isinstance(source, str | os.PathLike):
        return source
    if is_frame(source):
        frame = rows_of_frame(source, has_row_numbers=False)
        columns = PairColumns(own.pop("label_by", None), own.pop("size_by", None))
        if any(columns):
            pairs = pairs_of_rows(frame, columns).rows
            return weights_by_word((pair.name, pair.number) for pair in pairs)
        return weights_by_word(tuple(row.values())[:2] for row in frame if len(row) > 1)
    if isinstance(source, Mapping):
        return weights_by_word(source.items())
    entries = list(source) if isinstance(source, Iterable) else []
    if entries and all(isinstance(one, tuple | list) and len(one) == 2 for one in entries):
        return weights_by_word(entries)
    words = [word for one in entries if (word := _word(one)) is not None]
    are_words = not any(isinstance(one, timedelta) for one in entries)
    if are_words and words and all(isinstance(word, str) for word in words):
        return dict(Counter(words))
    if words and hasattr(source, "items"):
        return weights_by_word(source.items())
    met = "holds no words" if isinstance(source, Iterable) else f"is {type(source).__name__}"
    if words:
        met = f"holds {next(one for one in words if not isinstance(one, str))!r} as a word"
    raise RecipeError(
        "source",
        f"{met}; use a text, a file, or a list of words or weights by word, such as {{'bear': 2}}",
    )


def _word(said: Any) -> Any:
    """A word as it is written, or a number; None where none is."""
    if isinstance(said, Iterable) and not isinstance(said, str):
        raise RecipeError("source", f"a word must be a text, not {said!r:.40}")
    return plain_row({"": said})[""]


def weights_by_word(entries: Iterable[tuple[Any, Any]]) -> dict[str, float]:
    """Weights by word, their sum where it stands several times; words without one are told.

    Raises ``RecipeError`` where a weight is no positive number, or a word is no text.

    Examples
    --------
    >>> weights_by_word([("bear", 2), ("fox", None), ("owl", 0), ("bear", 1)])
    {'bear': 3.0}
    """
    found: dict[str, float] = {}
    without: dict[str, list[str]] = {"word": [], "weight": []}
    for said, number in entries:
        word, weight = _word(said), plain_row({"": number})[""]
        if word in (None, ""):
            without["word"].append(str(weight))
            continue
        if weight in (None, 0, ""):
            without["weight"].append(str(word))
            continue
        check_weight(str(word), weight)
        found[str(word)] = found.get(str(word), 0.0) + float(weight)
    for lacking, others in without.items():
        if others:
            left = number_of(len(others), "weight" if lacking == "word" else "word")
            line = "source: left out %s without a %s: %s"
            _LOG.warning(line, left, lacking, enumerated(others, MOST_NAMED))
    return found


def words_colours(
    palette: object, asked: WordOptions, container: str
) -> tuple[str, ...] | dict[str, str]:
    """Colours that can be read on the background; a picture is one word by word, later.

    Those of the values of a column may be given by name.

    Examples
    --------
    >>> words_colours("yellow", WordOptions(source={"bear": 2}), "heart")
    ('#999a1b',)
    """
    is_column = has_column(asked)
    default = PALETTE if asked.color_by is None else CATEGORIES if is_column else RAMP
    known = known_palette(default if palette is None else palette)
    if not is_column:
        check_no_names(known)
    colours = palette_colours(known)
    if not container.startswith(AROUND):
        paper = asked.paper or PAPER
        colours = tuple(readable(colour, paper, asked.contrast) for colour in colours)
    if isinstance(known, Mapping):
        return dict(zip(known, colours, strict=True))
    # A ramp of the same colour again and again would tell nothing: the ends stay unlike.
    return tuple(dict.fromkeys(colours))


def has_column(asked: WordOptions) -> bool:
    """Whether a column of the table says colours, or a picture may."""
    return isinstance(asked.color_by, str) and asked.color_by != WEIGHT
