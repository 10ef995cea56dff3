"""Options of films, of a recipe and of the call that writes one."""

from __future__ import annotations

from typing import Any

from packwork.recipe.refusals import validated
from packwork.writers.film.options import FilmOptions


def film_options(recipes: FilmOptions | None = None, /, **given: Any) -> FilmOptions:
    """Options of a film: those given, then the recipe's, then the defaults.

    Parameters
    ----------
    recipes
        What the recipe says; None if nothing.
    given
        Options by name; None is as good as not given.

    Raises
    ------
    RecipeError
        Naming the option, what was met and what would do.

    Examples
    --------
    >>> film_options(FilmOptions(fps=12, hold=3), fps=60, hold=None)
    FilmOptions(fps=60.0, seconds=5.0, hold=3.0, loop=True, easing='smooth', film_pixels=800)
    >>> film_options(film_pixels=0)
    Traceback (most recent call last):
        ...
    packwork.errors.RecipeError: film_pixels: must be at least 16, not 0
    """
    known = {} if recipes is None else recipes.model_dump(exclude_unset=True)
    said = {key: value for key, value in given.items() if value is not None}
    return validated(FilmOptions, known | said)
