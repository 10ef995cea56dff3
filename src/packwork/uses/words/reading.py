"""Words of a recipe, and the items and photographs among them."""

from __future__ import annotations

from collections.abc import Sequence

from packwork.pipeline.plan.plan import found_sizes
from packwork.pipeline.read import Material, read_named
from packwork.readers.words.items import read_word_items
from packwork.readers.words.options import WordOptions
from packwork.recipe import Recipe
from packwork.recipe.meaning import FROM_TEXT
from packwork.scene.item import Item
from packwork.uses.photos.crop import crops
from packwork.uses.room import KnownContainer
from packwork.uses.words.cast import cast_words
from packwork.uses.words.colours import check_colours
from packwork.uses.words.counts import words_counted
from packwork.uses.words.letters import Letters
from packwork.uses.words.use import WordsUse


def nesting(asked: WordOptions, recipe: Recipe, room: KnownContainer) -> WordOptions:
    """Options that say whether words stand in counters: unless asked, where sizes give way."""
    if asked.nest is not None or room.container is None:
        return asked
    return asked.model_copy(update={"nest": found_sizes(recipe, room.container) == "graded"})


def read_cloud(
    recipe: Recipe, asked: WordOptions, room: KnownContainer, given: Sequence[Item] | None
) -> Material:
    """Words of a recipe, and the items and photographs among them."""
    # Refuses cut photographs among words.
    crops(recipe)
    asked = nesting(asked, recipe, room)
    is_related = recipe.embeddings == FROM_TEXT
    counted = words_counted(asked, room)
    words = read_word_items(counted, recipe.holes, recipe, is_related=is_related)
    check_colours(recipe, words)
    named = read_named(recipe, given)
    chosen = cast_words(recipe, words, named.items)
    container = room.of(chosen)
    return Material(
        use=WordsUse(words, asked, Letters.of(asked, container, recipe.sizes)),
        container=container,
        cast=chosen,
        fillers=words.items,
        given=None if words.order is None else (*words.order, *named.keys),
        skipped=(*named.skipped, *words.told),
    )
