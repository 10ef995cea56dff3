"""A session's file on disk, and the journal beside it of what came after the file was written.

The journal is flushed at the end of each gesture, so a crash loses at most the last one. Its first
line says which file it goes on from; a file says which one it has replaced, so that a journal whose
gestures it holds already is known as such.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import logging
import os
import shutil
from collections.abc import Iterable, Iterator
from itertools import count
from pathlib import Path
from typing import TypeVar

from filelock import FileLock, Timeout

from packwork.errors import ReadError, RecipeError, WriteError
from packwork.live.commands.gestures import Cancel
from packwork.live.document import Document
from packwork.live.file.session_file import MOST_BYTES, read_session, session_bytes
from packwork.live.file.things import Things
from packwork.live.history import SessionState
from packwork.live.log import Entry, Log, read_entries
from packwork.live.session import Session
from packwork.phrasing import number_of
from packwork.readers.layouts.read import SESSION
from packwork.readers.reading import exists, read_bytes, read_lines
from packwork.scene.layout import Layout
from packwork.sources import forget_input
from packwork.writers.atomic import write_atomic

ENDING = SESSION
"""Of session files."""

LONGEST_LINE = 256_000_000
"""Characters of a journal's line at most: an item with a large photograph. Chosen."""

LONGEST_GESTURE = 500_000
"""Lines of a journal's one gesture at most: more than an hour of a drag. Chosen."""

_LOG = logging.getLogger("packwork")

_Session = TypeVar("_Session", bound=Session)


def layout_in(path: str | Path) -> Layout:
    """Layout of a session's file, as the session stands there."""
    return Disk(path, is_journaled=False).opened(Session).layout


@contextlib.contextmanager
def saving(layout: Layout, paths: Iterable[Path]) -> Iterator[list[tuple[Path, bytes]]]:
    """Session files that begin with a layout, for the block to write, and nobody else."""
    with contextlib.ExitStack() as stack:
        disks = [Disk(path, is_journaled=False) for path in paths]
        session = Session(Document.from_layout(layout)) if disks else None
        yield [
            (disk.path, stack.enter_context(disk.replacing(session)))
            for disk in disks
            if session is not None
        ]


def lock_beside(path: Path) -> Path:
    """File whose lock says that a session is written by somebody."""
    return path.with_name(path.name + ".lock")


class Disk:
    """File of a session, and the journal beside it.

    For as long as a journal is written nobody else may write the file: a lock beside it says so,
    which the system gives back when the process ends, however it ends.
    """

    def __init__(self, path: str | Path, *, is_journaled: bool) -> None:
        self.path = Path(path)
        self.is_journaled = is_journaled
        self.missed = ""
        """What of the journal could not be done again, and where it is kept; empty if nothing."""
        self._things = Things()
        self._digest = ""
        self._lock = FileLock(lock_beside(self.path), blocking=False, thread_local=False)
        self._stream: _JournalLines | None = None
        self._log: Log | None = None

    @property
    def journal(self) -> Path:
        """The file beside, of what came later."""
        return self.path.with_name(self.path.name + ".log")

    def opened(self, kind: type[_Session]) -> _Session:
        """A session of a kind that goes on from the file and from its journal."""
        with contextlib.ExitStack() as undone:
            if self.is_journaled:
                self._own()
                undone.callback(self._disown)
            kept, entries = self._read()
            session = kind(kept.document)
            session.go_on_from(kept)
            self._go_on(session, entries)
            undone.pop_all()
        return session

    def is_at(self, path: str | Path) -> bool:
        """Whether a path is that of the file, by whatever name."""
        return os.path.realpath(path) == os.path.realpath(self.path)

    def save(self, session: Session, journal: bool | None = None) -> None:
        """Write the file, and begin its journal anew.

        ``journal``: whether one is kept from now on; None for as before.
        """
        with self.replacing(session, journal) as data:
            write_atomic(self.path, data)

    @contextlib.contextmanager
    def replacing(self, session: Session, journal: bool | None = None) -> Iterator[bytes]:
        """The file's new bytes, for the block to write; nobody else writes the file meanwhile."""
        was_owned = self._lock.is_locked
        kept = session.kept()
        self._own()
        try:
            data = session_bytes(kept, self._things, self._replaced())
            yield data
            self._digest = hashlib.sha256(data).hexdigest()
            self.is_journaled = self.is_journaled if journal is None else journal
            if self.is_journaled:
                self._begin(session)
            else:
                self._end(session)
                self.journal.unlink(missing_ok=True)
        finally:
            if not (self._log or (was_owned and self.is_journaled)):
                self._disown()

    def close(self, session: Session) -> None:
        """End the journal; it stays, and what it holds is done again when the file is opened."""
        try:
            if self._log is not None:
                self._log.flush()
        finally:
            self._end(session)
            self._disown()

    def _own(self) -> None:
        """Keep others from writing the file."""
        if self._lock.is_locked:
            return
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self._lock.acquire()
        except Timeout:
            raise WriteError(
                self.path, "is open in another session; close it there, or save under another name"
            ) from None
        except OSError as error:
            reason = error.strerror or error
            raise WriteError(self.path, f"nothing can be written beside it ({reason})") from error

    def _disown(self) -> None:
        """Let others write the file."""
        if self._lock.is_locked:
            # While it is still ours: whoever waits for it then sees that it is gone, and makes one.
            with contextlib.suppress(OSError):
                Path(self._lock.lock_file).unlink()
            self._lock.release()

    def _read(self) -> tuple[SessionState, Iterator[Entry]]:
        """Contents of the file, and the entries that its journal adds."""
        data = read_bytes(self.path, MOST_BYTES)
        forget_input(self.path)
        state, follows = read_session(data, str(self.path))
        self._digest = hashlib.sha256(data).hexdigest()
        entries = self._later(follows) if exists(self.journal) else iter(())
        return state, entries

    def _go_on(self, session: Session, entries: Iterable[Entry]) -> None:
        """Do to a session what a journal adds, as far as that can be, and begin the next journal.

        A journal of which not all can be done is kept beside in a copy, if it goes on.
        """
        gestures, is_as_saved = 0, True
        try:
            for entry in entries:
                is_as_saved = False
                gestures += session.repeat((entry,))
        except (ReadError, RecipeError) as error:
            told = str(error) if isinstance(error, ReadError) else f"{self.journal}: {error}"
            kept_in = f"; all of it is kept in {self._kept_aside()}" if self.is_journaled else ""
            self.missed = f"{told}; this and what comes after it are left out{kept_in}"
            _LOG.warning("%s", self.missed)
            if session.is_grabbed:
                session.apply(Cancel())
        if gestures:
            many = number_of(gestures, "gesture")
            _LOG.warning("%s: %s done again that had not been saved", self.path, many)
        if self.is_journaled:
            # What was recovered is written before anything new is done to it: an undo, too.
            (self._begin if is_as_saved else self.save)(session)

    def _replaced(self) -> str:
        """Digest of the file that is to be replaced; empty if there is none."""
        if not exists(self.path):
            return self._digest
        try:
            with self.path.open("rb") as file:
                found = hashlib.file_digest(file, "sha256").hexdigest()
        except OSError as error:
            raise WriteError(self.path, f"cannot be read: {error.strerror or error}") from error
        if self._digest not in {"", found}:
            raise WriteError(
                self.path, "was changed by others since it was read; save under another name"
            )
        return found

    def _begin(self, session: Session) -> None:
        """Begin a journal that goes on from the file as it is, which holds all that was done."""
        self._end(session)
        try:
            write_atomic(self.journal, (json.dumps({"follows": self._digest}) + "\n").encode())
            self._stream = _JournalLines(self.journal)
        except OSError as error:
            raise WriteError(self.journal, f"cannot be written: {error}") from error
        self._log = session.log = Log(self._stream)

    def _end(self, session: Session) -> None:
        if self._stream is None or self._log is None:
            return
        if session.log is self._log:
            session.log = Log()
        self._stream.close()
        self._stream = self._log = None

    def _later(self, replaced: str) -> Iterator[Entry]:
        """Entries of the journal that the file does not hold."""
        lines = read_lines(self.journal, MOST_BYTES, LONGEST_LINE)
        follows = _follows(next(lines, ""))
        if follows and follows == replaced:
            # A crash came between the new file and its journal.
            return iter(())
        if follows != self._digest:
            raise ReadError(
                self.journal, f"is no journal of {self.path.name} as it is now; move it away"
            )
        return _whole_gestures(read_entries(lines, str(self.journal)), self.journal)

    def _kept_aside(self) -> str:
        """Name of a copy of the journal, which takes no other's place."""
        names = (f"{self.journal.name}.spoilt{n or ''}" for n in count())
        aside = next(one for name in names if not exists(one := self.journal.with_name(name)))
        try:
            shutil.copyfile(self.journal, aside)
        except OSError as error:
            raise WriteError(aside, f"cannot be written: {error.strerror or error}") from error
        return aside.name


class _JournalLines:
    """Lines at the end of a file, each written whole or not at all."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._file = path.open("ab", buffering=0)

    def write(self, text: str) -> None:
        """Write a line, or nothing of it."""
        begun, rest = self._file.seek(0, os.SEEK_END), memoryview(text.encode())
        if len(rest) > LONGEST_LINE or begun + len(rest) > MOST_BYTES:
            raise WriteError(self._path, "is full; save the session, which begins another")
        try:
            while rest:
                rest = rest[self._file.write(rest) :]
        except OSError as error:
            self._file.truncate(begun)
            raise WriteError(
                self._path, f"cannot be written: {error.strerror or error}; make room: what was "
                "done is there, and is written with what is done next",
            ) from error  # fmt: skip

    def flush(self) -> None:
        """Nothing waits."""

    def close(self) -> None:
        """Of the file."""
        self._file.close()


def _follows(line: str) -> str:
    """Digest of the file that a journal goes on from; empty if it says none."""
    try:
        first = json.loads(line)
    except (ValueError, RecursionError):
        return ""
    return str(first.get("follows", "")) if isinstance(first, dict) else ""


def _whole_gestures(entries: Iterator[Entry], journal: Path) -> Iterator[Entry]:
    """Entries without a gesture at the end that was not ended."""
    open_: list[Entry] = []
    for entry in entries:
        kind = getattr(entry[1], "kind", "") if entry[0] == "do" else ""
        if kind == "grab" or open_:
            open_.append(entry)
            if len(open_) > LONGEST_GESTURE:
                raise ReadError(journal, f"has a gesture of more than {LONGEST_GESTURE:,} lines")
        else:
            yield entry
        if kind == "drop":
            yield from open_
            open_ = []
