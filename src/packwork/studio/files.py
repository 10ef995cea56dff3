"""Files of a page: those that it sends, in a private folder, and those that are made for it.

And what pages name, as readers name it.
"""

from __future__ import annotations

import asyncio
import re
import secrets
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from typing import Any

from packwork.errors import PackworkError, ReadError, RecipeError
from packwork.live.face.exporting import (
    FILM_FORMATS,
    FORMATS,
    RECIPE,
    SESSION,
    check,
    film_of,
    kept_bytes,
    layout_bytes,
    recipe_zip,
)
from packwork.live.face.offers import font_told, offered_fonts, only_file
from packwork.live.face.opening import Opening
from packwork.studio.view import told_of
from packwork.studio.workspace import NOT_YET, Workspace
from packwork.temporary import TemporaryFolder

MOST_BYTES = 64_000_000
"""Size of one file at most. Chosen: more than readers take of drawings."""

MOST_BYTES_IN_ALL = 1_000_000_000
"""Size of all files at most. Chosen."""

MOST_FILES = 2_000
"""Files at most. Chosen."""

FILES = "file:"
"""What stands before the name of a batch of files."""

LONGEST_NAME = 200
"""Bytes of a file's name at most: systems take 255, and a number may be added. Derived."""

_NO_LETTER = re.compile(r"[^\w .()+-]")
_BATCH = re.compile(r"[0-9a-f]{16}")


class Uploads:
    """Files in folders of their own, gone when the studio closes."""

    def __init__(self) -> None:
        self._folder = TemporaryFolder("studio")
        self._files, self._bytes = 0, 0

    def close(self) -> None:
        """Remove all files."""
        self._folder.close()

    def new_batch(self) -> str:
        """Name of an empty batch, which nobody can guess."""
        name = secrets.token_hex(8)
        (self.root / name).mkdir()
        return name

    @property
    def root(self) -> Path:
        """Folder of the batches."""
        return self._folder.path

    def folder(self, batch: str) -> Path:
        """Folder of a batch."""
        if not _BATCH.fullmatch(batch) or not (self.root / batch).is_dir():
            raise ReadError("files", "there are no such files; drop them again")
        return self.root / batch

    def add(self, batch: str, name: str, data: bytes) -> None:
        """Keep a file under its own name, or one like it."""
        shown = name[:60]
        if len(data) > MOST_BYTES:
            raise ReadError(shown, f"is larger than {MOST_BYTES / 1e6:g} MB")
        if self._files >= MOST_FILES or self._bytes + len(data) > MOST_BYTES_IN_ALL:
            raise ReadError(shown, f"is one too many; {MOST_FILES} files or 1 GB are the most")
        self._files += 1
        self._bytes += len(data)
        _free(self.folder(batch), safe_name(name)).write_bytes(data)


def safe_name(name: str) -> str:
    """File name without folders and signs that mean something to a system.

    Examples
    --------
    >>> safe_name("../../etc/pass<wd>.svg"), safe_name("..")
    ('pass_wd_.svg', 'file')
    """
    plain = _NO_LETTER.sub("_", name.replace("\\", "/").rpartition("/")[2]).strip(" .")
    stem, dot, ending = plain.rpartition(".")
    if dot and len(ending) <= 8:
        ending = _shortened(ending, 40)
        return f"{_shortened(stem, LONGEST_NAME - 41) or 'file'}.{ending}"
    return _shortened(plain, LONGEST_NAME) or "file"


def _shortened(text: str, most: int) -> str:
    """The beginning of a text, so many bytes of it at most."""
    return text.encode()[:most].decode(errors="ignore").strip(" .")


def _free(folder: Path, name: str) -> Path:
    path, number = folder / name, 1
    while path.exists():
        number += 1
        path = folder / f"{Path(name).stem} {number}{Path(name).suffix}"
    return path


BINARY = "application/octet-stream"

PATIENCE_SECONDS = 20.0
"""How long an export waits for what moves. Chosen."""


class Exporter:
    """Writes what the workspace has.

    ``folder_of``: folder of a batch of files that were sent.
    """

    def __init__(self, workspace: Workspace, folder_of: Callable[[str], Path]) -> None:
        self._workspace, self._folder_of = workspace, folder_of

    async def file(self, asked: Any) -> tuple[bytes, str]:
        """Bytes of a file, and what browsers call its format.

        ``asked``: ``format``, and ``options`` of drawings by name.
        """
        if not isinstance(asked, dict) or set(asked) - {"format", "options"}:
            raise RecipeError("export", "takes a format and options")
        kind, options = asked.get("format"), asked.get("options", {})
        if not isinstance(kind, str) or not isinstance(options, dict):
            raise RecipeError("export", "takes a format and options")
        if (sent := str(options.get("icc"))).startswith(FILES):
            profile = only_file(self._folder_of(sent.removeprefix(FILES)))
            options = {**options, "icc": profile}
        if kind not in (*FORMATS, *FILM_FORMATS, SESSION, RECIPE):
            raise RecipeError("export", f"is not made as {kind[:20]!r}")
        owner = self._workspace.owner
        if owner is None:
            raise PackworkError(NOT_YET)
        if kind in FORMATS or kind in FILM_FORMATS:
            check(kind, options)
        await self._at_rest()
        if kind == SESSION:
            kept = await asyncio.wrap_future(owner.call(lambda session: session.kept()))
            return await asyncio.to_thread(kept_bytes, kept), BINARY
        if kind == RECIPE:
            document = await asyncio.wrap_future(owner.call(lambda session: session.document))
            made = await asyncio.to_thread(recipe_zip, document, document.container.name)
            return made, "application/zip"
        layout, behind = await asyncio.wrap_future(
            owner.call(lambda session: (session.layout, session.document.behind))
        )
        if kind in FILM_FORMATS:
            return await asyncio.to_thread(film_of, layout, kind, options, behind), FILM_FORMATS[
                kind
            ]
        data = await asyncio.to_thread(layout_bytes, layout, kind, options, behind)
        return data, FORMATS[kind]

    async def _at_rest(self) -> None:
        """Wait until nothing moves, for a while."""
        news = asyncio.Event()
        self._workspace.listen(news, lambda _: news.set())
        try:
            async with asyncio.timeout(PATIENCE_SECONDS):
                while (shown := self._workspace.shown) is None or shown.state.moving:
                    news.clear()
                    await news.wait()
        except TimeoutError:
            return
        finally:
            self._workspace.forget(news)


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
