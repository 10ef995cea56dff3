"""``packwork words``: a word cloud."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
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
        str,
        typer.Argument(
            metavar="SOURCE",
            help="A text, a table of word,weight (.csv, .tsv, .json), or - for standard input.",
        ),
    ],
    **asked: Any,
) -> None:
    """Fill a container with words.

    [bold]packwork words heart speech.txt[/]  its hundred most frequent words

    [bold]packwork words bird.png table.csv --rotate 20 -o bird.svg -o bird.png[/]

    [bold]cat *.md | packwork words circle - -n 200 --rotate mixed[/]

    [bold]packwork words cat ar.txt --font "Noto Naskh Arabic"[/]  any script
    """
    with clear_errors():
        from packwork.cli.running import carry_out
        from packwork.uses.words.recipe import words_recipe

        said = shared.of_run(Verbs.WORDS, asked)
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
