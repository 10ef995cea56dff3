"""Recipes in Python: files of options, and options as a dict."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from packwork.api.handing import handed_over, with_names
from packwork.api.layout import Layout
from packwork.api.verbs import run_recipe
from packwork.errors import RecipeError
from packwork.progress import Listener, Stop, never
from packwork.readers.layouts.read import is_session
from packwork.readers.recipe import read_recipe
from packwork.recipe import make_recipe
from packwork.uses.overriding import overridden


def run(
    recipe: str | Path | Mapping[str, Any],
    *,
    allow_code: bool = False,
    observer: Listener | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    history: bool | int = False,
    **options: Any,
) -> Layout:
    """Run what a recipe asks for.

    Parameters that :func:`packwork.fill` has too mean the same here.

    Parameters
    ----------
    recipe
        A recipe file (TOML), its options as a dict, what ``layout.manifest["recipe"]`` holds, or
        a session's file (.packwork), from which the run goes on.
    allow_code
        Run code that a recipe file names, as losses ``module:function``: only if you trust
        whoever wrote both.
    options
        In place of the recipe's.

    Raises
    ------
    ReadError
        If a file cannot be used.
    RecipeError
        If an option has no meaning.

    Examples
    --------
    >>> asked = {"container": "circle", "items": ["star"], "epochs": 25, "levels": "50"}
    >>> layout = run(asked, count=3)
    >>> len(layout), run(layout.manifest["recipe"]).metrics == layout.metrics
    (3, True)
    """
    with handed_over() as handed, contextlib.ExitStack() as stack:
        if not isinstance(recipe, Mapping | str | os.PathLike):
            raise RecipeError(
                "recipe", f"is {type(recipe).__name__}; give a recipe file, or options as a dict"
            )
        if isinstance(recipe, Mapping):
            plain = with_names(_said(recipe), handed)
        elif is_session(recipe):
            from packwork.live.file.recipe import recipe_of_session

            plain = read_recipe(stack.enter_context(recipe_of_session(recipe)))
        else:
            plain = read_recipe(recipe, allow_code=allow_code)
        asked = make_recipe(**overridden(plain, with_names(options, handed)))
        return run_recipe(asked, asked.container, observer, stop, progress, record, history)


def _said(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options that are set, in tables too: a manifest lists all."""
    return {
        key: _said(value) if isinstance(value, Mapping) else value
        for key, value in options.items()
        if value is not None
    }
