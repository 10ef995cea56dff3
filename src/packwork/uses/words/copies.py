"""Words and what is mixed in with them, as copies to be placed: how many, and in which order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, cast

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.phrasing import enumerated
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import Cast, expand_copies, turns
from packwork.pipeline.plan.counts import items_needed
from packwork.pipeline.plan.plan import found_sizes
from packwork.readers.tables.cells import written_numbers
from packwork.readers.words.items import WordsRead
from packwork.readers.words.options import MOST_BY_DEFAULT, WordOptions
from packwork.recipe import AUTO, Recipe
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.uses.icons import KnownContainer
from packwork.uses.letters import copies_for_letters

if TYPE_CHECKING:
    from packwork.uses.words.use import WordsUse

BOX_OVER_INK = 2.5
"""Area of a word's box over that of its letters. Larger makes what is mixed in stand out
more. Chosen by eye."""


def cast_words(recipe: Recipe, words: WordsRead, added: Sequence[Item]) -> Cast:
    """Words and what is mixed in, each once; that is as large as a middling word's box."""
    if recipe.weights is not None:
        raise RecipeError(
            "weights",
            "words have the weights of their source; give items beside them theirs by rules",
        )
    others = tuple(added)
    middling = BOX_OVER_INK * float(np.median(words.areas))
    areas = np.append(words.areas, np.full(len(others), middling))
    found = expand_copies(recipe, (*words.items, *others), areas=areas)
    spoken = set(words.items)
    pairs = zip(found.items, found.asked, strict=True)
    asked = (one.to_be_read if item in spoken else one for item, one in pairs)
    return replace(found, asked=tuple(asked))


FEWEST_WORDS = 60
"""Words that a cloud has at least: fewer look like a list. Chosen by eye."""


def words_needed(container: Container) -> int:
    """Words for which the container's shape shows."""
    # Words are larger and smaller ones as they come, whether all keep their shares or not.
    return max(items_needed(container).count, FEWEST_WORDS)


def words_counted(asked: WordOptions, room: KnownContainer) -> WordOptions:
    """Options of a recipe's words, with a number in place of ``auto``: the usual one at least."""
    if asked.count != AUTO:
        return asked
    return asked.model_copy(update={"count": max(words_needed(room.known), MOST_BY_DEFAULT)})


def nesting(asked: WordOptions, recipe: Recipe, room: KnownContainer) -> WordOptions:
    """Options that say whether words stand in counters: unless asked, where sizes give way."""
    if asked.nest is not None or room.container is None:
        return asked
    return asked.model_copy(update={"nest": found_sizes(recipe, room.container) == "graded"})


def for_letters(words: WordsRead, recipe: Recipe, room: KnownContainer) -> WordsRead:
    """Words of one weight, again and again where letters of a container would not show.

    Not where a recipe says whether words are repeated, where they follow lines, or others lie
    among them.
    """
    asked = recipe.words
    is_told = asked is None or asked.repeat or asked.along or asked.ring or recipe.items
    if is_told or len({word.weight for word in words.words}) > 1:
        return words
    count = len(words.items)
    total = copies_for_letters(recipe, count, lambda: words_needed(room.known))
    if total is None:
        return words
    which = turns([None] * count, total)
    return replace(
        words,
        items=tuple(words.items[k] for k in which),
        areas=words.areas[which],
        words=tuple(words.words[k] for k in which),
    )


FEW = 6
"""Columns that a message names. Chosen."""


def column_values(read: WordsRead, job: Job, column: str) -> FloatArray | None:
    """``(n,)`` what a column says of the job's items; None if there is no such column.

    Numbers are what they say; other cells, dates too, are in the order of the alphabet.
    """
    pairs = zip(read.items, read.words, strict=True)
    cells = {item: word.columns.get(column, "").strip() for item, word in pairs}
    if not any(cells.values()):
        return None
    empty = [item.name for item in job.items if not cells.get(item)]
    if empty:
        have = "has" if len(empty) == 1 else "have"
        raise RecipeError("arrange", f"{enumerated(empty)} {have} nothing in {column[:40]!r}")
    texts = [cells[item] for item in job.items]
    numbers = np.array(written_numbers(texts, "words", column, usual=".", asked=job.recipe.decimal))
    if np.isfinite(numbers).all():
        return numbers
    order = np.unique([text.casefold() for text in texts], return_inverse=True)[1]
    return np.asarray(order, dtype=np.float64)


def columns_there(read: WordsRead) -> str:
    """Columns that there are, for messages; empty if there are none."""
    return ", ".join(list(dict.fromkeys(key for word in read.words for key in word.columns))[:FEW])


def words_of(job: Job) -> WordsUse:
    """The use of a job whose items are words; steps of words are on lists of no other."""
    return cast("WordsUse", job.use.inner)
