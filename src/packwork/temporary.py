"""Folders in the system's temporary place that are gone with their process, however it ends.

Each holds a file that its process keeps locked. What was killed leaves its folder there; the system
gives back the lock, which proves to the next process that nobody uses the folder any more.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import stat
import tempfile
import weakref
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Self, final

if TYPE_CHECKING:
    from filelock import BaseFileLock

LOCK = ".packwork-lock"
"""Name of the file that is locked."""

_OURS = re.compile(r"packwork-[a-z]+-[a-z0-9_]{8}")


@final
class TemporaryFolder:
    """A folder for this process alone; removed when it is closed or forgotten, or at the end.

    Parameters
    ----------
    kind
        What it is for, lower case letters: a part of its name.

    Raises
    ------
    OSError
        If none can be made.

    Examples
    --------
    >>> with TemporaryFolder("example") as folder:
    ...     (folder.path / "a").write_text("b")
    1
    >>> folder.path.exists()
    False
    """

    def __init__(self, kind: str) -> None:
        clear_away()
        self.path, lock = _locked_folder(kind)
        self._remove = weakref.finalize(self, _removed, self.path, lock, os.getpid())

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Remove the folder and all that is in it."""
        self._remove()


def clear_away() -> None:
    """Remove folders of this user's processes that have ended without doing so."""
    for folder in _left():
        with contextlib.suppress(OSError):
            lock = _lock_in(folder)
            # Whoever has the lock uses the folder; it is left alone.
            with contextlib.suppress(_timeout()):
                lock.acquire(blocking=False)
                lock.release()
                shutil.rmtree(folder, ignore_errors=True)


def _left() -> Iterator[Path]:
    """Folders with a lock that belong to this user, in use or not."""
    with contextlib.suppress(OSError), os.scandir(tempfile.gettempdir()) as found:
        for entry in found:
            if _OURS.fullmatch(entry.name):
                folder = Path(entry.path)
                with contextlib.suppress(OSError):
                    if _is_own(folder, stat.S_ISDIR) and _is_own(folder / LOCK, stat.S_ISREG):
                        yield folder


def _is_own(path: Path, is_kind: object) -> bool:
    status = path.lstat()
    is_this_users = not hasattr(os, "geteuid") or status.st_uid == os.geteuid()
    return is_this_users and bool(is_kind(status.st_mode))  # type: ignore[operator]


def _locked_folder(kind: str) -> tuple[Path, BaseFileLock]:
    while True:
        folder = Path(tempfile.mkdtemp(prefix=f"packwork-{kind}-"))
        lock = _lock_in(folder)
        with contextlib.suppress(_timeout()):
            lock.acquire(blocking=False)
            if (folder / LOCK).exists():
                return folder, lock
            # Another process took it for one that was left, between two steps.
            lock.release()


def _lock_in(folder: Path) -> BaseFileLock:
    from filelock import FileLock

    return FileLock(folder / LOCK, thread_local=False)


def _timeout() -> type[Exception]:
    from filelock import Timeout

    return Timeout


def _removed(folder: Path, lock: BaseFileLock, process: int) -> None:
    if os.getpid() == process:
        lock.release()
        shutil.rmtree(folder, ignore_errors=True)
