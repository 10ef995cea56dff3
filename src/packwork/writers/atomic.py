"""One way onto the disk: all of a file, or nothing of it."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import stat
from pathlib import Path

from packwork.errors import WriteError

_REASONS = {
    errno.ENOSPC: "the disk is full; free some room or choose another folder",
    errno.EDQUOT: "the disk quota is used up; free some room or choose another folder",
    errno.EACCES: "the folder may not be written to; choose another one",
    errno.EPERM: "the folder may not be written to; choose another one",
    errno.EROFS: "the folder is on a read-only disk; choose another one",
    errno.ENAMETOOLONG: "the name is too long; choose a shorter one",
    errno.ENOTDIR: "a part of its path is a file, not a folder; choose another path",
    errno.EISDIR: "it is a folder; give the name of a file",
    errno.ELOOP: "its links lead round in a circle; choose another path",
}


def check_writable(path: str | Path) -> None:
    """Refuse a path that a file could not be written to; touches nothing.

    Folders that are missing are no obstacle as long as they can be made.

    Raises
    ------
    WriteError
        If it is a folder or a device, a protected file, or lies where nothing may be
        written. Passing is no promise: the disk may fill up, rights may change.

    Examples
    --------
    >>> check_writable("new-folder/layout.svg")
    """
    target = _target(path)
    try:
        _check_target(path, target)
        folder = _nearest_folder(target.parent)
        if not os.access(folder, os.W_OK | os.X_OK):
            raise PermissionError(errno.EACCES, "not writable")
    except OSError as error:
        raise WriteError(path, _reason(error)) from error


def write_atomic(path: str | Path, data: bytes) -> None:
    """Put ``data`` under ``path`` in one step; an older file stays whole until then.

    Missing folders are made. The bytes reach the disk under a random name in the same
    folder before that name is swapped for the real one, so whatever stops the write
    (a full disk, Ctrl-C) leaves the older file as it was and nothing beside it. A link
    is followed; an older file's permissions are kept.

    Raises
    ------
    WriteError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_atomic(Path(folder, "a.txt"), b"whole")
    ...     Path(folder, "a.txt").read_bytes()
    b'whole'
    """
    target = _target(path)
    made: list[Path] = []
    try:
        _check_target(path, target)
        _make_folders(target.parent, made)
        _swap_in(target, data)
    except OSError as error:
        _remove_folders(made)
        raise WriteError(path, _reason(error)) from error
    except BaseException:
        _remove_folders(made)
        raise


def _target(path: str | Path) -> Path:
    """File to replace: links followed, so that a link stays a link."""
    if not str(path) or "\0" in str(path):
        raise WriteError(repr(str(path)), "this is no file name; give one such as layout.svg")
    return Path(os.path.realpath(path))


def _check_target(path: str | Path, target: Path) -> None:
    try:
        mode = target.stat().st_mode
    except FileNotFoundError:
        return
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, "is a directory")
    if not stat.S_ISREG(mode):
        raise WriteError(path, "it is a device, not a file; give the name of a file")
    # Swapping names needs rights on the folder only, and would undo a user's protection.
    if not os.access(target, os.W_OK):
        raise WriteError(path, "the file is protected from writing; choose another name")


def _nearest_folder(folder: Path) -> Path:
    while True:
        try:
            if stat.S_ISDIR(folder.stat().st_mode):
                return folder
            raise NotADirectoryError(errno.ENOTDIR, "not a directory")
        except FileNotFoundError:
            folder = folder.parent


def _make_folders(folder: Path, made: list[Path]) -> None:
    """Make the missing folders, noting in ``made`` which ones, outermost first."""
    nearest = _nearest_folder(folder)
    missing = folder.relative_to(nearest).parts
    for count in range(1, len(missing) + 1):
        step = nearest.joinpath(*missing[:count])
        made.append(step)
        step.mkdir(exist_ok=True)


def _remove_folders(made: list[Path]) -> None:
    for folder in reversed(made):
        with contextlib.suppress(OSError):
            folder.rmdir()


def _swap_in(target: Path, data: bytes) -> None:
    # A random name, as another process may write the same file at the same time.
    beside = target.with_name(f".packwork-{secrets.token_hex(8)}.part")
    try:
        with beside.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        if target.exists():
            # Some file systems know no permissions; that is no reason to fail.
            with contextlib.suppress(PermissionError):
                beside.chmod(stat.S_IMODE(target.stat().st_mode))
        beside.replace(target)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
    _sync_folder(target.parent)


def _sync_folder(folder: Path) -> None:
    """Ask for the new name to reach the disk; not every system can."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _reason(error: OSError) -> str:
    return _REASONS.get(error.errno or 0, f"it cannot be written ({error.strerror or error})")
