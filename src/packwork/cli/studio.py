"""``packwork studio``: a page on which a layout flows while it is worked on."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import typer

from packwork.cli.failure import clear_errors
from packwork.errors import RecipeError
from packwork.options import offered
from packwork.recipe import Recipe

_HELP = {option.name: option.help for option in offered(Recipe)}

HERE = frozenset({"127.0.0.1", "::1", "localhost"})
"""Hosts that nobody but this machine can reach."""

Inputs = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="[INPUT]...",
        help="A container, then items, as for fill; or one recipe (.toml), layout (.geojson, "
        ".dxf, .svg of ours) or session (.packwork).",
        show_default="the bundled icons in a heart",
    ),
]


def studio(
    inputs: Inputs = None,
    count: Annotated[
        int | None, typer.Option("-n", "--count", help="How many items in all.", min=1)
    ] = None,
    seed: Annotated[int, typer.Option("--seed", help=_HELP["seed"], min=0)] = 0,
    port: Annotated[
        int, typer.Option("--port", help="Port to listen at; 0 for one that is free.", max=65_535)
    ] = 0,
    again: Annotated[
        bool, typer.Option("--again", help="Go on with what was worked on last.")
    ] = False,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the browser on it.")
    ] = True,
    host: Annotated[
        str, typer.Option("--host", help="Address to listen at; others only with --i-know.")
    ] = "127.0.0.1",
    i_know: Annotated[
        bool,
        typer.Option("--i-know", help="Listen where others can reach it, without encryption."),
    ] = False,
) -> None:
    """Open a page in the browser on which a layout is made by hand.

    [bold]packwork studio[/]  the bundled icons in a heart

    [bold]packwork studio bear.png icons/ -n 80[/]  your own

    [bold]packwork studio work.packwork[/]  a session; also a recipe.toml or a layout.geojson

    [bold]packwork studio --again[/]  what was worked on last, with all that undo leads to

    Needs the extra: pip install "packwork[studio]"
    """
    with clear_errors():
        if host not in HERE and not i_know:
            raise RecipeError(
                "host", f"{host[:60]} lets others reach the studio; add --i-know if that is meant"
            )
        from packwork.display.extras import import_extra

        for module in ("starlette", "uvicorn", "websockets"):
            import_extra(module, "work on the command line")
        from packwork.live.face.opening import Opening, opening_of
        from packwork.studio import kept_workspaces
        from packwork.studio.serving import Address, serve

        if again and (inputs or count is not None):
            raise RecipeError("again", "goes on with what was there; leave all else out")
        opening = opening_of(inputs or [], count, seed=seed)
        kept: kept_workspaces.KeptWorkspace | None
        if again:
            kept = kept_workspaces.last()
            opening = Opening(file=kept.file)
        elif opening.file is not None:
            kept = kept_workspaces.of_file(opening.file)
        else:
            kept = kept_workspaces.new()
            opening = replace(opening, kept_in=None if kept is None else kept.file)
        place = Address(host="127.0.0.1" if host == "localhost" else host, port=port)
        serve(opening, place, kept, browses=browser, tell=typer.echo)
