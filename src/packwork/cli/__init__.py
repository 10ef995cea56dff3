"""The command line: parse, call the pipeline, show. One file per command.

No command is imported here, so that ``packwork --help`` answers at once.
"""

from __future__ import annotations

import logging

import typer

from packwork.cli.commands import MARKUP, LazyGroup
from packwork.cli.start_up import START_UP as START_UP  # its import reads the clock
from packwork.cli.terminal import NOTICES

app = typer.Typer(
    name="packwork",
    cls=LazyGroup,
    help="Arrange shapes so that they fill a container of any form.\n\n"
    "Try [bold]packwork demo[/] first, then [bold]packwork fill heart your-icons/[/].",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=MARKUP,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib import metadata

        typer.echo(f"packwork {metadata.version('packwork')}")
        raise typer.Exit


@app.callback()
def _main(
    version: bool = typer.Option(
        False, "--version", callback=_version, is_eager=True, help="Show the version and stop."
    ),
) -> None:
    logging.getLogger("packwork").addHandler(NOTICES)
    from packwork.temporary import clear_away

    clear_away()
