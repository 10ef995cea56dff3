"""Signatures that list the options of the fields, for ``help``, notebooks and the reference."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from packwork.offers import Offered, Verbs
from packwork.options import Options, offered
from packwork.recipe import Recipe
from packwork.recipe.verbs import default_of, run_options

Signed = TypeVar("Signed", bound=Callable[..., Any])

RULES = inspect.Parameter(
    "rules", inspect.Parameter.KEYWORD_ONLY, default=Recipe.model_fields["rules"].default
)
"""Parameter for rules, which command lines do not have."""


def of_verb(verb: Verbs, *more: Offered) -> Callable[[Signed], Signed]:
    """Show the options of a verb, further ones and ``rules`` in place of ``**options``."""
    listed = (*(option for option in run_options(verb) if option.name != "items"), *more)
    return _showing([*(_parameter(o, default_of(verb, o)) for o in listed), RULES])


def of_model(model: type[Options]) -> Callable[[Signed], Signed]:
    """Show the options of a model in place of ``**options``."""
    return _showing([_parameter(option, option.default) for option in offered(model)])


def _parameter(option: Offered, default: Any) -> inspect.Parameter:
    return inspect.Parameter(
        option.name,
        inspect.Parameter.KEYWORD_ONLY,
        default=default,
        annotation=option.type,
    )


def _showing(parameters: Iterable[inspect.Parameter]) -> Callable[[Signed], Signed]:
    def signed(function: Signed) -> Signed:
        own = inspect.signature(function)
        kept = {
            name: each for name, each in own.parameters.items() if each.kind != each.VAR_KEYWORD
        }
        added = [each for each in parameters if each.name not in kept]
        changed: Any = function
        changed.__signature__ = own.replace(parameters=[*kept.values(), *added])
        return function

    return signed
