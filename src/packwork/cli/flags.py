"""A field of options as a parameter that Typer makes a flag of."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin

import typer
from pydantic import BeforeValidator

from packwork.offers import Offered


def flag(option: Offered, default: Any, *, shown: str | None = None) -> inspect.Parameter:
    """Parameter of a function that is a command, for one option.

    Parameters
    ----------
    option
        What is offered.
    default
        What counts where nothing is typed; None leaves it open, so that a flag can say no too.
        What may be given several times is always open.
    shown
        What help shows as that; None for the default itself.
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
    """Type of what is typed for an option: where there are several forms, a text tells them apart.

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
    """What reads a number that may be written in other ways, as shares are; None for no such."""
    return next((one.func for one in option.checks if isinstance(one, BeforeValidator)), None)


def _names(option: Offered, kind: Any, default: Any) -> list[str]:
    """Names on the command line; of what is not off by itself, one that says no too."""
    if option.offer.flags is not None:
        return option.offer.flags.split()
    if kind is bool and default is not False:
        return [f"{option.flag}/--no-{option.flag.removeprefix('--')}"]
    return [option.flag]
