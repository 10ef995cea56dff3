"""A session's file on disk, and the journal beside it of what came after the file was written.

The journal is flushed at the end of each gesture, so a crash loses at most the last one. Its first
line says which file it goes on from; a file says which one it has replaced, so that a journal whose
gestures it holds already is known as such.
"""

from __future__ import annotations

import hashlib
import io
import json
import logging
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import IO

from packwork.errors import ReadError, RecipeError, WriteError
from packwork.inputs import forget_input
from packwork.live.file.archive import MOST_BYTES
from packwork.live.file.session_file import read_session, session_bytes
from packwork.live.file.things import Things
from packwork.live.kept import Kept
from packwork.live.log import Entry, Log, read_entries
from packwork.live.session import Session
from packwork.readers.files import exists, read_bytes
from packwork.writers.atomic import write_atomic

ENDING = ".packwork"
"""Of session files."""

_LOG = logging.getLogger("packwork")


class Disk:
    """Where a session is kept.

    Parameters
    ----------
    path
        Of the file.
    is_journaled
        Whether all that is done is noted beside it.
    """

    def __init__(self, path: str | Path, *, is_journaled: bool) -> None:
        self.path = Path(path)
        self._is_journaled = is_journaled
        self._things = Things()
        self._digest = ""
        self._stream: IO[str] | None = None

    @property
    def journal(self) -> Path:
        """The file beside, of what came later."""
        return self.path.with_name(self.path.name + ".log")

    def read(self) -> tuple[Kept, Iterator[Entry]]:
        """What the file holds, and what its journal adds to it.

        Raises
        ------
        ReadError
            If either is spoilt, or the journal is of another file.
        """
        data = read_bytes(self.path, MOST_BYTES)
        forget_input(self.path)
        found = read_session(data, str(self.path))
        self._digest = hashlib.sha256(data).hexdigest()
        entries = self._later(found.follows) if exists(self.journal) else iter(())
        return found.kept, entries

    def go_on(self, session: Session, entries: Iterable[Entry]) -> None:
        """Do to a session what a journal adds, and begin the next journal.

        Raises
        ------
        ReadError
            If the journal is spoilt.
        """
        try:
            gestures = session.repeat(entries)
        except RecipeError as error:
            raise ReadError(self.journal, f"asks for what has no meaning: {error}") from None
        if gestures:
            _LOG.warning("%s: %d gestures that had not been saved", self.path, gestures)
        if self._is_journaled:
            # What was recovered is written before anything new is done to it.
            (self.save if gestures else self._begin)(session)

    def save(self, session: Session) -> None:
        """Write the file, and begin its journal anew.

        Raises
        ------
        RecipeError
            If something is grabbed.
        WriteError
            If nothing can be written there; what was there is as it was.
        """
        data = session_bytes(session.kept(), self._things, self._digest)
        write_atomic(self.path, data)
        self._digest = hashlib.sha256(data).hexdigest()
        if self._is_journaled:
            self._begin(session)
        elif exists(self.journal):
            self.journal.unlink()

    def close(self, session: Session) -> None:
        """End the journal; it stays, and what it holds is done again when the file is opened."""
        if self._stream is not None:
            session.log.flush()
            session.log = Log()
            self._stream.close()
            self._stream = None

    def _begin(self, session: Session) -> None:
        self.close(session)
        try:
            write_atomic(self.journal, (json.dumps({"follows": self._digest}) + "\n").encode())
            self._stream = self.journal.open("a", encoding="utf-8", newline="\n")
        except OSError as error:
            raise WriteError(self.journal, f"cannot be written: {error}") from error
        session.log = Log(self._stream)

    def _later(self, replaced: str) -> Iterator[Entry]:
        """Entries of the journal that the file does not hold."""
        text = read_bytes(self.journal, MOST_BYTES).decode("utf-8", "replace")
        lines = iter(io.StringIO(text))
        follows = _follows(next(lines, ""))
        if follows and follows == replaced:
            # A crash came between the new file and its journal.
            return iter(())
        if follows != self._digest:
            raise ReadError(
                self.journal, f"is no journal of {self.path.name} as it is now; move it away"
            )
        return _whole(read_entries(lines, str(self.journal)))


def _follows(line: str) -> str:
    """Digest of the file that a journal goes on from; empty if it says none."""
    try:
        said = json.loads(line)
    except (ValueError, RecursionError):
        return ""
    return str(said.get("follows", "")) if isinstance(said, dict) else ""


def _whole(entries: Iterator[Entry]) -> Iterator[Entry]:
    """Entries without a gesture at the end that was not ended."""
    open_: list[Entry] = []
    for entry in entries:
        kind = getattr(entry[1], "kind", "") if entry[0] == "do" else ""
        if kind == "grab" or open_:
            open_.append(entry)
        else:
            yield entry
        if kind == "drop":
            yield from open_
            open_ = []
