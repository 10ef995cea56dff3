"""Typer parameters made of fields: type, names, help and default of a flag."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin

import typer
from pydantic import BeforeValidator

from packwork.offers import Offered


def flag(option: Offered, default: Any, *, shown: str | None = None) -> inspect.Parameter:
    """Parameter of a command's signature for one option.

    Parameters
    ----------
    default
        Value if the flag is not given; None leaves the option unset, and gives a switch a form
        that says no. Options that may be given several times are unset in any case.
    shown
        Default as help shows it; None shows ``default``.
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
    """Type of a flag's value: text for options of several types, a list for tuples.

    Examples
    --------
    >>> from packwork.options import offered
    >>> from packwork.recipe import Recipe
    >>> asked = {option.name: option for option in offered(Recipe)}
    >>> typed(asked["seed"]), typed(asked["canvas"]), typed(asked["filler"])
    (<class 'int'>, <class 'str'>, list[str])
    """
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
