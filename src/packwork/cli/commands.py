"""The commands by name, loaded when one is asked for.

The help of ``packwork`` itself is written from the table below, so that it need not wait for
what the commands import.
"""

from __future__ import annotations

import copy
import importlib
import re
from collections.abc import Iterator, Mapping
from typing import Any, Final

import typer.main
from typer.core import TyperCommand

from packwork.cli.usage import OneLineGroup

SUMMARIES: Mapping[str, str] = {
    "fill": "Fill a container with items.",
    "words": "Fill a container with words.",
    "chart": "Show a table's rows, a mark for each, sizes in proportion to numbers.",
    "photos": "Fill a container with photographs.",
    "pile": "Heap items of given sizes, under forces, until they are at rest.",
    "run": "Run a recipe file: the options of [bold]fill[/], kept.",
    "batch": "Run a recipe for each row of a table, on all cores.",
    "edit": "Change a saved layout here and there; the rest makes room, certified again.",
    "studio": "Open a page in the browser on which a layout is made by hand.",
    "measure": "Measure a saved layout: coverage, overlap, what sticks out, evenness, gaps.",
    "demo": "Make a collage of the built-in icons and write it as SVG and PNG.",
    "bench": "Run a benchmark of a checkout of the project and print its table.",
}
"""What stands in the help, in its order: for each command the first line of its docstring."""

MARKUP: Final = "rich"

_NO_MARKUP = re.compile(r"\[(?!/?(?:bold)?\])")


class Commands(Mapping[str, Any]):
    """Commands by name; each is the function of its name in the module of its name."""

    def __init__(self) -> None:
        self._loaded: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        """Load a command, once."""
        if name not in SUMMARIES:
            raise KeyError(name)
        if name not in self._loaded:
            self._loaded[name] = _load(name)
        return self._loaded[name]

    def __iter__(self) -> Iterator[str]:
        return iter(SUMMARIES)

    def __len__(self) -> int:
        return len(SUMMARIES)


def _load(name: str) -> Any:
    function = getattr(importlib.import_module(f"packwork.cli.{name}"), name)
    alone = typer.Typer(add_completion=False, rich_markup_mode=MARKUP)
    # What a benchmark's script is given is its own.
    settings = {"ignore_unknown_options": name == "bench"}
    alone.command(cls=PlainCommand, context_settings=settings)(function)
    return typer.main.get_command(alone)


class PlainCommand(TyperCommand):
    """A command in whose help a bracket is a bracket; of markup it has ``[bold]`` and ``[/]``."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help."""
        from rich.markup import escape

        shown = copy.copy(self)
        shown.help = _NO_MARKUP.sub(r"\\[", self.help or "")
        shown.params = [copy.copy(param) for param in self.params]
        for param in (p for p in shown.params if getattr(p, "help", None)):
            vars(param)["help"] = escape(vars(param)["help"])
        super(PlainCommand, shown).format_help(ctx, formatter)


class LazyGroup(OneLineGroup):
    """All commands; its own help and errors load none of them."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**{**settings, "commands": None})
        self.commands: Any = Commands()

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help, of commands what the table says."""
        shown = copy.copy(self)
        shown.commands = {
            name: TyperCommand(name, help=summary, rich_markup_mode=MARKUP)
            for name, summary in SUMMARIES.items()
        }
        super(LazyGroup, shown).format_help(ctx, formatter)
