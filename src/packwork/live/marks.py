"""Marks of a session beside the document: what has been done to which items."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any


@dataclass
class Marks:
    """Numbers of items that gestures have done something to, and how much was polished.

    Parameters
    ----------
    touched
        To be finished by the next settle.
    given
        Of these, what lies where the hand has put it.
    turned
        Of these, what has the angle that the hand has given it.
    left
        What lay beside items before the hand took them away.
    by_hand
        Put somewhere or turned by hand since the last leap: polish leaves its angle.
    lately
        Of these, since the last settle but one: polish leaves it where it is.
    rough
        Settled, yet not polished.
    polished
        How many times polish was called: the seed of what it tries.
    tried
        Turns that were tried since anything became rough.
    """

    touched: set[int] = field(default_factory=set)
    given: set[int] = field(default_factory=set)
    turned: set[int] = field(default_factory=set)
    left: set[int] = field(default_factory=set)
    by_hand: set[int] = field(default_factory=set)
    lately: set[int] = field(default_factory=set)
    rough: set[int] = field(default_factory=set)
    polished: int = 0
    tried: int = 0

    def copy(self) -> Marks:
        """The same, to be gone back to."""
        columns: dict[str, Any] = {one.name: getattr(self, one.name) for one in fields(self)}
        columns |= {k: set(v) for k, v in columns.items() if isinstance(v, set)}
        return Marks(**columns)

    def settled(self) -> None:
        """Forget what was to be settled."""
        for kept in (self.touched, self.given, self.turned, self.left):
            kept.clear()

    def leapt(self) -> None:
        """Forget all items: the document is another one."""
        for column in fields(self):
            value = getattr(self, column.name)
            if isinstance(value, set):
                value.clear()

    def keep(self, present: set[int]) -> None:
        """Forget items that are no more."""
        for column in fields(self):
            value = getattr(self, column.name)
            if isinstance(value, set):
                value &= present
