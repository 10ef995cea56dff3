"""``packwork chart``: a unit chart."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from packwork.cli import options as shared
from packwork.cli.failure import clear_errors
from packwork.offers import Verbs

DEFAULT_OUTPUT = Path("chart.svg")


@shared.of_verb(Verbs.CHART)
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
            metavar="DATA", help="A table: .csv, .tsv, .json, or (with pandas) .parquet."
        ),
    ],
    **asked: Any,
) -> None:
    """Show a table's rows, a mark for each, sizes in proportion to numbers.

    [bold]packwork chart circle coffee.csv --size-by kg --label-by country[/]

    [bold]packwork chart heart prizes.csv --color-by category -o prizes.png[/]

    [bold]packwork chart square people.csv --size-by people --unit 1000[/]

    [bold]packwork chart circle coffee.csv --series year --size-by kg --label-by country[/]

    [bold]packwork chart none prizes.csv --by year --by-step 10 --color-by category[/]
    """
    with clear_errors():
        from packwork.cli.running import carry_out
        from packwork.uses import chart_recipe

        said = shared.of_run(Verbs.CHART, asked)
        if asked["series"] is not None:
            from packwork.cli.series import carry_out_chart

            carry_out_chart(container, data, asked, said)
        recipe = chart_recipe(container, data, background=asked["background"], **said)
        carry_out(recipe, asked, DEFAULT_OUTPUT)
