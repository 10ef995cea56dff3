"""``packwork run``: what a recipe file asks for."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.cli.fill import DEFAULT_OUTPUT
from packwork.cli.terminal import say
from packwork.offers import Verbs
from packwork.recipe import make_recipe
from packwork.recipe_paths import files_outside

MOST_NAMED = 5
"""Files outside a recipe's folder that are named. Chosen."""

ABOUT_CONTAINERS = frozenset({"show_saliency"})
"""What ``run`` does not offer: it is for trying containers out."""


@shared.of_any_recipe(without=ABOUT_CONTAINERS)
def run(
    recipe: Annotated[
        Path, typer.Argument(metavar="RECIPE.toml", help="Options as a file, count = 100 a line.")
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
    """
    with clear_errors(recipe):
        from packwork.cli.running import carry_out
        from packwork.readers.recipe import read_recipe
        from packwork.uses.overriding import overridden

        options = read_recipe(recipe, allow_code=allow_code)
        outside = files_outside(options, [recipe.parent, Path.cwd()])
        if outside:
            named = ", ".join(outside[:MOST_NAMED]) + (" ..." if outside[MOST_NAMED:] else "")
            say(f"{recipe} reads files outside its folder: {named}")
        changes = shared.of_run(Verbs.FILL, asked)
        changes["losses"] = changes["losses"] or None
        if allow_code:
            shared.find_own_modules()
        carry_out(make_recipe(**overridden(options, changes)), asked, DEFAULT_OUTPUT)
