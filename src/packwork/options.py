"""Base of all options: frozen values that refuse unknown keys and say what they mean.

A field is the only place of an option: name, type, bounds, default, docstring and, where it is
offered otherwise than its neighbours, a :class:`packwork.offers.Offer`. Command lines, signatures
in Python, the reference and forms are made of :func:`offered`.
"""

from __future__ import annotations

import ast
import inspect
import linecache
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from typing import Any, ClassVar, Literal, TypeAlias

from pydantic import BaseModel, ConfigDict
from pydantic.fields import FieldInfo

from packwork.offers import NOT_OFFERED, Offer, Offered

SizeMode: TypeAlias = Literal["free", "shared", "fixed"]
"""How sizes of items may vary: each within bounds, all by one factor, or not at all."""


class Options(BaseModel):
    """Options whose descriptions are the docstrings of their fields.

    Pydantic would read the docstrings too, but by tokenising each class in Python; and it would
    build at once what checks each model, also where only the recipe, which holds them all, is
    made. Without sources there are no descriptions.

    Examples
    --------
    >>> from packwork.recipe.piles import PileOptions
    >>> PileOptions.model_fields["compact"].description
    'Report how tight the pile is: shares of its hull, its smallest circle and its box.'
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    offers: ClassVar[Offer] = NOT_OFFERED
    """Group and verbs of fields that have no offer of their own."""

    @classmethod
    def __pydantic_init_subclass__(cls, **settings: Any) -> None:
        """Describe the fields of a new class of options."""
        super().__pydantic_init_subclass__(**settings)
        for name, text in _docstrings(cls.__module__).get(cls.__qualname__, {}).items():
            if name in cls.model_fields:
                cls.model_fields[name].description = text


@cache
def offered(model: type[Options]) -> tuple[Offered, ...]:
    """Options of a model in the order of help: its own fields, then those of its base classes.

    Examples
    --------
    >>> from packwork.recipe.piles import PileOptions
    >>> [option.name for option in offered(PileOptions)]
    ['open', 'size', 'emit', 'release', 'compact']
    """
    classes = [c for c in model.__mro__ if issubclass(c, Options) and c is not Options]
    found = {
        name: _offered(name, model.model_fields[name], owner.offers)
        for owner in classes
        for name in vars(owner).get("__annotations__", {})
        if name in model.model_fields
    }
    listed: list[Offered] = []
    for first in (option for option in found.values() if option.offer.after not in found):
        listed += _with_followers(first, found)
    return tuple(option for option in listed if option.verbs)


def _offered(name: str, field: FieldInfo, common: Offer) -> Offered:
    own = next((said for said in field.metadata if isinstance(said, Offer)), common)
    return Offered(
        name=name,
        field=field,
        offer=replace(
            own,
            group=common.group if own.group is None else own.group,
            verbs=common.verbs if own.verbs is None else own.verbs,
        ),
    )


def _with_followers(option: Offered, found: Mapping[str, Offered]) -> Iterator[Offered]:
    yield option
    for other in found.values():
        if other.offer.after == option.name:
            yield from _with_followers(other, found)


@cache
def _docstrings(module: str) -> dict[str, dict[str, str]]:
    """Docstrings of annotated names, by class and name, of a module."""
    loaded = vars(sys.modules[module])
    source = "".join(linecache.getlines(loaded.get("__file__") or "", loaded))
    classes = (node for node in ast.parse(source).body if isinstance(node, ast.ClassDef))
    return {node.name: dict(_described(node)) for node in classes}


def _described(body: ast.ClassDef) -> list[tuple[str, str]]:
    return [
        (field.target.id, inspect.cleandoc(below.value.value))
        for field, below in zip(body.body, body.body[1:], strict=False)
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name)
        if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant)
        if isinstance(below.value.value, str)
    ]


_WHOLE = re.compile(r"[+-]?[0-9]{1,12}")


def number_or_auto(value: object) -> object:
    """Whole number of a text, or ``auto``; what is no text stays as it is.

    Examples
    --------
    >>> number_or_auto(" 12"), number_or_auto("auto"), number_or_auto(None)
    (12, 'auto', None)
    """
    if not isinstance(value, str) or value == "auto":
        return value
    if not _WHOLE.fullmatch(value.strip()):
        raise ValueError(f"must be a whole number or auto, not {value[:60]!r}")
    return int(value)
