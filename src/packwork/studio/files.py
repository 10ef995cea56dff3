"""Files of a page: those that it sends, in a private folder, and those that are made for it."""

from __future__ import annotations

import asyncio
import re
import secrets
from collections.abc import Callable
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
from packwork.live.face.offers import only_file
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
