"""``packwork pile``: items of given sizes, heaped by forces."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.cli.fill import ItemNames
from packwork.offers import Verbs

DEFAULT_OUTPUT = Path("pile.svg")


@shared.of_verb(Verbs.PILE)
def pile(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG (an open path is a wall with an "
            "opening), text:WORD, a built-in name such as square, page (the whole sheet), or none.",
        ),
    ],
    items: ItemNames = None,
    **asked: Any,
) -> None:
    """Heap items of given sizes, under forces, until they are at rest.

    [bold]packwork pile square icons -n 300 --size 6% --open top[/]  an open bin

    [bold]packwork pile jar.svg icons -n 80[/]  an open path is a jar

    [bold]packwork pile none circle -n 200 --force "towards centre"[/]  a round pack
    """
    with clear_errors():
        from packwork.cli.running import carry_out
        from packwork.uses import pile_recipe

        said = shared.of_run(Verbs.PILE, asked)
        carry_out(pile_recipe(container, items or ["builtin:icons"], **said), asked, DEFAULT_OUTPUT)
