"""Options of ``words`` to the recipe of a run."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from packwork.errors import RecipeError
from packwork.options import Verbs
from packwork.readers.options import TEXT_PREFIX
from packwork.readers.tables.pairs import PairColumns, pairs_of_rows
from packwork.readers.tables.table import is_frame, rows_of_frame
from packwork.readers.words.options import WordOptions
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.pictures import check_no_names, known_palette
from packwork.recipe.refusals import validated
from packwork.recipe.verbs import with_defaults
from packwork.recipe_paths import AROUND, check_names
from packwork.scene.contrast import readable
from packwork.scene.palette import palette_colours

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
    if is_frame(source):
        frame = rows_of_frame(source, has_row_numbers=False)
        columns = PairColumns(own.pop("label_by", None), own.pop("size_by", None))
        if any(columns):
            return {pair.name: pair.number for pair in pairs_of_rows(frame, columns).rows}
        rows = [tuple(row.values()) for row in frame]
        return {str(row[0]): row[1] for row in rows if len(row) > 1 and row[0] is not None}
    if source is None or isinstance(source, str | os.PathLike | Mapping):
        return source
    words = list(source) if isinstance(source, Iterable) else []
    if words and all(isinstance(word, str) for word in words):
        return dict(Counter(words))
    pairs = getattr(source, "items", None)
    try:
        return dict(pairs())  # type: ignore[misc]
    except (TypeError, ValueError):
        raise RecipeError(
            "source",
            f"is {type(source).__name__}; use a text, a file, or a list of words or weights "
            "by word, such as {'bear': 2}",
        ) from None


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
