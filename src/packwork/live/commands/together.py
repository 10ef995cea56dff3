"""Several commands that are one gesture."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from packwork.live.commands.command import Command, Library
from packwork.live.commands.single import SingleCommand
from packwork.live.document import Document


class Together(Command):
    """Do commands one after another, or none of them: one entry of the history."""

    kind: Literal["together"] = "together"
    commands: Annotated[tuple[SingleCommand, ...], Field(min_length=1)]

    def applied(self, document: Document, library: Library) -> Document:
        """The document after all of them."""
        for command in self.commands:
            document = command.applied(document, library)
        return document

    @property
    def steps(self) -> tuple[Command, ...]:
        """The commands."""
        return self.commands

    @property
    def assets(self) -> tuple[str, ...]:
        """Of all of them."""
        return tuple(name for command in self.commands for name in command.assets)
