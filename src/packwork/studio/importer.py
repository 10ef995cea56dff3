"""Sources that pages name, as readers name them; what is read of them, and what is offered."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import asdict
from functools import cache
from typing import Any

from packwork.errors import PackworkError, ReadError
from packwork.live.face.offers import (
    FINENESS,
    drawing_of,
    form_fields,
    offered_containers,
    offered_fonts,
    offered_items,
    offered_palettes,
    only_file,
    path_of,
)
from packwork.scene.item import Item
from packwork.studio.files import Uploads
from packwork.studio.workspace import Workspace

FILES = "file:"
"""What stands before the name of a batch of files."""

BUILTIN = "builtin:"
TEXT = "text:"

_FOLDER = re.compile(r"[\\/][0-9a-f]{16}[\\/]?")


class Importer:
    """Reads what pages ask for, in the worker of a workspace; pages name no files of this machine.

    Methods that take ``asked`` raise ReadError where that is neither bundled nor was sent.
    """

    def __init__(self, workspace: Workspace, uploads: Uploads) -> None:
        self._workspace, self._uploads = workspace, uploads

    def read(self, job: Callable[[], object], what: str = "Reading") -> None:
        """Have something read; what is refused names no folder of ours."""

        def read() -> None:
            try:
                job()
            except PackworkError as error:
                raise PackworkError(self.without_folder(str(error))) from error

        self._workspace.work(what, read)

    def source(self, asked: str) -> str:
        """Source of items: a folder of files that were sent, or a bundled name."""
        if asked.startswith(FILES):
            return str(self._uploads.folder(asked.removeprefix(FILES)))
        if asked.startswith(BUILTIN):
            return asked
        raise ReadError(asked[:40], "is neither bundled nor a file that was sent")

    def file(self, asked: str) -> str:
        """The one file of a batch."""
        return str(only_file(self._uploads.folder(asked.removeprefix(FILES))))

    def container(self, asked: str) -> str:
        """Source of a container: as of items, but of one file, or ``text:WORD``."""
        if asked.startswith(FILES):
            return self.file(asked)
        return asked if asked.startswith(TEXT) else self.source(asked)

    def font(self, asked: str | None) -> str | None:
        """A font, of an installed family or a file."""
        if asked is None or asked in offered_fonts():
            return asked
        if asked.startswith(FILES):
            return self.file(asked)
        raise ReadError(asked[:40], "is neither an installed font nor a file that was sent")

    def without_folder(self, text: str) -> str:
        """A line without the folder that nobody knows."""
        return _FOLDER.sub("", text.replace(str(self._uploads.root), ""))


@cache
def choices() -> dict[str, Any]:
    """Bundled containers and items, with pictures, fonts and palettes; made once."""
    containers = [
        {"name": one.name, "path": path_of(one.outline, FINENESS), "box": one.outline.bounds}
        for one in offered_containers()
        if one.outline is not None
    ]
    return {
        "options": [asdict(one) for one in form_fields()],
        "containers": containers,
        "fonts": offered_fonts(),
        "palettes": offered_palettes(),
        "items": [_choice(one.item) for one in offered_items() if one.item is not None],
    }


def _choice(item: Item) -> dict[str, Any]:
    return {"name": item.name, **asdict(drawing_of(item))}
