"""Types of options in Python, as signatures and the stub for type checkers write them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from packwork.api.inputs import COLOURS, CONTAINERS, ITEMS, PICTURES, VECTORS
from packwork.options import Offered, Verbs
from packwork.recipe.rules import Pin, Rule

TABLES = {Pin: "PinTable", Rule: "RuleTable"}
"""Tables of a recipe, by what their types are called in Python."""

RULES = "Sequence[RuleTable]"
"""Type of the rules about single items."""

OF_PYTHON = {
    **dict.fromkeys(COLOURS, "Colours | None"),
    "seed": "Generator | int | None",
    "weights": "str | Path | Mapping[str, float] | Cells | None",
}
"""Types of options that take values of NumPy, pandas and Matplotlib."""

COLUMNS = ("size_by", "color_by", "mark_by", "label_by", "by")
"""Options of charts that name columns, or are the cells of one."""


def kind_of_option(option: Offered, verb: Verbs | None, imports: set[str]) -> str:
    """Type of what Python may give for an option of a verb, as it is written.

    ``imports`` gathers the statements that its names need.

    Examples
    --------
    >>> from packwork.options import offered
    >>> from packwork.recipe import Recipe
    >>> asked, imports = {option.name: option for option in offered(Recipe)}, set()
    >>> kind_of_option(asked["seed"], Verbs.FILL, imports), sorted(imports)[0]
    ('Generator | int | None', 'from numpy.random import Generator')
    """
    if verb is Verbs.CHART and option.name in COLUMNS:
        return "Cells | None"
    return kind_of(option.name, option.field, option.offer.takes, imports)


def kind_of(name: str, field: Any, takes: Any, imports: set[str]) -> str:
    """Type of what Python may give for a field, or that which ``takes`` says."""
    if name == "start":
        imports.add("from packwork.scene.layout import Layout")
        imports.add("from packwork.scene.pose import Poses")
        return "str | Path | Layout | Poses | None"
    if name in OF_PYTHON:
        imports.add("from numpy.random import Generator")
        imports.add("from packwork.api.plain import Cells, Colours")
        return OF_PYTHON[name]
    if name in (*PICTURES, *VECTORS):
        imports.add("from packwork.readers.memory.values import Value")
        return "Value | None"
    if name in (*ITEMS, *CONTAINERS):
        imports.add("from packwork.readers.memory.values import Value")
        more = {"region": "Sequence[str | float] | ", "shape": ""}.get(name, "Iterable[Value] | ")
        return f"Value | {more}None"
    kinds = list(dict.fromkeys(_spelt(field.annotation if takes is None else takes, imports)))
    if "str" not in kinds:
        # A text would be a sequence of texts, of one letter each.
        kinds = [
            kind.replace("Sequence", many)
            for kind in kinds
            for many in (("list", "tuple") if kind.startswith("Sequence[str") else ("Sequence",))
        ]
    return " | ".join(kind.replace("tuple[str]", "tuple[str, ...]") for kind in kinds)


def _spelt(kind: Any, imports: set[str]) -> list[str]:
    """Alternatives of a type as they are written; of containers what is read of them."""
    origin, inner = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _spelt(inner[0], imports)
    if origin in (Union, UnionType):
        return [said for part in inner for said in _spelt(part, imports)]
    if origin is Literal:
        return [f"Literal[{', '.join(map(repr, inner))}]"]
    if origin is tuple:
        return _spelt_tuple(inner, imports)
    if origin is dict or origin is Mapping:
        return _spelt_mapping(inner, imports)
    if origin is Callable:
        return [_spelt_function(inner, imports)]
    if origin is not None:
        name = "AbstractSet" if origin.__name__ == "Set" else origin.__name__
        return [f"{name}[{', '.join(' | '.join(_spelt(part, imports)) for part in inner)}]"]
    return [_spelt_name(kind, imports)]


def _spelt_tuple(inner: tuple[Any, ...], imports: set[str]) -> list[str]:
    each = [" | ".join(_spelt(part, imports)) for part in inner if part is not Ellipsis]
    if Ellipsis in inner:
        return [f"Sequence[{each[0]}]"]
    return [f"list[{' | '.join(dict.fromkeys(each))}]", f"tuple[{', '.join(each)}]"]


def _spelt_mapping(inner: tuple[Any, Any], imports: set[str]) -> list[str]:
    keys = _spelt(inner[0], imports)
    # Keys of a Mapping are invariant: one of texts alone would be refused where both may be.
    key = keys[0] if len(keys) == 1 else "Any"
    return [f"Mapping[{key}, {' | '.join(_spelt(inner[1], imports))}]"]


def _spelt_function(inner: tuple[Any, Any], imports: set[str]) -> str:
    *taken, given = inner
    several = taken[0] if isinstance(taken[0], list) else taken
    said = (
        "..." if several == [Ellipsis] else f"[{', '.join(_spelt(t, imports)[0] for t in several)}]"
    )
    return f"Callable[{said}, {' | '.join(_spelt(given, imports))}]"


def _spelt_name(kind: Any, imports: set[str]) -> str:
    if kind is NoneType or kind is None:
        return "None"
    if kind is Any:
        return "Any"
    if kind in TABLES:
        return TABLES[kind]
    if issubclass(kind, BaseModel):
        return "Mapping[str, Any]"
    if kind.__module__ not in ("builtins", "pathlib"):
        imports.add(f"from {kind.__module__} import {kind.__name__}")
    return str(kind.__name__)
