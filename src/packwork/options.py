"""What all options are: frozen values that refuse unknown keys and say what they mean."""

from __future__ import annotations

import ast
import inspect
import linecache
import re
import sys
from functools import cache
from typing import Any

from pydantic import BaseModel, ConfigDict


class Options(BaseModel):
    """Options whose descriptions are the docstrings of their fields.

    Pydantic would read them too, but by tokenising each class in Python; and it would build at
    once what checks each model, also where only the recipe, which holds them all, is made.
    Without sources there are no descriptions.

    Examples
    --------
    >>> from packwork.piles import PileOptions
    >>> PileOptions.model_fields["compact"].description
    'Report how tight the pile is: shares of its hull, its smallest circle and its box.'
    """

    model_config = ConfigDict(frozen=True, extra="forbid", defer_build=True)

    @classmethod
    def __pydantic_init_subclass__(cls, **settings: Any) -> None:
        """Describe the fields of a new class of options."""
        super().__pydantic_init_subclass__(**settings)
        for name, text in _docstrings(cls.__module__).get(cls.__qualname__, {}).items():
            if name in cls.model_fields:
                cls.model_fields[name].description = text


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

    Raises
    ------
    ValueError
        If the text is neither.

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
