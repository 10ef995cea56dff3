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
    film: shared.Film = None,
    fps: shared.Fps = None,
    seconds: shared.Seconds = None,
    hold: shared.Hold = None,
    loop: shared.Loop = None,
    easing: shared.Easing = None,
    film_pixels: shared.FilmPixels = None,
    report: shared.Report = None,
    diagnose: shared.Diagnose = None,
    quiet: shared.Quiet = False,
) -> None:
    """Run a recipe file: the options of [bold]fill[/], kept.

    [bold]packwork fill bear.png icons/ -n 100 --save-recipe bear.toml[/]  writes one

    [bold]packwork run bear.toml -o bear.svg[/]  repeats the run, from any folder
    """
    with clear_errors(recipe):
        from packwork.cli.running import outputs_asked, run_and_write
        from packwork.readers.recipe import read_recipe

        asked = make_recipe(**read_recipe(recipe))
        outputs = outputs_asked(
            output or [DEFAULT_OUTPUT], report=report, diagnose=diagnose,
            pixels=pixels, background=background, show_container=show_container, flatten=flatten,
            text=text, film=film, fps=fps, seconds=seconds, hold=hold, loop=loop, easing=easing,
            film_pixels=film_pixels, recipes=asked.film,
        )  # fmt: skip
        raise typer.Exit(run_and_write(asked, outputs, quiet))
