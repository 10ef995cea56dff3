"""Signatures that list what verbs share, for ``help``, notebooks and the reference."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from typing import Any, TypedDict, TypeVar

from packwork.offers import Offered, Verbs
from packwork.options import Options, offered
from packwork.progress import Listener, Stop, never
from packwork.recipe import Recipe
from packwork.recipe.verbs import default_of, run_options
from packwork.writers.options import DrawingOptions

Signed = TypeVar("Signed", bound=Callable[..., Any])


(BACKGROUND,) = (option for option in offered(DrawingOptions) if option.name == "background")
"""Colours of words and charts are made to be read on it."""


class RunKeywords(TypedDict, total=False):
    """Parameters of all verbs beside their options, which :func:`packwork.fill` describes."""

    y_up: bool | None
    """Whether the y of geometries points up; None: where a frame says its reference system."""

    observer: Listener | None
    """Told of progress."""

    stop: Stop
    """Asked before every epoch; True ends the run with what it has."""

    progress: bool | None
    """True shows a bar, False none; None one in a notebook only."""

    record: bool
    """Keep the way of the items, for ``Layout.save_film``."""

    history: bool | int
    """Keep losses by epoch, in ``layout.history``: of each, or of every so many."""


_UNASKED: Mapping[str, Any] = {
    "y_up": None, "observer": None, "stop": never, "progress": None, "record": False,
    "history": False,
}  # fmt: skip

RUN = [
    inspect.Parameter(
        name,
        inspect.Parameter.KEYWORD_ONLY,
        default=_UNASKED[name],
        annotation=kind.__forward_arg__,  # as it is written
    )
    for name, kind in RunKeywords.__annotations__.items()
]
"""Parameters for :class:`RunKeywords`."""

RULES = inspect.Parameter(
    "rules", inspect.Parameter.KEYWORD_ONLY, default=Recipe.model_fields["rules"].default
)
"""Parameter for rules, which command lines do not have."""


def of_verb(verb: Verbs, *more: Offered) -> Callable[[Signed], Signed]:
    """Show what all verbs have, a verb's options, further ones and ``rules`` for ``**options``."""
    listed = (*(option for option in run_options(verb) if option.name != "items"), *more)
    return _showing([*RUN, *(_parameter(o, default_of(verb, o)) for o in listed), RULES])


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
