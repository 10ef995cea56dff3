"""The studio's clipboard: items that a page copies, exactly as they are, and puts in again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from packwork.errors import RecipeError
from packwork.live import edits
from packwork.live.clips import CopiedItems
from packwork.live.commands.command import ItemIds
from packwork.live.session import Session
from packwork.studio.documents import PageRequest

if TYPE_CHECKING:
    from packwork.studio.tab import Tab
    from packwork.studio.workspace import Workspace

Place = Annotated[float, Field(allow_inf_nan=False)]


class Clipboard:
    """Holds what was copied last, whatever document is on the desk."""

    def __init__(self) -> None:
        self._clip: CopiedItems | None = None
        self.token = ""
        """Name that the page which copied has given to what is held; empty for nothing."""

    def copy(self, workspace: Workspace, items: ItemIds, token: str) -> None:
        """Hold items as they are when all that was asked for before is done."""
        self.token = token

        def keep(session: Session) -> None:
            self._clip = edits.copy(session, items)

        workspace.change(keep, "")

    def paste(self, workspace: Workspace, x: float | None, y: float | None) -> None:
        """Put them in."""

        def put(session: Session) -> None:
            if self._clip is None:
                raise RecipeError("paste", "nothing was copied; choose items and copy them")
            edits.paste(session, self._clip, x, y)

        workspace.change(put, "Pasting")


class Copy(PageRequest):
    """Hold items to be pasted."""

    type: Literal["copy"] = "copy"
    items: ItemIds
    token: Annotated[str, Field(max_length=40)]
    """Name of this copy, which all pages are told in ``State.clip``."""

    def act(self, tab: Tab) -> None:
        """Hold them."""
        tab.workspace.clipboard.copy(tab.workspace, self.items, self.token)


class Paste(PageRequest):
    """Put in what was copied."""

    type: Literal["paste"] = "paste"
    x: Place | None = None
    """Of its middle; where it was if None."""
    y: Place | None = None
    """As above, down."""

    def act(self, tab: Tab) -> None:
        """Put it in."""
        tab.workspace.clipboard.paste(tab.workspace, self.x, self.y)
