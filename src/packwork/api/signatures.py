"""Signatures that list what verbs share, for ``help``, notebooks and the reference."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypedDict, TypeVar

from packwork.options import Offered, Options, Verbs, offered
from packwork.phrasing import in_python
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

    best_of: int
    """Try so many seeds, from ``seed`` on, and keep the best."""

    best_by: str
    """What the best is: coverage, evenness, or a metric of the report, such as ``"-LC_ink"``."""


_UNASKED: Mapping[str, Any] = {
    "y_up": None, "observer": None, "stop": never, "progress": None, "record": False,
    "history": False, "best_of": 1, "best_by": "coverage",
}  # fmt: skip

RUN = [
    inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=_UNASKED[name])
    for name in RunKeywords.__annotations__
]
"""Parameters for :class:`RunKeywords`."""

TAB = 4 * " "

RULES = inspect.Parameter(
    "rules", inspect.Parameter.KEYWORD_ONLY, default=Recipe.model_fields["rules"].default
)
"""Parameter for rules, which command lines do not have."""


def of_verb(verb: Verbs, *more: Offered) -> Callable[[Signed], Signed]:
    """Show what all verbs have, a verb's options, further ones and ``rules`` for ``**options``."""
    listed = (*(option for option in run_options(verb) if option.name != "items"), *more)
    shown = [*RUN, *(_parameter(o, default_of(verb, o)) for o in listed), RULES]
    return _showing(shown, listed)


def of_model(model: type[Options]) -> Callable[[Signed], Signed]:
    """Show the options of a model in place of ``**options``."""
    listed = offered(model)
    return _showing([_parameter(option, option.default) for option in listed], listed)


def _parameter(option: Offered, default: Any) -> inspect.Parameter:
    return inspect.Parameter(option.name, inspect.Parameter.KEYWORD_ONLY, default=default)


def described(text: str, options: Iterable[Offered]) -> str:
    """A docstring with what each option does, before its errors and examples."""
    doc = inspect.cleandoc(text)
    heads = ("Raises\n---", "Examples\n---")
    place = min((doc.find(head) for head in heads if head in doc), default=len(doc))
    lines = ["Other Parameters", "----------------"]
    for option in options:
        said = " ".join(in_python(option.field.description or option.help).split())
        lines += [
            option.name,
            *(TAB + line for line in textwrap.wrap(said, 88, break_on_hyphens=False)),
        ]
    return f"{doc[:place].rstrip()}\n\n{chr(10).join(lines)}\n\n{doc[place:]}"


def _showing(
    parameters: Iterable[inspect.Parameter], described_by: Sequence[Offered]
) -> Callable[[Signed], Signed]:
    def signed(function: Signed) -> Signed:
        own = inspect.signature(function)
        *kept, gathered = own.parameters.values()
        there = {each.name for each in kept}
        # Types as they are written: what Python takes, which validators make the fields' of.
        table = gathered.annotation.removeprefix("Unpack[").removesuffix("]")
        kinds = function.__globals__[table].__annotations__
        added = [
            each.replace(annotation=kinds[each.name].__forward_arg__)
            for each in parameters
            if each.name not in there
        ]
        changed: Any = function
        changed.__doc__ = changed.__doc__ and described(changed.__doc__, described_by)
        changed.__signature__ = own.replace(parameters=[*kept, *added])
        return function

    return signed
