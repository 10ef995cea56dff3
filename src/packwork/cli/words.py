"""``packwork words``: a word cloud."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.errors import RecipeError
from packwork.offers import Verbs

DEFAULT_OUTPUT = Path("words.svg")


@shared.of_verb(Verbs.WORDS)
def words(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD, around:IMAGE (its quiet "
            "part), a built-in name such as heart, or page (the whole sheet of --canvas).",
        ),
    ],
    source: Annotated[
        str | None,
        typer.Argument(
            metavar="SOURCE",
            help="A text, a table of word,weight (.csv, .tsv, .json), or - for standard input.",
        ),
    ] = None,
    **asked: Any,
) -> None:
    """Fill a container with words.

    [bold]packwork words heart speech.txt[/]  its hundred most frequent words

    [bold]packwork words bird.png table.csv --rotate 20 -o bird.svg -o bird.png[/]

    [bold]cat *.md | packwork words circle - -n 200 --rotate mixed[/]

    [bold]packwork words cat ar.txt --font "Noto Naskh Arabic"[/]  any script

    [bold]packwork words cloud --series talks.csv:year -o 'out/{year}.svg' --film talks.gif[/]
    """
    with clear_errors():
        said = shared.of_run(Verbs.WORDS, asked)
        if asked["series"] is not None:
            from packwork.cli.series import carry_out_words

            carry_out_words(container, source, asked, said)
        if source is None:
            raise RecipeError(
                "source", "is missing; give a text, a table, or --series TABLE:COLUMN"
            )
        from packwork.cli.running import carry_out
        from packwork.uses.words.recipe import words_recipe

        photos = said.pop("photos")
        recipe = words_recipe(
            container,
            source,
            add=said.pop("items") or [],
            photos={"sources": photos} if photos else None,
            background=asked["background"],
            **said,
        )
        carry_out(recipe, asked, DEFAULT_OUTPUT)
