"""Messages of a page that fill the container with others, or put all anew in some way.

By pictures too, which items show or which lie behind, and with words among items.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import Field

from packwork.live import edits
from packwork.live.commands.command import Command, made, named_item
from packwork.live.commands.look import Background, SetMosaic
from packwork.live.face.offers import colours_called, colours_of, picture_of, words_to_mix
from packwork.live.kinds import LineWay
from packwork.live.macros import mixed
from packwork.live.relayout import BY_TEXT
from packwork.live.session import Session
from packwork.scene.item import PhotoArt
from packwork.studio.documents import Font, Name, ReadRequest
from packwork.studio.files import FILES

if TYPE_CHECKING:
    from packwork.studio.tab import Tab

Weight: TypeAlias = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Ring: TypeAlias = Annotated[
    tuple[Annotated[str, Field(min_length=1, max_length=200)], ...], Field(max_length=2)
]


class Fill(ReadRequest):
    """Fill the container with other items, all of those there taken away."""

    doing = "Pouring"
    type: Literal["fill"] = "fill"
    use: Literal["items", "words", "photos"]
    source: Name
    count: Annotated[int, Field(ge=1, le=2_000)] | None = None
    font: Font | None = None
    """Of words, as of a container."""
    palette: Annotated[str, Field(max_length=200)] | None = None
    """Of words."""
    without: Annotated[tuple[Name, ...], Field(max_length=500)] = ()
    """Words of a text that are left out."""
    along: LineWay | None = None
    """Lines that words follow."""
    ring: Ring = ()
    """Texts round the edge of the container, words within."""

    def read(self, tab: Tab) -> None:
        """Have a run of what is read."""
        importer, options = tab.importer, dict[str, Any](count=self.count)
        source = importer.source(self.source)
        if self.use == "words":
            source = importer.file(self.source) if self.source.startswith(FILES) else source
            options |= {"font": importer.font(self.font), "palette": self.palette}
            options |= {"along": self.along, "ring": self.ring}
            # One list, with a comma at the end: none of its words is taken for a file.
            options["stopwords"] = ",".join((*self.without, "")) if self.without else None
        tab.workspace.fill(self.use, source, options)


class Order(ReadRequest):
    """Put all anew in an order along a way; no measure of a file, which a page cannot name."""

    doing = "Pouring"
    type: Literal["order"] = "order"
    way: Literal["right", "left", "down", "up", "outwards", "inwards", "around", "along"]
    by: Literal["weight", "hue", "lightness", "name"]

    def read(self, tab: Tab) -> None:
        """Have a run."""
        tab.workspace.pour_now({"arrange": f"{self.way} by={self.by}"})


class Alike(ReadRequest):
    """Put all anew, like items side by side, by vectors in a file that was sent before."""

    doing = "Pouring"
    type: Literal["alike"] = "alike"
    source: Name
    """The file, or ``auto``: of words, by their text."""

    def read(self, tab: Tab) -> None:
        """Have a run."""
        source = self.source if self.source == BY_TEXT else tab.importer.file(self.source)
        tab.workspace.pour_now({"embeddings": source})


class Words(ReadRequest):
    """Have these words with these weights; those that stay keep their places."""

    doing = "Setting words"
    type: Literal["words"] = "words"
    words: Annotated[tuple[tuple[Name, Weight], ...], Field(min_length=1, max_length=2_000)]
    font: Font | None = None

    def read(self, tab: Tab) -> None:
        """Set them, and change those that are others."""
        font = tab.importer.font(self.font)
        options = {} if font is None else {"fonts": [font]}
        words = dict(self.words)
        shown = tab.workspace.shown
        if shown is not None and shown.view.kind.name == "lines":
            tab.workspace.pour_now({"words": words, "font": font})
            return
        tab.workspace.change(lambda session: edits.words(session, words, **options), self.doing)


class Lines(ReadRequest):
    """Have the words that there are follow other lines, or none."""

    doing = "Setting words"
    type: Literal["lines"] = "lines"
    along: LineWay | None = None
    ring: Ring = ()
    font: Font | None = None

    def read(self, tab: Tab) -> None:
        """Set them anew."""
        font = tab.importer.font(self.font)
        tab.workspace.pour_now({"along": self.along, "ring": self.ring, "font": font})


COLOURING = "Colouring"


class Mix(ReadRequest):
    """Have words among the other items, with a share of what all cover."""

    type: Literal["mix"] = "mix"
    share: Annotated[float, Field(gt=0, lt=1)]
    source: Name | None = None
    """Of words that come more; None for those that are there."""
    count: Annotated[int, Field(ge=1, le=2_000)] | None = None
    font: Font | None = None
    palette: Annotated[str, Field(max_length=200)] | None = None

    def read(self, tab: Tab) -> None:
        """Read them, and have a run of all."""
        importer, workspace = tab.importer, tab.workspace
        read, colours = None, colours_called(self.palette)
        if self.source is not None and workspace.shown is not None:
            font, file = importer.font(self.font), importer.file(self.source)
            options = {"count": self.count, "fonts": None if font is None else [font]}
            read = words_to_mix(workspace.shown.view.container, file, options)
        make = partial(mixed, read=read, share=self.share, colours=colours)
        workspace.pour(0, make, keeps_hand=True)


class Picture(ReadRequest):
    """Have a picture shown by the items, its colours on them, or itself behind all."""

    type: Literal["picture"] = "picture"
    source: Name
    purpose: Literal["mosaic", "colours", "behind"] = "mosaic"

    def read(self, tab: Tab) -> None:
        """Read it, and do that; photographs, which keep their colours, are poured anew."""
        workspace, file = tab.workspace, tab.importer.file(self.source)
        if self.purpose == "colours":
            colours = colours_of(file)
            workspace.change(lambda session: edits.palette(session, colours), COLOURING)
            return
        # Read here: the session's thread has the hand to follow.
        is_behind = self.purpose == "behind"
        picture = picture_of(file, is_behind=is_behind)

        def make(session: Session) -> list[Command]:
            asset = named_item(session.library, picture)
            return [made(Background if is_behind else SetMosaic, asset=asset)]

        items = workspace.shown.view.items if workspace.shown else ()
        is_album = bool(items) and all(isinstance(item.art, PhotoArt) for item in items)
        if is_album and not is_behind:
            workspace.pour(0, make)
        else:
            workspace.change(lambda session: session.do_together(make(session)), COLOURING)
