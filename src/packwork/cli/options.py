"""Flags of commands, made of the fields of the models: type, names, help and default.

Some options only command lines have: names of files, and what is printed.
"""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Callable, Collection, Iterable, Mapping
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin

import typer
from pydantic import BeforeValidator, Field

from packwork.options import Group, Offer, Offered, Options, Verbs, offered
from packwork.recipe import Recipe
from packwork.recipe.refusals import validated
from packwork.recipe.verbs import VERBS, WRITTEN, in_groups, options_of, run_options
from packwork.writers.film.options import FilmOptions


class LayoutFiles(Options):
    """Layouts and films to write."""

    offers = Offer(group=Group.WRITTEN, verbs=Verbs.EVERY)

    output: Annotated[tuple[Path, ...], Offer(flags="-o --output")] = ()
    """File to write; the ending (.svg, .png, .jpg, .webp, .tif, .pdf, .dxf, .geojson, or
    .packwork, a session to go on from) picks the format. May be given several times."""

    film: Annotated[tuple[Path, ...], Offer(group=Group.FILM)] = ()
    """Film of the run to write; the ending (.svg, .gif, .webp, .mp4, .webm, .json for
    Lottie) picks the format. May be given several times."""


class SideFiles(Options):
    """Further files to write, and whether files may be replaced."""

    offers = Offer(group=Group.WRITTEN, verbs=Verbs.EVERY)

    show_saliency: Annotated[Path | None, Offer(verbs=Verbs.COLLAGES)] = None
    """Write a picture (PNG) of what was found of a container around:IMAGE: what stands out red, a
    line round what is filled."""

    report: Path | None = None
    """Write measures and times as JSON."""

    diagnose: Path | None = None
    """Write the diagnostic picture (PNG): container yellow, items grey, overlap red, what sticks
    out blue."""

    preflight: Annotated[bool, Offer(group=Group.PRINTED)] = False
    """Print what a print shop looks at in each PDF and SVG: resolution of pictures, thin lines,
    small text, transparency, what ends near the trim, colours that are no inks."""

    save_recipe: Path | None = None
    """Write the recipe (TOML) that repeats this run."""

    no_clobber: bool = False
    """Keep files that are there already: refuse to run if one is to be written."""


class Choosing(Options):
    """Number of runs to choose from."""

    offers = Offer(group=Group.SOLVED, verbs=Verbs.EVERY)

    best_of: Annotated[int, Field(ge=1, le=10_000)] = 1
    """Try so many seeds, from --seed on, on all cores, and keep the best."""

    best_by: str = "coverage"
    """What the best of several is: coverage, evenness, or a metric of the report such as LC_ink,
    with a minus where less is better."""

    contact_sheet: Annotated[Path | None, Offer(group=Group.WRITTEN)] = None
    """Write a picture (PNG) of all that --best-of has tried, the best first, or of all steps of a
    series."""


class Serial(Options):
    """A layout for each step of a table."""

    offers = Offer(group=Group.PLACED, verbs=Verbs.WORDS)

    series: Annotated[str | None, Offer(metavar="TABLE:COLUMN")] = None
    """Table of words and its column of steps, as talks.csv:year, in place of SOURCE: a layout for
    each step, all on one scale, words in their places for as long as goes."""


class SerialMarks(Options):
    """A chart for each step of a table."""

    offers = Offer(group=Group.MARKS, verbs=Verbs.CHART)

    series: Annotated[str | None, Offer(metavar="COLUMN")] = None
    """Column of steps, as year: a chart for each, all at one scale, marks of one name in their
    places for as long as goes. --by-step takes so many numbers together."""


class Terminal(Options):
    """Output on the terminal."""

    offers = Offer(verbs=Verbs.EVERY)

    quiet: Annotated[bool, Offer(flags="-q --quiet")] = False
    """Print nothing but warnings and errors; advice on what came of a run is in --report."""


_HALVES = re.compile(r"\d+,[1-9]|[1-9]\d*,[27]5")
"""Halves and quarters of degrees with a comma, as most of Europe writes them."""

Command = Callable[..., None]
AnyOptions = TypeVar("AnyOptions", bound=Options)

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


def of_models(
    *models: type[Options], without: Collection[str] = ()
) -> Callable[[Command], Command]:
    """Replace a command's ``**asked`` by the options of some models."""
    listed = [option for model in models for option in offered(model)]
    return _with(_as_it_is(option) for option in listed if option.name not in without)


def part_of(model: type[AnyOptions], asked: Mapping[str, Any]) -> AnyOptions:
    """Options of one model, of all that a command was asked for."""
    given = {name: asked[name] for name in model.model_fields if asked[name] is not None}
    return validated(model, given)


def of_run(verb: Verbs, asked: Mapping[str, Any]) -> dict[str, Any]:
    """The options of a command that its recipe holds, losses as weights by name."""
    names = {option.name for option in run_options(verb)}
    said = {name: value for name, value in asked.items() if name in names}
    if "losses" in said:
        said["losses"] = loss_weights(said["losses"])
    if said.get("rotate") is not None:
        said["rotate"] = typed_rotation(said["rotate"])
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


@cache
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


def typed_rotation(text: str) -> str:
    """The same text as it was typed, refused where its comma may be that of a decimal.

    What is stored, or said in Python, has its meaning already.

    Examples
    --------
    >>> typed_rotation("0,90"), typed_rotation("22,5,")
    ('0,90', '22,5,')
    """
    from packwork.errors import RecipeError

    plain = text.strip()
    if _HALVES.fullmatch(plain) is None:
        return text
    number = plain.replace(",", ".")
    raise RecipeError(
        "rotate",
        f"{plain} may be {number} degrees or two angles; write {number}, or {plain}, with a comma "
        "at the end for both",
    )


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
