"""Words and what is mixed in with them, as copies to be placed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from packwork.errors import RecipeError
from packwork.pipeline.plan.cast import Cast, expand_copies
from packwork.readers.words.items import WordsRead
from packwork.recipe import Recipe
from packwork.scene.item import Item

BOX_OVER_INK = 2.5
"""Area of a word's box over that of its letters. Larger makes what is mixed in stand out
more. Chosen by eye."""


def cast_words(recipe: Recipe, words: WordsRead, added: Sequence[Item]) -> Cast:
    """Words and what is mixed in with them, each once; that is as large as a middling word's box.

    Raises
    ------
    RecipeError
        As for :func:`expand_copies`, and if the recipe has a table of weights besides.
    """
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
