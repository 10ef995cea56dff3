"""Edits as ``packwork edit`` takes them: an item, ``=`` and what is asked of it."""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, cast

from packwork.errors import RecipeError

if TYPE_CHECKING:
    from packwork.live.document import Property
    from packwork.live.named import NamedSession
    from packwork.scene.item import Item

_FORMS = {
    "remove": "ITEM", "hold": "ITEM or ITEM=place,angle,size", "replace": "ITEM=FILE",
    "recolor": "ITEM=COLOR", "exchange": "ITEM=ITEM",
    "turn": "ITEM=DEGREES", "scale": "ITEM=FACTOR", "move": "ITEM=X,Y such as owl=50%,120",
}  # fmt: skip

_OF_MANY = frozenset({"remove", "hold", "recolor"})
"""Edits of all items of a name."""


def planned(session: NamedSession, flag: str, spec: str) -> Callable[[], None]:
    """Edit that one option asks for, of items that are there now."""
    which, sign, value = _parted(session, spec)
    if flag not in {"remove", "hold"} and not (sign and which and value):
        raise RecipeError(flag, f"must be {_FORMS[flag]}, not {spec[:60]!r}")
    if sign and (flag == "remove" or not value):
        raise RecipeError(flag, f"must be {_FORMS[flag]}, not {spec[:60]!r}")
    with about(flag):
        numbers = session.find(which) if flag in _OF_MANY else (session.one(which),)
        others = (session.one(value),) if flag == "exchange" else ()

    def make() -> None:
        with about(flag):
            _made(session, flag, numbers, value, others)

    return make


def _parted(session: NamedSession, spec: str) -> tuple[str, str, str]:
    """An item's name, ``=`` and what is asked of it; names may hold such signs too."""
    names = {item.name for item in session.document.items}
    ends = [k for k, letter in enumerate(spec) if letter == "="]
    for end in (len(spec), *reversed(ends)):
        which = spec[:end].strip()
        if re.sub("#[0-9]+$", "", which) in names:
            return which, spec[end : end + 1], spec[end + 1 :].strip()
    which, sign, value = spec.partition("=")
    return which.strip(), sign, value.strip()


def _made(
    session: NamedSession, flag: str, items: tuple[int, ...], value: str, others: tuple[int, ...]
) -> None:
    """Make one edit, of one item but where several go."""
    item = items[0]
    if flag == "move":
        x, comma, y = value.partition(",")
        if not comma:
            raise RecipeError(flag, f"must be {_FORMS[flag]}, not {value[:40]!r}")
        session.move(item, x, y)
    elif flag == "hold":
        ends = [end.strip() for end in value.split(",") if end]
        session.hold(items, *cast("list[Property]", ends))
    elif flag == "exchange":
        session.exchange(item, *others)
    elif flag == "remove":
        session.remove(items)
    elif flag in {"turn", "scale"}:
        getattr(session, flag)(item, _number(flag, value))
    elif flag == "replace":
        found = read_drawings([value])
        if len(found) != 1:
            raise RecipeError(flag, f"takes one item, not {len(found)}")
        session.replace_by(item, found[0])
    else:
        session.recolor(items, value)


def _number(flag: str, text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise RecipeError(flag, f"must be a number, not {text[:40]!r}")
    return number


def added(session: NamedSession, spec: str) -> None:
    """Bring what ``FILE`` or ``FILE@X,Y`` names."""
    source, sign, place = spec.rpartition("@")
    x, comma, y = place.partition(",")
    if sign and source and comma and not Path(spec).exists():
        session.add_items(read_drawings([source]), x, y)
    else:
        session.add_items(read_drawings([spec]))


def read_drawings(sources: list[str]) -> Sequence[Item]:
    """Items of files, folders and built-in names."""
    from packwork.readers.items import read_items

    return read_items(sources).items


@contextlib.contextmanager
def about(flag: str) -> Iterator[None]:
    """Have errors be about the flag that people have typed."""
    try:
        yield
    except RecipeError as error:
        raise RecipeError(flag, error.problem) from error
