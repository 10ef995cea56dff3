"""Commands that say where a gesture begins and ends; in between it is one entry of the history."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from packwork.live.commands.command import Command, ItemIds, Library, index_of
from packwork.live.document import PROPERTIES, Document, Property


class Grab(Command):
    """Take items by the hand: nothing but the hand moves them until they are dropped."""

    kind: Literal["grab"] = "grab"
    items: ItemIds

    def applied(self, document: Document, library: Library) -> Document:
        """The same document."""
        for number in self.items:
            index_of(document, number, "grab")
        return document


class Drop(Command):
    """Let go of what was grabbed."""

    kind: Literal["drop"] = "drop"

    def applied(self, document: Document, library: Library) -> Document:
        """The same document."""
        return document


class Cancel(Command):
    """Let go of what was grabbed, all of it and its neighbours as they were before."""

    kind: Literal["cancel"] = "cancel"

    def applied(self, document: Document, library: Library) -> Document:
        """The same document."""
        return document


class Hold(Command):
    """Hold items: what is held of them, nothing but a command changes."""

    kind: Literal["hold"] = "hold"
    items: ItemIds
    properties: tuple[Property, ...] = PROPERTIES

    def applied(self, document: Document, library: Library) -> Document:
        """The document with more held."""
        return _held(document, self.items, self.properties, is_held=True)


class Release(Command):
    """Let go of items."""

    kind: Literal["release"] = "release"
    items: ItemIds
    properties: tuple[Property, ...] = PROPERTIES

    def applied(self, document: Document, library: Library) -> Document:
        """The document with less held."""
        return _held(document, self.items, self.properties, is_held=False)


def _held(
    document: Document, items: ItemIds, properties: tuple[Property, ...], *, is_held: bool
) -> Document:
    rows = [index_of(document, number, "hold" if is_held else "release") for number in items]
    held = document.held.copy()
    for name in properties:
        held[rows, PROPERTIES.index(name)] = is_held
    return replace(document, held=held)
