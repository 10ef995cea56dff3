"""``packwork demo``: a collage of the built-in icons."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.recipe import make_recipe

DEMOS: dict[str, dict[str, object]] = {
    "bear": {"count": 100, "seed": 0},
    "heart": {"count": 100, "seed": 1},
    "dragon": {"count": 140, "seed": 2},
    "islands": {"count": 90, "rotate": "30"},
}
"""Demos with options of their own; every other built-in container is filled with 100."""

NAMES = f"{', '.join(DEMOS)} or another built-in container."


@shared.by_name
def demo(
    name: Annotated[
        str,
        typer.Argument(metavar="[NAME]", help=NAMES),
    ] = "bear",
    folder: Annotated[Path, typer.Option("--folder", help="Where the pictures go.")] = Path("out"),
    *,
    no_clobber: bool,
    quiet: bool,
) -> None:
    """Make a collage of the built-in icons and write it as SVG and PNG.

    [bold]packwork demo[/]  a bear

    [bold]packwork demo dragon --folder pictures[/]
    """
    with clear_errors():
        from packwork.cli.outputs import Outputs
        from packwork.cli.running import run_and_write
        from packwork.writers import write_options

        recipe = make_recipe(container=f"builtin:{name}", **DEMOS.get(name, {"count": 100}))
        files = [folder / f"{name}{ending}" for ending in (".svg", ".png", ".geojson")]
        outputs = Outputs(files=files, options=write_options(), keeps_files=no_clobber)
        raise typer.Exit(run_and_write(recipe, outputs, quiet))
