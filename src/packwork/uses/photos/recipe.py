"""Options of ``photos`` to the recipe of a run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from packwork.options import Verbs
from packwork.readers.photo_options import PhotoOptions
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.refusals import validated
from packwork.recipe.verbs import with_defaults
from packwork.recipe_paths import check_names


def photos_recipe(
    container: str, sources: object, *, add: Sequence[str] = (), **options: Any
) -> Recipe:
    """Recipe that places photographs, from the options of ``photos`` and of all runs alike.

    Raises
    ------
    RecipeError
        Naming the option, what was met and what would do.

    Examples
    --------
    >>> recipe = photos_recipe("heart", ["holidays/"], border="4%")
    >>> recipe.photos.sources, recipe.photos.border_share, recipe.rotate
    (('holidays/',), 0.04, '15')
    """
    said = with_defaults(Verbs.PHOTOS, options)
    own = {key: said.pop(key) for key in list(said) if key in PhotoOptions.model_fields}
    values = {"sources": sources, **own}
    check_names({"photos": values})
    photos = validated(PhotoOptions, values)
    return make_recipe(container=container, items=list(add), **said, photos=photos)
