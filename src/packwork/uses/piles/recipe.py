"""Options of ``pile`` to the recipe of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from packwork.errors import RecipeError
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.piles import PileOptions
from packwork.recipe.refusals import validated
from packwork.uses.icons import NO_CONTAINER

DEFAULT_FORCE, DEFAULT_FORCE_ALONE = "down", "towards centre"
"""What heaps items in a container, and where there is none."""


def pile_recipe(container: str, items: Sequence[str], **options: Any) -> Recipe:
    """Recipe that heaps items, from the options of ``pile`` and of all runs alike.

    Examples
    --------
    >>> recipe = pile_recipe("square", ["star"], count=9, open="top")
    >>> recipe.force, recipe.sizes, recipe.pile.open
    (('down',), 'fixed', ('top',))
    """
    own = {key: options.pop(key) for key in list(options) if key in PileOptions.model_fields}
    asked = validated(PileOptions, _given(own))
    if options.get("sizes", "fixed") != "fixed":
        raise RecipeError("sizes", "items of a pile keep their sizes; give --size")
    plain = {**_given(options), "sizes": "fixed", "pile": asked}
    default = DEFAULT_FORCE_ALONE if container == NO_CONTAINER else DEFAULT_FORCE
    plain["force"] = plain.get("force") or (default,)
    if container == NO_CONTAINER and asked.open:
        raise RecipeError("open", "there is no container to open; leave it out")
    return make_recipe(container=container, items=list(items), **plain)


def _given(options: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in options.items() if value is not None}
