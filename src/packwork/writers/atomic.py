"""Atomic writing of files: each is replaced in one step, or left as it was."""

from __future__ import annotations

import contextlib
import errno
import os
import re
import secrets
import stat
import time
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from packwork.errors import WriteError
from packwork.sources import check_no_input

_LEFT = re.compile(r"\.packwork-(?P<process>\d+)-[0-9a-f]{16}\.part")
"""Name of a file that is being written."""

WRITING_SECONDS = 60.0
"""Age of such a file from which on it is removed if its process has ended. Smaller might take
it from a process of another machine that writes to the same disk. Chosen."""

ABANDONED_SECONDS = 86_400.0
"""Age from which on it is removed whatever its process. Chosen."""

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

    That is a folder, a device, a protected file, one that was read, or one where nothing may be
    written. Folders that are missing are no obstacle as long as they can be made. Passing is no
    promise: the disk may fill up, rights may change.
    """
    target = _target(path)
    with _telling(path):
        _check_target(path, target)
        folder = _nearest_folder(target.parent)
        if not os.access(folder, os.W_OK | os.X_OK):
            raise PermissionError(errno.EACCES, "not writable")


def check_outputs(paths: Iterable[str | Path]) -> None:
    """Refuse paths that cannot all be written: one twice, or one as another's folder.

    Links are followed, so that two names of one file count as one.

    Examples
    --------
    >>> check_outputs(["out/a.svg", "out/./a.svg"])
    Traceback (most recent call last):
    packwork.errors.WriteError: out/./a.svg: is the same file as out/a.svg; give each output ...
    """
    met: dict[Path, str | Path] = {}
    for path in paths:
        target = _target(path)
        if target in met:
            raise WriteError(
                path, f"is the same file as {met[target]}; give each output a name of its own"
            )
        met[target] = path
    for target, path in met.items():
        for folder in target.parents:
            if folder in met:
                raise WriteError(
                    path, f"lies in {met[folder]}, which is to be a file; choose another folder"
                )


def check_new(paths: Iterable[str | Path]) -> None:
    """Refuse files that are there already."""
    for path in paths:
        if os.path.lexists(path):
            raise WriteError(path, "is there already, and --no-clobber keeps it; use another name")


def check_all(paths: Iterable[str | Path], *, keeps: bool = False) -> None:
    """Refuse, before a run, what cannot be written after it; ``keeps``: what is there, too."""
    listed = list(paths)
    for path in listed:
        check_writable(path)
    check_outputs(listed)
    if keeps:
        check_new(listed)


def described(paths: Iterable[str | Path]) -> list[str]:
    """Names of files that are to be written, and what that does to those there, and to folders."""
    names, met = list[str](), set[Path]()
    for path in paths:
        folder = Path(path).absolute().parent
        missing = [one for one in (folder, *folder.parents) if not os.path.lexists(one)]
        said = " (replaced)" if os.path.lexists(path) else ""
        if missing and missing[-1] not in met:
            met.add(missing[-1])
            said = f" (folder {missing[-1]} made)"
        names.append(f"{path}{said}")
    return names


def write_atomic(path: str | Path, data: bytes) -> None:
    """Put ``data`` under ``path`` in one step; an older file stays whole until then.

    Missing folders are made. The bytes reach the disk under a random name in the same folder before
    that name is swapped for the real one, so whatever stops the write (a full disk, Ctrl-C) leaves
    the older file as it was and nothing beside it. A link is followed; an older file's permissions
    are kept.
    """
    write_all([(path, data)])


def write_all(files: Sequence[tuple[str | Path, bytes]]) -> None:
    """Put several files in place as :func:`write_atomic` does, once all are on the disk.

    What stops the write before that leaves every older file as it was. After it only names are left
    to be swapped; should that fail for one, those before it are in place.
    """
    check_outputs(path for path, _ in files)
    made: list[Path] = []
    staged: list[tuple[str | Path, Path, Path]] = []
    replaced: list[str | Path] = []
    try:
        for path, data in files:
            with _telling(path):
                target = _target(path)
                _check_target(path, target)
                _make_folders(target.parent, made)
                beside = _beside(target)
                staged.append((path, beside, target))
                _stage(beside, target, data)
        for path, beside, target in staged:
            try:
                beside.replace(target)
            except OSError as error:
                raise WriteError(path, _reason(error) + _already(replaced)) from error
            replaced.append(path)
    except BaseException:
        for _, beside, _ in staged:
            with contextlib.suppress(OSError):
                beside.unlink()
        _remove_folders(made)
        raise
    for folder in {target.parent for _, _, target in staged}:
        _sync_folder(folder)
        _clear_away(folder)


@contextlib.contextmanager
def _telling(path: str | Path) -> Iterator[None]:
    try:
        yield
    except WriteError:
        raise
    except OSError as error:
        raise WriteError(path, _reason(error)) from error


def _target(path: str | Path) -> Path:
    """File to replace: links followed, so that a link stays a link."""
    if not str(path) or "\0" in str(path):
        raise WriteError(repr(str(path)), "this is no file name; give one such as layout.svg")
    return Path(os.path.realpath(path))


def _check_target(path: str | Path, target: Path) -> None:
    check_no_input(path)
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


def _beside(target: Path) -> Path:
    # A random name, as another process may write the same file at the same time.
    return target.with_name(f".packwork-{os.getpid()}-{secrets.token_hex(8)}.part")


def _clear_away(folder: Path) -> None:
    """Remove what a process has left here that was killed while it wrote."""
    with contextlib.suppress(OSError):
        for path in folder.glob(".packwork-*.part"):
            named = _LEFT.fullmatch(path.name)
            with contextlib.suppress(OSError):
                age = time.time() - path.lstat().st_mtime
                if named and (
                    age > ABANDONED_SECONDS
                    or (age > WRITING_SECONDS and not _may_run(int(named["process"])))
                ):
                    path.unlink()


def _may_run(process: int) -> bool:
    """Whether a process may still run; on Windows to ask would be to end it."""
    if os.name == "nt":
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def _already(replaced: Sequence[str | Path]) -> str:
    if not replaced:
        return ""
    return f"; written before it: {', '.join(str(path) for path in replaced)}"


def _stage(beside: Path, target: Path, data: bytes) -> None:
    """Bring the bytes to the disk, ready to take the place of ``target``."""
    with beside.open("xb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    if target.exists():
        # Some file systems know no permissions; that is no reason to fail.
        with contextlib.suppress(PermissionError):
            beside.chmod(stat.S_IMODE(target.stat().st_mode))


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
