"""``packwork run``: what a recipe file asks for."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.cli.fill import DEFAULT_OUTPUT
from packwork.errors import RecipeError
from packwork.offers import Verbs
from packwork.recipe import make_recipe

ABOUT_CONTAINERS = frozenset({"show_saliency"})
"""What ``run`` does not offer: it is for trying containers out."""


@shared.of_any_recipe(without=ABOUT_CONTAINERS)
def run(
    recipe: Annotated[
        Path,
        typer.Argument(
            metavar="RECIPE.toml",
            help="Options as a file, count = 100 a line; or a session (.packwork), to go on from.",
        ),
    ],
    allow_code: Annotated[
        bool,
        typer.Option(
            "--allow-code",
            help="Run code that the recipe names, as losses MODULE:FUNCTION: only if you trust "
            "whoever wrote both.",
        ),
    ] = False,
    **asked: Any,
) -> None:
    """Run a recipe file: the options of [bold]fill[/], kept.

    [bold]packwork fill bear.png icons/ -n 100 --save-recipe bear.toml[/]  writes one

    [bold]packwork run bear.toml -o bear.svg[/]  repeats the run, from any folder

    [bold]packwork run bear.toml --seed 6 -n 80[/]  the same, but for what is given here

    [bold]packwork run work.packwork -o more.svg[/]  goes on from a session
    """
    with clear_errors(recipe), contextlib.ExitStack() as stack:
        from packwork.cli.running import carry_out
        from packwork.readers.layouts.read import is_session
        from packwork.readers.recipe import read_recipe
        from packwork.uses.overriding import overridden

        file = recipe
        if is_session(recipe):
            from packwork.live.file.recipe import recipe_of_session

            if asked["save_recipe"] is not None:
                raise RecipeError(
                    "save_recipe", "a session holds its drawings itself; run a recipe to save one"
                )
            file = stack.enter_context(recipe_of_session(recipe))
        options = read_recipe(file, allow_code=allow_code)
        changes = shared.of_run(Verbs.FILL, asked)
        changes["losses"] = changes["losses"] or None
        if allow_code:
            shared.find_own_modules()
        carry_out(make_recipe(**overridden(options, changes)), asked, DEFAULT_OUTPUT)
