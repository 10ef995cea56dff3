"""``packwork demo``: a collage of the built-in icons, to see what this is."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.recipe import make_recipe

DEMOS: dict[str, dict[str, object]] = {
    "bear": {"container": "bear", "count": 120, "seed": 3},
    "heart": {"container": "heart", "count": 100, "seed": 1},
    "dragon": {"container": "dragon", "count": 120, "seed": 2},
    "islands": {"container": "islands", "count": 90, "rotate": "30"},
}


def demo(
    name: Annotated[
        str, typer.Argument(metavar="[NAME]", help=f"One of {', '.join(DEMOS)}.")
    ] = "bear",
    folder: Annotated[Path, typer.Option("--folder", help="Where the pictures go.")] = Path("out"),
    quiet: shared.Quiet = False,
) -> None:
    """Make a collage of the built-in icons and write it as SVG and PNG.

    [bold]packwork demo[/]  a bear

    [bold]packwork demo dragon --folder pictures[/]
    """
    with clear_errors():
        from packwork.cli.running import run_and_write
        from packwork.errors import RecipeError
        from packwork.writers import write_options

        if name not in DEMOS:
            raise RecipeError("demo", f"there are {', '.join(DEMOS)}, not {name!r}")
        outputs = [folder / f"{name}{ending}" for ending in (".svg", ".png", ".geojson")]
        raise typer.Exit(
            run_and_write(make_recipe(**DEMOS[name]), outputs, write_options(), quiet=quiet)
        )
