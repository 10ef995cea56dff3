"""``packwork fill``: a container filled with items."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.offers import Verbs
from packwork.recipe import make_recipe

DEFAULT_OUTPUT = Path("collage.svg")

ItemNames = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="ITEM...",
        help="SVGs, pictures, folders of them, globs, or built-in names such as star.",
        show_default="all built-in icons",
    ),
]


@shared.of_verb(Verbs.FILL)
def fill(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD (text:ONE|TWO for two "
            "lines), around:IMAGE (its quiet part), a built-in name such as heart, or page "
            "(the whole sheet of --canvas).",
        ),
    ],
    items: ItemNames = None,
    **asked: Any,
) -> None:
    """Fill a container with items.

    [bold]packwork fill heart[/]  the built-in icons in a heart

    [bold]packwork fill bear.png icons/ -n 100 -o bear.svg -o bear.png[/]  your own

    [bold]packwork fill text:HELLO icons/ -n 150[/]  a word to fill

    [bold]packwork fill logo.svg star circle --rotate none --sizes shared[/]
    """
    with clear_errors():
        recipe = make_recipe(
            container=container,
            items=items or ["builtin:icons"],
            **shared.of_run(Verbs.FILL, asked),
        )
        from packwork.cli.running import carry_out

        carry_out(recipe, asked, DEFAULT_OUTPUT)
