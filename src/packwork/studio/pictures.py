"""Messages of a page about pictures that items show, or that lie behind, and words among items."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from packwork.live import edits
from packwork.live.commands.command import Command, made, named_item
from packwork.live.commands.look import Background, SetMosaic
from packwork.live.face.offers import colours_called, colours_of, picture_of, words_to_mix
from packwork.live.macros import mixed
from packwork.live.session import Session
from packwork.scene.item import PhotoArt
from packwork.studio.documents import Font, Name, PageRequest

if TYPE_CHECKING:
    from packwork.studio.tab import Tab

COLOURING = "Colouring"


class Mix(PageRequest):
    """Have words among the other items, with a share of what all cover."""

    type: Literal["mix"] = "mix"
    share: Annotated[float, Field(gt=0, lt=1)]
    source: Name | None = None
    """Of words that come more; None for those that are there."""
    count: Annotated[int, Field(ge=1, le=2_000)] | None = None
    font: Font | None = None
    palette: Annotated[str, Field(max_length=200)] | None = None

    def act(self, tab: Tab) -> None:
        """Read them, and have a run of all."""
        tab.importer.read(partial(self._mix, tab))

    def _mix(self, tab: Tab) -> None:
        importer, workspace = tab.importer, tab.workspace
        read, colours = None, colours_called(self.palette)
        if self.source is not None and workspace.shown is not None:
            font, file = importer.font(self.font), importer.file(self.source)
            options = {"count": self.count, "fonts": None if font is None else [font]}
            read = words_to_mix(workspace.shown.view.container, file, options)
        make = partial(mixed, read=read, share=self.share, colours=colours)
        workspace.pour(0, make, keeps_hand=True)


class Picture(PageRequest):
    """Have a picture shown by the items, its colours on them, or itself behind all."""

    type: Literal["picture"] = "picture"
    source: Name
    purpose: Literal["mosaic", "colours", "behind"] = "mosaic"

    def act(self, tab: Tab) -> None:
        """Read it, and do that; photographs, which keep their colours, are poured anew."""
        tab.importer.read(partial(self._show, tab))

    def _show(self, tab: Tab) -> None:
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
