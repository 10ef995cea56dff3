"""``packwork photos``: a collage of photographs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.offers import Verbs

DEFAULT_OUTPUT = Path("photos.jpg")


@shared.of_verb(Verbs.PHOTOS)
def photos(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD, around:IMAGE (its quiet "
            "part), a built-in name such as moon, or page (the whole sheet of --canvas).",
        ),
    ],
    sources: Annotated[
        list[str],
        typer.Argument(
            metavar="PHOTO...",
            help="Photos (JPEG, PNG, WebP), folders of them, or patterns. One that is clear in "
            "places is placed as a cut-out.",
        ),
    ],
    **asked: Any,
) -> None:
    """Fill a container with photographs.

    [bold]packwork photos heart holidays/[/]  each photo once, none upside down

    [bold]packwork photos moon *.jpg --canvas 60x40cm --dpi 300 -o poster.jpg[/]  a poster

    [bold]packwork photos cat pets/ --border 4% --padding 1mm --canvas A3 -o cat.pdf[/]

    [bold]packwork photos circle party/ --shape circle --rotate none[/]  round photos
    """
    with clear_errors():
        from packwork.cli.running import carry_out
        from packwork.uses.photos.recipe import photos_recipe

        said = shared.of_run(Verbs.PHOTOS, asked)
        recipe = photos_recipe(container, sources, add=said.pop("items") or (), **said)
        carry_out(recipe, asked, DEFAULT_OUTPUT)
