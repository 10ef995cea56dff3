"""``packwork run``: what a recipe file asks for."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.cli.fill import DEFAULT_OUTPUT
from packwork.recipe import make_recipe


def run(
    recipe: Annotated[
        Path, typer.Argument(metavar="RECIPE.toml", help="Options as a file, count = 100 a line.")
    ],
    output: shared.Output = None,
    pixels: shared.Pixels = 1_600,
    background: shared.Background = None,
    show_container: shared.ShowContainer = False,
    flatten: shared.Flatten = False,
    text: shared.Text = "outlines",
    report: shared.Report = None,
    diagnose: shared.Diagnose = None,
    quiet: shared.Quiet = False,
) -> None:
    """Run a recipe file: the options of [bold]fill[/], kept.

    [bold]packwork fill bear.png icons/ -n 100 --save-recipe bear.toml[/]  writes one

    [bold]packwork run bear.toml -o bear.svg[/]  repeats the run, from any folder
    """
    with clear_errors(recipe):
        from packwork.cli.running import Outputs, run_and_write
        from packwork.readers.recipe import read_recipe
        from packwork.writers import write_options

        asked = make_recipe(**read_recipe(recipe))
        outputs = Outputs(
            files=output or [DEFAULT_OUTPUT],
            options=write_options(
                pixels=pixels,
                background=background,
                show_container=show_container,
                flatten=flatten,
                text=text,
            ),
            report=report,
            diagnose=diagnose,
        )
        raise typer.Exit(run_and_write(asked, outputs, quiet))
