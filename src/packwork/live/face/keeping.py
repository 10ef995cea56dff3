"""A session kept on disk while it is worked on: a file, and a journal of what came later."""

from __future__ import annotations

from pathlib import Path

from packwork.errors import PackworkError
from packwork.live.file.disk import Disk, lock_beside
from packwork.live.session import Session

LONGEST_JOURNAL = 60_000
"""Bytes of a journal from which on the file is written anew, in a quiet moment. Larger takes longer
to be done again after a crash: each gesture as long as it took. Chosen."""


def lock_of(file: Path) -> Path:
    """File whose lock says that somebody works at a session that is kept in ``file``."""
    return lock_beside(file)


class Keeper:
    """Keeps a session in a file; called in the thread that owns the session."""

    def __init__(self, disk: Disk) -> None:
        self._disk = disk

    def begin(self, session: Session) -> None:
        """Write the file, and note from now on what is done.

        Raises
        ------
        WriteError
            If nothing can be written there.
        """
        self._disk.save(session)

    @property
    def is_long(self) -> bool:
        """Whether the journal is so long that the file should be written anew."""
        try:
            return self._disk.journal.stat().st_size > LONGEST_JOURNAL
        except OSError:
            return False

    def tidy(self, session: Session) -> None:
        """Write the file anew, if nothing is held by the hand."""
        if not session.is_grabbed:
            self._disk.save(session)

    def end(self, session: Session) -> None:
        """Write the file a last time, and end the journal."""
        try:
            self.tidy(session)
        except PackworkError:
            # The journal has it all.
            return
        finally:
            self._disk.close(session)
