"""Values given in Python, under the names by which recipes and readers call them.

A recipe names files. What is in memory has no file: a run puts it on its shelf, under a name such
as ``memory:bear.png``, and readers look there before they look on the disk. So whatever may be a
path may be a value, and nothing has to be handed through.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field

MEMORY = "memory:"
"""Before the name of what is in memory."""

_LONGEST_NAME = 60
_NO_LETTER = re.compile(r"[^\w .()+-]")


@dataclass
class Shelf:
    """Values of one run by name.

    Parameters
    ----------
    values
        Encoded files as ``bytes``, or what a reader understands.
    """

    values: dict[str, object] = field(default_factory=dict)

    def put(self, value: object, name: str, ending: str = "") -> str:
        """Name under which a value is found from now on: a new one, unless it is here already.

        Parameters
        ----------
        ending
            Of a file of such content, as ``.png``.

        Examples
        --------
        >>> shelf = Shelf()
        >>> shelf.put(b"a", "bear", ".svg"), shelf.put(b"b", "bear", ".svg")
        ('memory:bear.svg', 'memory:bear 2.svg')
        """
        plain = _NO_LETTER.sub("_", name).strip(" .")[:_LONGEST_NAME] or "value"
        number = 1
        while True:
            called = f"{MEMORY}{plain}{f' {number}' if number > 1 else ''}{ending}"
            if called not in self.values:
                self.values[called] = value
            if self.values[called] is value:
                return called
            number += 1


_SHELF: ContextVar[Shelf | None] = ContextVar("shelf", default=None)


@contextmanager
def shelf_in_use() -> Iterator[Shelf]:
    """A shelf on which readers look, inside the block, before they look for files.

    What is on the shelf of an outer block is on this one too.

    Examples
    --------
    >>> with shelf_in_use() as shelf:
    ...     shelved(shelf.put(b"<svg/>", "bear", ".svg"))
    b'<svg/>'
    >>> shelved("memory:bear.svg") is None
    True
    """
    outer = _SHELF.get()
    shelf = Shelf({} if outer is None else dict(outer.values))
    before = _SHELF.set(shelf)
    try:
        yield shelf
    finally:
        _SHELF.reset(before)


def shelved(name: str) -> object | None:
    """The value of that name on the shelf in use; None if there is none."""
    shelf = _SHELF.get()
    return None if shelf is None else shelf.values.get(name)
