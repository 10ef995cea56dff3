"""Command that says which lines words follow."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Literal

from pydantic import Field

from packwork.live.commands.command import Command, Library
from packwork.live.document import Document
from packwork.live.file.records import Text
from packwork.readers.words.options import Along
from packwork.scene.item import MAX_LENGTH

RingText = Annotated[Text, Field(max_length=MAX_LENGTH)]


class SetLines(Command):
    """Note which lines words were set along, and in which colours; moves nothing."""

    kind: Literal["lines"] = "lines"
    along: Along | None = None
    ring: Annotated[tuple[RingText, ...], Field(max_length=2)] = ()
    palette: RingText | None = None

    def applied(self, document: Document, library: Library) -> Document:
        """The document of words on these lines; of others where there are none."""
        said = None
        if self.along is not None or self.ring:
            said = {"along": self.along, "ring": self.ring, "palette": self.palette}
        return replace(document, manifest={**document.manifest, "lines": said})
