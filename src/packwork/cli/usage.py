"""Wrong use of the command line: one line, like every other error."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import typer
from typer.core import TyperGroup

from packwork.cli.failure import BAD_INPUT, INTERRUPTED, clear_errors
from packwork.cli.terminal import prepare_streams, say
from packwork.errors import ReadError
from packwork.inputs import noting_inputs
from packwork.synonyms import command_meant, option_meant


class OneLineGroup(TyperGroup):
    """Commands whose usage errors are one line and exit code 2, without a box.

    Ctrl-C before a command begins, while things are still loaded, is one line too.
    """

    def make_context(self, *args: Any, **extra: Any) -> Any:
        """Read the group's own options; see ``click.Command.make_context``."""
        with clear_errors():
            return super().make_context(*args, **extra)

    def invoke(self, ctx: Any) -> Any:
        """Find the command and run it; see ``typer.core.TyperGroup.invoke``.

        What it reads is noted, so that it writes over none of it.
        """
        with clear_errors(), noting_inputs():
            _check_folder()
            return super().invoke(ctx)

    def main(self, *args: Any, **extra: Any) -> Any:
        """Run a command line; see ``typer.core.TyperGroup.main``."""
        run: Any = super().main
        prepare_streams()
        if not extra.pop("standalone_mode", True):
            return run(*args, **extra, standalone_mode=False)
        try:
            code = run(*args, **extra, standalone_mode=False)
        except typer.Abort:
            sys.exit(INTERRUPTED)
        except Exception as error:
            # Typer brings its own copy of click's exceptions or not, by version: those
            # about usage are known by what they can do.
            if not hasattr(error, "format_message"):
                raise
            if type(error).__name__ == "NoArgsIsHelpError":
                typer.echo(error.format_message())
            else:
                say(_line(error))
            sys.exit(BAD_INPUT)
        sys.exit(code or 0)


def _check_folder() -> None:
    """Refuse to run in a folder that has been deleted: no name would lead anywhere."""
    try:
        Path.cwd()
    except OSError:
        raise ReadError(
            "the current folder", "is there no more; go to another one (cd) and try again"
        ) from None


def is_no_flag(command: str, typed: str) -> str | None:
    """The line about an option that only recipe files and Python have; None about any other.

    Examples
    --------
    >>> is_no_flag("fill", "--shades")
    '--shades is no flag; write shades = "nearest" into a recipe (see --save-recipe) or use Python'
    """
    from packwork.recipe.verbs import named, options_of

    verb, name = named(command), typed.lstrip("-").replace("-", "_")
    for option in options_of(verb) if verb else ():
        if option.name == name and not option.offer.is_flag:
            other = next((one for one in option.choices if one != option.default), "...")
            return (
                f'{typed} is no flag; write {name} = "{other}" into a recipe (see --save-recipe) '
                "or use Python"
            )
    return None


def _meant(error: Any, context: Any) -> str | None:
    """Message for an unknown option or command, with the one that may be meant."""
    option = getattr(error, "option_name", None)
    if type(error).__name__ == "NoSuchOption" and option and context is not None:
        if line := is_no_flag(context.command.name, option):
            return line
        names = [
            name for param in context.command.params for name in param.opts if name[:2] == "--"
        ]
        meant = option_meant(option, names)
        return f"no such option: {option}" + (f"; did you mean {meant}?" if meant else "")
    unknown = re.match(r"no such command '([^']*)'", str(error.format_message()), re.IGNORECASE)
    if unknown is None:
        return None
    meant = command_meant(unknown[1])
    return f"no such command '{unknown[1]}'" + (f"; did you mean {meant}?" if meant else "")


def _line(error: Any) -> str:
    """Error in one line, with where to look up what would do."""
    said = " ".join(str(error.format_message()).replace("Value error, ", "").split()).rstrip(".")
    context = getattr(error, "ctx", None)
    said = _meant(error, context) or said
    if type(error).__name__ == "MissingParameter" and context is not None:
        pieces = " ".join(context.command.collect_usage_pieces(context)[1:])
        said = f"{said}; use {context.command_path} {pieces}"
    command = context.command_path if context is not None else "packwork"
    return f"{said[0].lower()}{said[1:]}; see {command} --help"
