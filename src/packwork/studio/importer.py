"""Sources that pages name, as readers name them."""

from __future__ import annotations

import re
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

from packwork.errors import PackworkError, ReadError
from packwork.live.face.offers import font_told, offered_fonts, only_file
from packwork.live.face.opening import Opening
from packwork.studio.files import FILES, Uploads
from packwork.studio.view import told_of
from packwork.studio.workspace import Workspace

BUILTIN = "builtin:"
TEXT = "text:"

_FOLDER = re.compile(r"[\\/][0-9a-f]{16}(?:(?P<file>[\\/])|(?!\w))")


class Importer:
    """Reads what pages ask for, in the worker of a workspace; pages name no files of this machine.

    Methods that take ``asked`` raise ReadError where that is neither bundled nor was sent.
    """

    def __init__(self, workspace: Workspace, uploads: Uploads) -> None:
        self._workspace, self._uploads = workspace, uploads
        self._fonts: dict[bytes, str] = {}

    def read(self, job: Callable[[], object], what: str = "Reading") -> None:
        """Have something read; what is refused names no folder of ours."""

        def read() -> None:
            try:
                job()
            except PackworkError as error:
                raise PackworkError(self.without_folder(str(error))) from error

        self._workspace.work(what, read)

    def begin(self, opening: Opening) -> None:
        """Have another document on the desk, and what its run left out of its files told."""
        self._workspace.open_another(opening)
        owner = self._workspace.owner
        if owner is not None and opening.recipe is not None:
            for line in told_of(owner.frame.document.manifest):
                self._workspace.say(self.without_folder(line), is_error=False)

    def folder(self, asked: str) -> Path:
        """Folder of files that were sent."""
        return self._uploads.folder(asked.removeprefix(FILES))

    def source(self, asked: str) -> str:
        """Source of items: a folder of files that were sent, or a bundled name."""
        if asked.startswith(FILES):
            return str(self.folder(asked))
        if asked.startswith(BUILTIN):
            return asked
        raise ReadError(asked[:40], "is neither bundled nor a file that was sent")

    def file(self, asked: str) -> str:
        """The one file of a batch."""
        return str(only_file(self.folder(asked)))

    def container(self, asked: str) -> str:
        """Source of a container: as of items, but of one file, or ``text:WORD``."""
        if asked.startswith(FILES):
            return self.file(asked)
        return asked if asked.startswith(TEXT) else self.source(asked)

    def font(self, asked: str | None) -> str | None:
        """A font, of an installed family, a file, or the words on the desk."""
        if asked is None or asked in offered_fonts():
            return asked
        if asked.startswith(FILES):
            return self.file(asked)
        return self._font_of_words(asked)

    def _font_of_words(self, asked: str) -> str:
        """File of a font that words on the desk have, by the name that pages are told."""
        owner = self._workspace.owner
        items = () if owner is None else owner.frame.document.items
        runs = (run for item in items if item.text is not None for run in item.text.runs)
        font = next((run.font for run in runs if font_told(run.font) == asked), None)
        if font is None or font.index:
            raise ReadError(asked[:40], "is neither an installed font nor a file that was sent")
        key = sha256(font.data).digest()
        if key not in self._fonts:
            batch = self._uploads.new_batch()
            self._uploads.add(batch, asked, font.data)
            self._fonts[key] = self.file(batch)
        return self._fonts[key]

    def without_folder(self, text: str) -> str:
        """A line without the folder that nobody knows."""
        return _FOLDER.sub(
            lambda met: "" if met["file"] else "what was sent",
            text.replace(str(self._uploads.root), ""),
        )
