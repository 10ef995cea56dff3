"""Flags of commands, made of the fields of the models: type, names, help and default."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Collection, Iterable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin

import typer
from pydantic import BeforeValidator

from packwork.cli.files import Choosing, LayoutFiles, Serial, SerialMarks, SideFiles, Terminal
from packwork.offers import Offered, Verbs
from packwork.options import Options, offered
from packwork.recipe import Recipe
from packwork.recipe.verbs import VERBS, WRITTEN, in_groups, options_of, run_options
from packwork.writers.film.options import FilmOptions

Command = Callable[..., None]

AllowCode = Annotated[
    bool,
    typer.Option(
        "--allow-code",
        help="Run code that the recipe names, as losses MODULE:FUNCTION: only if you trust "
        "whoever wrote both.",
    ),
]

FILES: tuple[type[Options], ...] = (
    LayoutFiles,
    Serial,
    SerialMarks,
    Choosing,
    SideFiles,
    Terminal,
)
"""Models of options that only command lines have."""


def of_verb(verb: Verbs) -> Callable[[Command], Command]:
    """Replace a command's ``**asked`` by all options of a verb, with the verb's defaults."""
    chosen = VERBS[verb].defaults
    before = (*offered(LayoutFiles), *offered(Serial), *offered(SerialMarks))
    after = (*offered(Choosing), *offered(SideFiles), *offered(Terminal))
    listed = (*before, *options_of(verb), *after)
    return _with(
        flag(option, chosen[option.name]) if option.name in chosen else _as_it_is(option)
        for option in in_groups(o for o in listed if verb in o.verbs and o.offer.is_flag)
    )


def of_any_recipe(without: Collection[str]) -> Callable[[Command], Command]:
    """Replace a command's ``**asked`` by the options of ``fill``, unset, and all of files."""
    changes = [option for option in offered(Recipe) if Verbs.FILL in option.verbs]
    drawn = [option for model in WRITTEN for option in offered(model)]
    after = (*offered(Choosing), *offered(SideFiles), *offered(Terminal))
    return _with(
        flag(option, None) if option in changes else _as_it_is(option)
        for option in in_groups((*offered(LayoutFiles), *changes, *drawn, *after))
        if option.offer.is_flag and option.name not in without
    )


def by_name(command: Command) -> Command:
    """Make flags of a command's keyword-only parameters, from the fields of the same names."""
    known = {option.name: option for model in (*WRITTEN, *FILES) for option in offered(model)}
    own = inspect.signature(command, eval_str=True)
    parameters = [
        _as_it_is(known[each.name]) if each.kind is each.KEYWORD_ONLY else each
        for each in own.parameters.values()
    ]
    return _signed(command, own.replace(parameters=parameters))


def of_run(verb: Verbs, asked: Mapping[str, Any]) -> dict[str, Any]:
    """The options of a command that its recipe holds, losses as weights by name."""
    names = {option.name for option in run_options(verb)}
    said = {name: value for name, value in asked.items() if name in names}
    if "losses" in said:
        said["losses"] = loss_weights(said["losses"])
    return said


def _with(parameters: Iterable[inspect.Parameter]) -> Callable[[Command], Command]:
    """Replace the last parameter of a signature, ``**asked``, by others."""

    def signed(command: Command) -> Command:
        own = inspect.signature(command, eval_str=True)
        *kept, _ = own.parameters.values()
        return _signed(command, own.replace(parameters=[*kept, *parameters]))

    return signed


def _signed(command: Command, signature: inspect.Signature) -> Command:
    """The function with another signature for Typer to read."""
    changed: Any = command
    changed.__signature__ = signature
    return command


def _as_it_is(option: Offered) -> inspect.Parameter:
    """Flag with the default of the field.

    Options of films are unset, their defaults only shown, since a recipe may have other ones.
    """
    if option in offered(FilmOptions):
        return flag(option, None, shown=_shown(option))
    return flag(option, option.default)


def _shown(option: Offered) -> str:
    """Default of an option as text."""
    if isinstance(option.default, bool):
        yes, _, no = (option.offer.flags or "").replace("--", "").partition("/")
        return yes if option.default else no
    return f"{option.default:g}" if isinstance(option.default, float) else str(option.default)


def loss_weights(losses: list[str] | None) -> dict[str, float]:
    """Losses by name from ``NAME=WEIGHT`` texts; a bare name weighs 1.

    A module of one's own is found in the working folder too, as ``python -m`` finds it.

    Examples
    --------
    >>> loss_weights(["overlap=2", "mine:calm"])
    {'overlap': 2.0, 'mine:calm': 1.0}
    """
    from packwork.errors import RecipeError

    weights = {}
    for text in losses or []:
        name, _, weight = text.partition("=")
        try:
            weights[name] = float(weight or 1)
        except ValueError:
            raise RecipeError("loss", f"use NAME=WEIGHT with a number, not {text!r}") from None
    if any(":" in name for name in weights):
        find_own_modules()
    return weights


def find_own_modules() -> None:
    """Let modules of the working folder be found, after all others."""
    if str(Path.cwd()) not in sys.path:
        sys.path.append(str(Path.cwd()))


def flag(option: Offered, default: Any, *, shown: str | None = None) -> inspect.Parameter:
    """Parameter of a command's signature for one option.

    A ``default`` of None leaves the option unset, and gives a switch a form that says no; options
    that may be given several times are unset in any case. ``shown`` is the default as help shows
    it, if it is not ``default``.
    """
    kind = typed(option)
    if get_origin(kind) is list:
        default = None
    settings: dict[str, Any] = {
        "help": option.help,
        "rich_help_panel": option.offer.group and option.offer.group.value,
        "metavar": option.offer.metavar,
    }
    if kind is float:
        settings["parser"] = _parser(option)
    if shown is not None:
        settings["show_default"] = shown
    return inspect.Parameter(
        option.name,
        inspect.Parameter.KEYWORD_ONLY,
        default=default,
        annotation=Annotated[
            kind | None if default is None else kind,
            typer.Option(*_names(option, kind, default), **settings),
        ],
    )


def typed(option: Offered) -> Any:
    """Type of a flag's value: text for options of several types, a list for tuples."""
    if option.offer.typed is not None:
        return option.offer.typed
    if len(option.forms) > 1:
        return str
    (form,) = option.forms
    if get_origin(form) is tuple:
        return list[Path] if get_args(form)[0] is Path else list[str]
    return form if get_origin(form) in (None, Literal) else str


def _parser(option: Offered) -> Any:
    """Function that reads a number written as a share or the like; None if the field has none."""
    return next((one.func for one in option.checks if isinstance(one, BeforeValidator)), None)


def _names(option: Offered, kind: Any, default: Any) -> list[str]:
    """Names of a flag; a switch that is on or unset by default has a name that says no too."""
    if option.offer.flags is not None:
        return option.offer.flags.split()
    if kind is bool and default is not False:
        return [f"{option.flag}/--no-{option.flag.removeprefix('--')}"]
    return [option.flag]
