"""``packwork run``: what a recipe file asks for."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated, Any, get_args

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.cli.fill import DEFAULT_OUTPUT, fill
from packwork.cli.terminal import say
from packwork.recipe import Recipe, make_recipe
from packwork.recipe_paths import files_outside

MOST_NAMED = 5
"""Files outside a recipe's folder that are named. Chosen."""

NOT_CHANGED = frozenset({"container", "items", "film"})
"""What makes a recipe that recipe, for whoever wants others writes another one; and films, whose
options ``run`` has anyway."""


def _changes() -> Iterator[inspect.Parameter]:
    """Options of ``fill`` that a recipe holds: not given, they are as it says."""
    for name, parameter in inspect.signature(fill, eval_str=True).parameters.items():
        if name in NOT_CHANGED or not (name in Recipe.model_fields or name == "loss"):
            continue
        kind, option = get_args(parameter.annotation)
        if kind is bool:
            flag = name.replace("_", "-")
            option = shared.flag(name, f"--{flag}/--no-{flag}", panel=option.rich_help_panel)
        yield parameter.replace(
            default=None,
            annotation=Annotated[kind | None, option],
            kind=inspect.Parameter.KEYWORD_ONLY,
        )


def _with_changes(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command an option for each that may be changed: its ``**changes``."""
    own = inspect.signature(command, eval_str=True)
    *kept, _ = own.parameters.values()
    signed: Any = command
    signed.__signature__ = own.replace(parameters=[*kept, *_changes()])
    return command


@_with_changes
def run(
    recipe: Annotated[
        Path, typer.Argument(metavar="RECIPE.toml", help="Options as a file, count = 100 a line.")
    ],
    output: shared.Output = None,
    allow_code: Annotated[
        bool,
        typer.Option(
            "--allow-code",
            help="Run code that the recipe names, as losses MODULE:FUNCTION: only if you trust "
            "whoever wrote both.",
        ),
    ] = False,
    pixels: shared.Pixels = 1_600,
    dpi: shared.Dpi = None,
    background: shared.Background = None,
    halo: shared.Halo = "none",
    show_container: shared.ShowContainer = False,
    flatten: shared.Flatten = False,
    text: shared.Text = "outlines",
    cut: shared.Cut = None,
    kiss_cut: shared.KissCut = None,
    bleed: shared.Bleed = None,
    film: shared.Film = None,
    fps: shared.Fps = None,
    seconds: shared.Seconds = None,
    hold: shared.Hold = None,
    loop: shared.Loop = None,
    easing: shared.Easing = None,
    film_pixels: shared.FilmPixels = None,
    report: shared.Report = None,
    diagnose: shared.Diagnose = None,
    save_recipe: shared.SaveRecipe = None,
    no_clobber: shared.NoClobber = False,
    quiet: shared.Quiet = False,
    **changes: Any,
) -> None:
    """Run a recipe file: the options of [bold]fill[/], kept.

    [bold]packwork fill bear.png icons/ -n 100 --save-recipe bear.toml[/]  writes one

    [bold]packwork run bear.toml -o bear.svg[/]  repeats the run, from any folder

    [bold]packwork run bear.toml --seed 6 -n 80[/]  the same, but for what is given here
    """
    with clear_errors(recipe):
        from packwork.cli.running import outputs_asked, run_and_write
        from packwork.pipeline.overriding import overridden
        from packwork.readers.recipe import read_recipe

        options = read_recipe(recipe, allow_code=allow_code)
        outside = files_outside(options, [recipe.parent, Path.cwd()])
        if outside:
            named = ", ".join(outside[:MOST_NAMED]) + (" ..." if outside[MOST_NAMED:] else "")
            say(f"{recipe} reads files outside its folder: {named}")
        losses = changes.pop("loss", None)
        changes["losses"] = shared.loss_weights(losses) if losses else None
        if allow_code:
            shared.find_own_modules()
        asked = make_recipe(**overridden(options, changes))
        outputs = outputs_asked(
            output or [DEFAULT_OUTPUT], report=report, diagnose=diagnose, recipe=save_recipe,
            pixels=pixels, dpi=dpi, background=background, halo=halo,
            show_container=show_container, flatten=flatten,
            text=text, film=film, fps=fps, seconds=seconds, hold=hold, loop=loop, easing=easing,
            film_pixels=film_pixels, recipes=asked.film, no_clobber=no_clobber,
            cut=cut, kiss_cut=kiss_cut, bleed=bleed,
        )  # fmt: skip
        raise typer.Exit(run_and_write(asked, outputs, quiet))
