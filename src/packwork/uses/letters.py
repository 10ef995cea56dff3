"""Few things in a container of letters: repeated so often that the letters can be read."""

from __future__ import annotations

from collections.abc import Callable

from packwork.readers.options import TEXT_PREFIX
from packwork.recipe import Recipe
from packwork.steps.shortfalls import CLEARLY_MORE

_TOLD = (
    "count", "weights", "hero", "rules", "start", "arrange", "embeddings", "share",
    "target_coverage", "max_items", "smallest", "filler",
)  # fmt: skip


def copies_for_letters(recipe: Recipe, kinds: int, needed: Callable[[], int]) -> int | None:
    """Number of items at which letters of a container can be read; None where each is placed once.

    That is in other containers, of enough ``kinds``, and where a recipe asks for a number, sizes or
    places of items.

    Parameters
    ----------
    needed
        Items for which the container's shape shows; it takes a while.
    """
    if not recipe.container.startswith(TEXT_PREFIX) or recipe.sizes == "fixed":
        return None
    known = Recipe.model_fields
    for key in _TOLD:
        if getattr(recipe, key) != known[key].get_default(call_default_factory=True):
            return None
    total = needed()
    return total if total > CLEARLY_MORE * kinds else None
