"""Names of items and lengths as people write them."""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Iterable, Mapping
from numbers import Integral
from typing import TypeAlias

import numpy as np

from packwork.errors import RecipeError
from packwork.live.document import Document
from packwork.units import length_asked

Which: TypeAlias = str | int | Iterable[str | int]
"""An item: its name, ``owl``, or of several of that name ``owl#2``; ``*`` stands for any letters;
or its number. Where several go, a list or a column of these too."""

Coordinate: TypeAlias = str | float
"""Canvas units, or a length such as ``10mm``; ``45%`` is a share of the canvas' width or height."""

_COPY = re.compile(r"(?P<name>.+)#(?P<copy>[1-9][0-9]{0,5})")


def find_items(document: Document, which: Which) -> tuple[int, ...]:
    """Numbers of the items that a name means, in their order."""
    if isinstance(which, np.ndarray) and which.ndim == 0:
        return find_items(document, which.item())
    is_frame = isinstance(which, bytes | Mapping) or hasattr(which, "columns")
    if is_frame or isinstance(which, bool | np.bool_):
        kind = type(which).__name__
        raise RecipeError("item", f"give a name, a number or a list of these, not a {kind}")
    if isinstance(which, Iterable) and not isinstance(which, str):
        return tuple(dict.fromkeys(k for one in which for k in find_items(document, one)))
    if isinstance(which, Integral):
        if document.index(int(which)) is None:
            numbers = f"{document.ids.min()} to {document.ids.max()}"
            raise RecipeError("item", f"there is no item {which}; numbers go from {numbers}")
        return (int(which),)
    text = str(which)
    names = [item.name for item in document.items]
    copy = None if text in names else _COPY.fullmatch(text)
    pattern = copy["name"] if copy else text
    rows = [k for k, name in enumerate(names) if name == pattern]
    rows = rows or [k for k, name in enumerate(names) if fnmatch.fnmatchcase(name, pattern)]
    if copy:
        rows = rows[int(copy["copy"]) - 1 : int(copy["copy"])]
    if not rows:
        raise RecipeError("item", f"there is no item {text[:40]!r}; {_some(names)}")
    return tuple(int(document.ids[k]) for k in rows)


def one_item(document: Document, which: Which) -> int:
    """Number of the one item that a name means; refused where there is none, or more than one."""
    found = find_items(document, which)
    if len(found) > 1:
        raise RecipeError(
            "item",
            f"{len(found)} items are called {which}; say {which}#1 to {which}#{len(found)}",
        )
    return found[0]


def called(document: Document, k: int) -> str:
    """Name of the item at a place in the document, numbered among others of it: ``owl#2``."""
    names = [item.name for item in document.items]
    name = names[k]
    return name if names.count(name) == 1 else f"{name}#{names[: k + 1].count(name)}"


def length_of(document: Document, key: str, value: Coordinate) -> float:
    """Canvas units of a coordinate, ``x`` or ``y``; one that is written lies on the canvas."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    container, text = document.container, str(value).strip()
    side = container.width if key == "x" else container.height
    try:
        found = float(text)
    except ValueError:
        found = length_asked(key, text, container.unit, side)
    if not 0 <= found <= side:
        extent = f"{side:.6g} {container.unit} {'wide' if key == 'x' else 'high'}"
        raise RecipeError(key, f"{text[:40]} is off the canvas, which is {extent}")
    return found


def _some(names: list[str]) -> str:
    different = list(dict.fromkeys(names))
    more = " ..." if len(different) > 5 else ""
    return f"there are {', '.join(different[:5])}{more}" if different else "the layout is empty"
