"""The commands by name, loaded when one is asked for; wrong use of them in one line.

The help of ``packwork`` itself is written from the table below, so that it need not wait for
what the commands import.
"""

from __future__ import annotations

import copy
import importlib
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import typer
import typer.main
from typer.core import TyperCommand, TyperGroup

from packwork.cli.failure import BAD_INPUT, INTERRUPTED, clear_errors, comma_hint
from packwork.cli.terminal import prepare_streams, say
from packwork.errors import ReadError
from packwork.sources import noting_inputs
from packwork.synonyms import command_meant, option_meant

SUMMARIES: Mapping[str, str] = {
    "fill": "Fill a container with items.",
    "words": "Fill a container with words.",
    "chart": "Show a table's rows, a mark for each, sizes in proportion to numbers.",
    "photos": "Fill a container with photographs.",
    "pile": "Heap items of given sizes, under forces, until they are at rest.",
    "nest": "Nest parts of true size on as few sheets and as little of the last one as possible.",
    "run": "Run a recipe file: the options of [bold]fill[/], kept.",
    "batch": "Run a recipe for each row of a table, on all cores.",
    "edit": "Change a saved layout here and there; the rest makes room, certified again.",
    "studio": "Open a page in the browser on which a layout is made by hand.",
    "measure": "Measure a saved layout: coverage, overlap, what sticks out, evenness, gaps.",
    "inkscape": "Put three extensions into Inkscape: fill a shape, words in one, nest.",
    "demo": "Make a collage of the built-in icons and write it as SVG and PNG.",
    "bench": "Run a benchmark of a checkout of the project and print its table.",
}
"""What stands in the help, in its order: for each command the first line of its docstring."""

IN_VERBS = frozenset({"fill", "words", "chart", "photos", "pile", "run"})
"""Commands of the module ``verbs``; each other one has a module of its name."""

MARKUP: Final = "rich"

ALL = "all"
"""Topic of every option."""

ONCE: Mapping[str, str] = {
    "hero": "there is one hero; others are larger by rules of a recipe, or by weights",
    "palette": "write all its colours in one list, as red,#457b9d",
}
"""Options of which a second one would replace the first, though it looks like one more."""

_NO_MARKUP = re.compile(r"\[(?!/?(?:bold)?\])")


class Commands(Mapping[str, Any]):
    """Commands by name; each is the function of its name."""

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
    module = "verbs" if name in IN_VERBS else name
    function = getattr(importlib.import_module(f"packwork.cli.{module}"), name)
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
    typed: Mapping[str, Any] = MappingProxyType({})

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the arguments, of which the one after ``--help`` is a topic."""
        before = args[: args.index("--")] if "--" in args else args
        places = [place for place, text in enumerate(before) if text in ctx.help_option_names]
        self.topic = next(iter(before[places[0] + 1 :]), None) if places else None
        if self.topic is not None:
            args = ["--help"]
        self.typed, _, given = self.make_parser(ctx).parse_args(args=list(args))
        for param in dict.fromkeys(given):
            if param.name in ONCE and given.count(param) > 1:
                line = f"is given twice; {ONCE[param.name]}"
                raise typer.BadParameter(line, ctx=ctx, param_hint=param.opts[-1])
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
            shown.params = _of_topic(self, self.topic)
            if not shown.params:
                line = _no_topic(self, self.topic)
                raise typer.BadParameter(line, ctx=ctx, param_hint="--help")
            shown.help, shown.add_help_option = "", False
        shown.params = [copy.copy(param) for param in shown.params]
        for param in (p for p in shown.params if getattr(p, "help", None)):
            vars(param)["help"] = escape(vars(param)["help"])
        super(HelpfulCommand, shown).format_help(ctx, formatter)


def topics(params: Sequence[Any]) -> list[str]:
    """Topics of the groups that a command's options stand in, in their order."""
    from packwork.options import Group

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


def _of_topic(command: Any, topic: str) -> list[Any]:
    """Options of a group, or one option; none if the command has neither."""
    from packwork.options import Group
    from packwork.recipe.verbs import named, options_of

    options = [param for param in command.params if param.param_type_name == "option"]
    group = next((group for group in Group if group.topic == topic), None)
    if group is not None:
        verb = named(command.name)
        also = {one.name for one in (options_of(verb) if verb else ()) if one.offer.also is group}
        found = [p for p in options if p.rich_help_panel == group.value or p.name in also]
        if found:
            return found
    flag = f"--{topic.lstrip('-').replace('_', '-')}"
    return [p for p in options if {topic, flag} & {*p.opts, *p.secondary_opts}]


def _no_topic(command: Any, topic: str) -> str:
    """Message about what is neither a topic nor an option, with what would do."""
    line = is_no_flag(command.name, topic)
    if line is not None:
        return line
    meant = option_meant(
        topic, [param.name for param in command.params if param.param_type_name == "option"]
    )
    known = f"use {ALL}, " + ", ".join(topics(command.params))
    return f"there is no topic {topic!r}; " + (f"did you mean {meant}?" if meant else known)


class LazyGroup(TyperGroup):
    """All commands; its own help and errors load none of them.

    Usage errors are one line and exit code 2, without a box; Ctrl-C before a command begins,
    while things are still loaded, is one line too.
    """

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

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the arguments; what follows ``--help`` is a command, or a topic of one."""
        if len(args) > 1 and args[0] in ctx.help_option_names:
            named, *topics_of_it = args[1:]
            if named in SUMMARIES:
                args = [named, "--help", *topics_of_it]
            else:
                args = [self._command_with(named), "--help", named]
        rest: list[str] = super().parse_args(ctx, args)
        return rest

    def _command_with(self, topic: str) -> str:
        """The first command whose help has a topic; ``fill``, which says so, if there is none."""
        commands = ((name, self.commands[name]) for name in SUMMARIES)
        return next((name for name, one in commands if _of_topic(one, topic)), "fill")

    def make_context(self, *args: Any, **extra: Any) -> Any:
        """Read the group's own options; see ``click.Command.make_context``."""
        with clear_errors():
            return super().make_context(*args, **extra)

    def invoke(self, ctx: Any) -> Any:
        """Find the command and run it; see ``typer.core.TyperGroup.invoke``.

        What it reads is noted, so that it writes over none of it.
        """
        with clear_errors(), noting_inputs():
            # Refuse to run in a folder that has been deleted: no name would lead anywhere.
            try:
                Path.cwd()
            except OSError:
                raise ReadError(
                    "the current folder", "is there no more; go to another one (cd) and try again"
                ) from None
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
    typed = getattr(getattr(context, "command", None), "typed", {})
    met = typed.get(getattr(getattr(error, "param", None), "name", None))
    if "Input should" in said and isinstance(met, str):
        # Only a line that is wrong loads the words.
        from packwork.recipe.refusals import plain_words

        said = f"{plain_words(said)}, not {met[:60]!r}"
    if type(error).__name__ == "MissingParameter" and context is not None:
        pieces = " ".join(context.command.collect_usage_pieces(context)[1:])
        said = f"{said}; use {context.command_path} {pieces}"
    command = context.command_path if context is not None else "packwork"
    return f"{said[0].lower()}{said[1:]}{comma_hint(said)}; see {command} --help"
