"""The commands by name, loaded when one is asked for.

The help of ``packwork`` itself is written from the table below, so that it need not wait for
what the commands import.
"""

from __future__ import annotations

import copy
import importlib
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

import typer
import typer.main
from typer.core import TyperCommand

from packwork.cli.usage import OneLineGroup, is_no_flag
from packwork.synonyms import option_meant

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

ALL = "all"
"""Topic of every option."""

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
    alone.command(cls=HelpfulCommand, context_settings=settings)(function)
    return typer.main.get_command(alone)


class HelpfulCommand(TyperCommand):
    """A command whose ``--help`` may be followed by a topic.

    In its help a bracket is a bracket; of markup it has ``[bold]`` and ``[/]``.
    """

    topic: str | None = None

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the arguments, of which the one after ``--help`` is a topic."""
        before = args[: args.index("--")] if "--" in args else args
        places = [place for place, text in enumerate(before) if text in ctx.help_option_names]
        self.topic = next(iter(before[places[0] + 1 :]), None) if places else None
        if self.topic is not None:
            args = ["--help"]
        rest: list[str] = super().parse_args(ctx, args)
        return rest

    def format_help(self, ctx: Any, formatter: Any) -> None:
        """Write the help."""
        from rich.markup import escape

        shown = copy.copy(self)
        shown.help = _NO_MARKUP.sub(r"\\[", self.help or "")
        if self.topic is None:
            shown.params = _common(self)
            if len(shown.params) < len(self.params):
                shown.epilog = f"More: {ctx.command_path} --help all, or --help and a topic: "
                shown.epilog += ", ".join(topics(self.params)) + ", or an option's name."
        elif self.topic != ALL:
            shown.params = _of_topic(self.params, self.topic, ctx)
            shown.help, shown.add_help_option = "", False
        shown.params = [copy.copy(param) for param in shown.params]
        for param in (p for p in shown.params if getattr(p, "help", None)):
            vars(param)["help"] = escape(vars(param)["help"])
        super(HelpfulCommand, shown).format_help(ctx, formatter)


def topics(params: Sequence[Any]) -> list[str]:
    """Topics of the groups that a command's options stand in, in their order."""
    from packwork.offers import Group

    there = {getattr(param, "rich_help_panel", None) for param in params}
    return [group.topic for group in Group if group.value in there]


def _common(command: HelpfulCommand) -> list[Any]:
    """Arguments and common options; all where the command is no verb."""
    from packwork.recipe.verbs import COMMON, VERBS, named

    verb = named(command.name)
    if verb is None:
        return command.params
    shown = {*COMMON, *VERBS[verb].common}
    return [p for p in command.params if p.param_type_name == "argument" or p.name in shown]


def _of_topic(params: Sequence[Any], topic: str, ctx: Any) -> list[Any]:
    """Options of a group, or one option.

    Raises
    ------
    typer.BadParameter
        If the command has neither.
    """
    from packwork.offers import Group

    group = next((group.value for group in Group if group.topic == topic), None)
    options = [param for param in params if param.param_type_name == "option"]
    found = [param for param in options if group and param.rich_help_panel == group]
    if not found:
        flag = f"--{topic.lstrip('-').replace('_', '-')}"
        found = [p for p in options if {topic, flag} & {*p.opts, *p.secondary_opts}]
    if not found:
        meant = option_meant(topic, [param.name for param in options])
        what_would_do = (
            f"did you mean {meant}?" if meant else f"use {ALL}, " + ", ".join(topics(params))
        )
        line = (
            is_no_flag(ctx.command.name, topic) or f"there is no topic {topic!r}; {what_would_do}"
        )
        raise typer.BadParameter(line, ctx=ctx, param_hint="--help")
    return found


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
