"""Commands that say where a gesture begins and ends; in between it is one entry of the history."""

from __future__ import annotations

from typing import Literal

from packwork.live.commands.command import Command, ItemIds, Library, index_of
from packwork.live.document import Document


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
