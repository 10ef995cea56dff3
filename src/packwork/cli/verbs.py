"""``packwork fill``, ``words``, ``photos``, ``chart``, ``pile`` and ``run``: what makes layouts."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.errors import RecipeError
from packwork.options import Verbs
from packwork.recipe import Recipe, make_recipe

COLLAGE = Path("collage.svg")
"""File to write where none is named, of ``fill`` and ``run``."""

ABOUT_CONTAINERS = frozenset({"show_saliency"})
"""What ``run`` does not offer: it is for trying containers out."""

ContainerName = Annotated[
    str,
    typer.Argument(
        metavar="CONTAINER",
        help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD (text:ONE|TWO for two "
        "lines), around:IMAGE (its quiet part), a built-in name such as heart, or page "
        "(the whole sheet of --canvas).",
    ),
]

ItemNames = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="ITEM...",
        help="SVGs, pictures, folders of them, globs, or built-in names such as star.",
        show_default="all built-in icons",
    ),
]


def _verb(verb: Verbs, default: Path) -> Callable[[Callable[..., Recipe]], shared.Command]:
    """A command out of a function that makes a recipe of its arguments and options.

    The command has all options of the verb, runs the recipe, and writes ``default`` where no
    file is named.
    """

    def made(make: Callable[..., Recipe]) -> shared.Command:
        @functools.wraps(make)
        def command(**asked: Any) -> None:
            with clear_errors():
                recipe = make(**asked)
                from packwork.cli.running import carry_out

                carry_out(recipe, asked, default)

        return shared.of_verb(verb)(command)

    return made


@_verb(Verbs.FILL, COLLAGE)
def fill(
    container: ContainerName,
    items: ItemNames = None,
    **asked: Any,
) -> Recipe:
    """Fill a container with items.

    [bold]packwork fill heart[/]  the built-in icons in a heart

    [bold]packwork fill bear.png icons/ -n 100 -o bear.svg -o bear.png[/]  your own

    [bold]packwork fill text:HELLO icons/ -n 150[/]  a word to fill

    [bold]packwork fill logo.svg star circle --rotate none --sizes shared[/]
    """
    options = shared.of_run(Verbs.FILL, asked)
    return make_recipe(container=container, items=items or ["builtin:icons"], **options)


@_verb(Verbs.WORDS, Path("words.svg"))
def words(
    container: ContainerName,
    source: Annotated[
        str | None,
        typer.Argument(
            metavar="SOURCE",
            help="A text, a table of word,weight (.csv, .xlsx, .json), or - for standard input.",
        ),
    ] = None,
    **asked: Any,
) -> Recipe:
    """Fill a container with words.

    [bold]packwork words heart speech.txt[/]  its hundred most frequent words

    [bold]packwork words bird.png table.csv --rotate 20 -o bird.svg -o bird.png[/]

    [bold]cat *.md | packwork words circle - -n 200 --rotate mixed[/]

    [bold]packwork words cat ar.txt --font "Noto Naskh Arabic"[/]  any script

    [bold]packwork words cloud --series talks.csv:year -o 'out/{year}.svg' --film talks.gif[/]
    """
    options = shared.of_run(Verbs.WORDS, asked)
    if asked["series"] is not None:
        from packwork.cli.series import carry_out_words

        carry_out_words(container, source, asked, options)
    if source is None:
        raise RecipeError("source", "is missing; give a text, a table, or --series TABLE:COLUMN")
    from packwork.uses.words.recipe import words_recipe

    photos = options.pop("photos")
    return words_recipe(
        container,
        source,
        add=options.pop("items") or [],
        photos={"sources": photos} if photos else None,
        background=asked["background"],
        **options,
    )


@_verb(Verbs.PHOTOS, Path("photos.jpg"))
def photos(
    container: ContainerName,
    sources: Annotated[
        list[str],
        typer.Argument(
            metavar="PHOTO...",
            help="Photos (JPEG, PNG, WebP), folders of them, or patterns. One that is clear in "
            "places is placed as a cut-out.",
        ),
    ],
    **asked: Any,
) -> Recipe:
    """Fill a container with photographs.

    [bold]packwork photos heart holidays/[/]  each photo once, none upside down

    [bold]packwork photos moon *.jpg --canvas 60x40cm --dpi 300 -o poster.jpg[/]  a poster

    [bold]packwork photos cat pets/ --border 4% --padding 1mm --canvas A3 -o cat.pdf[/]

    [bold]packwork photos circle party/ --shape circle --rotate none[/]  round photos
    """
    from packwork.uses.photos.recipe import photos_recipe

    options = shared.of_run(Verbs.PHOTOS, asked)
    return photos_recipe(container, sources, add=options.pop("items") or (), **options)


@_verb(Verbs.CHART, Path("chart.svg"))
def chart(
    container: Annotated[
        str,
        typer.Argument(
            metavar="CONTAINER",
            help="A mask (PNG, JPEG: dark is inside), an SVG, text:WORD, a built-in name such "
            "as heart; or none, for bars of --by.",
        ),
    ],
    data: Annotated[
        str,
        typer.Argument(
            metavar="DATA", help="A table: .csv, .xlsx, .json, or (with pandas) .parquet."
        ),
    ],
    **asked: Any,
) -> Recipe:
    """Show a table's rows, a mark for each, sizes in proportion to numbers.

    [bold]packwork chart circle coffee.csv --size-by kg --label-by country[/]

    [bold]packwork chart heart prizes.csv --color-by category -o prizes.png[/]

    [bold]packwork chart square people.csv --size-by people --unit 1000[/]

    [bold]packwork chart circle coffee.csv --series year --size-by kg --label-by country[/]

    [bold]packwork chart none prizes.csv --by year --by-step 10 --color-by category[/]
    """
    options = shared.of_run(Verbs.CHART, asked)
    if asked["series"] is not None:
        from packwork.cli.series import carry_out_chart

        carry_out_chart(container, data, asked, options)
    from packwork.uses import chart_recipe

    return chart_recipe(container, data, background=asked["background"], **options)


@_verb(Verbs.PILE, Path("pile.svg"))
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
) -> Recipe:
    """Heap items of given sizes, under forces, until they are at rest.

    [bold]packwork pile square icons -n 300 --size 6% --open top[/]  an open bin

    [bold]packwork pile jar.svg icons -n 80[/]  an open path is a jar

    [bold]packwork pile none circle -n 200 --force "towards centre"[/]  a round pack
    """
    from packwork.uses import pile_recipe

    return pile_recipe(container, items or ["builtin:icons"], **shared.of_run(Verbs.PILE, asked))


@shared.of_any_recipe(without=ABOUT_CONTAINERS)
def run(
    recipe: Annotated[
        Path,
        typer.Argument(
            metavar="RECIPE.toml",
            help="Options as a file, count = 100 a line; or a session (.packwork), to go on from.",
        ),
    ],
    allow_code: shared.AllowCode = False,
    **asked: Any,
) -> None:
    """Run a recipe file: the options of [bold]fill[/], kept.

    [bold]packwork fill bear.png icons/ -n 100 --save-recipe bear.toml[/]  writes one

    [bold]packwork run bear.toml -o bear.svg[/]  repeats the run, from any folder

    [bold]packwork run bear.toml --seed 6 -n 80[/]  the same, but for what is given here

    [bold]packwork run work.packwork -o more.svg[/]  goes on from a session
    """
    with clear_errors(recipe), contextlib.ExitStack() as stack:
        from packwork.cli.running import carry_out
        from packwork.readers.layouts.read import is_session
        from packwork.readers.recipe import read_recipe
        from packwork.uses.overriding import overridden

        file = recipe
        if is_session(recipe):
            from packwork.live.file.recipe import recipe_of_session

            if asked["save_recipe"] is not None:
                raise RecipeError(
                    "save_recipe", "a session holds its drawings itself; run a recipe to save one"
                )
            file = stack.enter_context(recipe_of_session(recipe))
        options = read_recipe(file, allow_code=allow_code)
        changes = shared.of_run(Verbs.FILL, asked)
        changes["losses"] = changes["losses"] or None
        if allow_code:
            shared.find_own_modules()
        carry_out(make_recipe(**overridden(options, changes)), asked, COLLAGE)
