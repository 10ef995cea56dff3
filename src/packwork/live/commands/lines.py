"""Command that says which lines words follow."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import Annotated, Literal

from pydantic import Field

from packwork.live.commands.command import Command, Library
from packwork.live.document import Document
from packwork.live.file.records import Text
from packwork.metrics.certificate import Promise
from packwork.readers.words.options import Along
from packwork.scene.item import MAX_LENGTH

RingText = Annotated[Text, Field(max_length=MAX_LENGTH)]


class SetLines(Command):
    """Note which lines words were set along, in which colours, and what is promised of their sizes.

    Moves nothing.
    """

    kind: Literal["lines"] = "lines"
    along: Along | None = None
    ring: Annotated[tuple[RingText, ...], Field(max_length=2)] = ()
    palette: RingText | None = None
    areas_in_shares: bool | None = None
    """Whether areas are promised to be in the shares of weights; None for as they were."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document of words on these lines; of others where there are none."""
        said = None
        if self.along is not None or self.ring:
            said = {"along": self.along, "ring": self.ring, "palette": self.palette}
        manifest = {**document.manifest, "lines": said}
        if self.areas_in_shares is not None:
            promise = Promise(document.options.padding, self.areas_in_shares)
            manifest["promised"] = asdict(promise)
        return replace(document, manifest=manifest)
