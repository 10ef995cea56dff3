"""Folders of our own: private, bounded, never the current one.

What lies in them is trusted when it is read, so no other user may have written it: a folder that
other users can write to, or could replace by theirs because they or their group may write to one
above it, is not used.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import re
import secrets
import stat
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Literal, TypeAlias, final

from packwork.temporary import TemporaryFolder

VARIABLE = "PACKWORK_CACHE_DIR"
"""Environment variable that names the folder; ``off`` keeps nothing beyond a run."""

OFF = "off"

NAME = "packwork"

Kind: TypeAlias = Literal["cache", "data"]

_PLACES: Mapping[Kind, tuple[str, str, str]] = {
    "cache": ("XDG_CACHE_HOME", ".cache", "Library/Caches"),
    "data": ("XDG_DATA_HOME", ".local/share", "Library/Application Support"),
}
"""Of each kind the environment variable that names its place, and the usual places in a home: of
Linux, of macOS. Windows has one for both."""

DIGEST_BYTES = 32
"""Length of a SHA-256, which stands before each entry."""

SHARE_BETWEEN = 1 / 64
"""Share of the most that is written at least between two looks at the size of all. Larger
overshoots, smaller spends time on looking. Chosen."""

MOST_ON_THE_WAY = 200
"""Folders and links through which a path may lead: more go round in a circle. Derived."""

_FOR_THIS_PROCESS: list[TemporaryFolder] = []

_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH

HALF_WRITTEN_SECONDS = 3600.0
"""Age at which an unfinished entry is what a process left that was killed. Chosen."""


@final
class Store:
    """Entries by their keys, in a folder of our own; whatever goes wrong, an entry is not there.

    Parameters
    ----------
    most_bytes
        Size of all entries, beyond which those that were not used for longest go.
    variable
        Another environment variable that may name the folder in which ours lies.

    Examples
    --------
    >>> store = Store("examples", 1_000_000)
    >>> store.get("never-put") is None
    True
    """

    def __init__(self, name: str, most_bytes: int, variable: str | None = None) -> None:
        self._name, self._most, self._variable = name, most_bytes, variable
        # Bytes that may be written before the next look at the size of all.
        self._room = 0

    @property
    def folder(self) -> Path | None:
        """Folder of the entries; None where none can be kept."""
        return private_folder(self._name, self._variable)

    def get(self, key: str) -> bytes | None:
        """Entry of a key; None if there is none, or not the one that was put."""
        path = self._path(key)
        if path is None:
            return None
        try:
            whole = path.read_bytes()
        except OSError:
            return None
        digest, data = whole[:DIGEST_BYTES], whole[DIGEST_BYTES:]
        if hashlib.sha256(data).digest() != digest:
            _remove(path)
            return None
        with contextlib.suppress(OSError):
            os.utime(path)
        return data

    def put(self, key: str, data: bytes) -> None:
        """Keep an entry in one step, if that can be done."""
        path = self._path(key)
        if path is None:
            return
        if self._room <= 0:
            # Other processes write, too.
            left = self._most - self._shorten(path.parent)
            self._room = max(left // 2, int(SHARE_BETWEEN * self._most))
        self._room -= len(data)
        beside = path.with_name(f"{secrets.token_hex(8)}.part")
        try:
            beside.write_bytes(hashlib.sha256(data).digest() + data)
            beside.replace(path)
        except OSError:
            _remove(beside)

    def _path(self, key: str) -> Path | None:
        folder = self.folder
        return None if folder is None else folder / hashlib.sha256(key.encode()).hexdigest()

    def _shorten(self, folder: Path) -> int:
        """Size of all entries, of which those that were not used for longest go if it is too much.

        Half of what there may be is left.
        """
        found: list[tuple[float, int, Path]] = []
        with contextlib.suppress(OSError):
            for path in folder.iterdir():
                with contextlib.suppress(OSError):
                    status = path.lstat()
                    found.append((status.st_mtime, status.st_size, path))
        for used, _, path in found:
            if path.suffix == ".part" and time.time() - used > HALF_WRITTEN_SECONDS:
                _remove(path)
        total = sum(size for _, size, _ in found)
        if total <= self._most:
            return total
        for _, size, path in sorted(found):
            if total <= self._most // 2:
                break
            _remove(path)
            total -= size
        return total


def private_folder(name: str, variable: str | None = None, *, kind: Kind = "cache") -> Path | None:
    """Folder that only this user may write to; made if it is missing.

    It lies where ``PACKWORK_CACHE_DIR`` says, else where ``variable`` does, else where the
    system keeps things of that kind, else, for a user without a home, in a temporary folder.

    Parameters
    ----------
    variable
        Another environment variable that may name the folder in which ours lies.
    kind
        What may be lost is ``cache``, what a person made ``data``.

    Returns
    -------
    Path | None
        None where nothing may be kept: ``PACKWORK_CACHE_DIR=off``, or no place is private.
    """
    asked = (os.environ.get(VARIABLE), os.environ.get(variable) if variable else None)
    system = tuple(os.environ.get(key) for key in (_PLACES[kind][0], "LOCALAPPDATA", "HOME"))
    return _private_folder(name, asked, system, kind)


@functools.lru_cache(maxsize=32)
def _private_folder(
    name: str, asked: tuple[str | None, ...], system: tuple[str | None, ...], kind: Kind
) -> Path | None:
    if asked[0] == OFF:
        return None
    for parent in _candidates(asked, kind):
        folder = parent / name
        with contextlib.suppress(OSError):
            for made in (*reversed(folder.parents), folder):
                # Parents too: whatever the mask of the user, a group may not write there.
                made.mkdir(mode=0o700, exist_ok=True)
            if is_private(folder) and _takes_files(folder):
                return folder
    return _temporary(name)


def _candidates(asked: tuple[str | None, ...], kind: Kind) -> Iterator[Path]:
    """Folders to try, none of them relative: that would depend on the current folder."""
    for place in asked:
        if place and Path(place).is_absolute():
            yield Path(place) / NAME
    system = _system_folder(kind)
    if system is not None and system.is_absolute():
        yield system / NAME
    # Without a usable temporary folder Python takes the current one.
    temporary = Path(tempfile.gettempdir())
    if temporary.is_absolute() and temporary != Path.cwd():
        yield temporary / f"{NAME}-{os.getuid() if hasattr(os, 'getuid') else 'cache'}"


def _system_folder(kind: Kind) -> Path | None:
    variable, usual, of_macos = _PLACES[kind]
    if sys.platform == "win32":
        local = os.environ.get("LOCALAPPDATA")
        return Path(local) if local else None
    if sys.platform != "darwin" and (chosen := os.environ.get(variable)):
        return Path(chosen)
    home = home_folder()
    if home is None:
        return None
    return home / (of_macos if sys.platform == "darwin" else usual)


def home_folder() -> Path | None:
    """The user's home; None where there is none, which is then not made either."""
    # A user without an entry in the list of users has none, as services run by some.
    with contextlib.suppress(RuntimeError, OSError):
        home = Path.home()
        return home if home.is_absolute() and home.is_dir() else None
    return None


def is_private(folder: Path) -> bool:
    """Whether only this user may write into a folder, or put another in its place.

    Windows keeps what lies in a user's folders from others; there all are taken as private.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     is_private(Path(folder))
    True
    """
    if not hasattr(os, "geteuid"):
        return True
    status = folder.lstat()
    if not stat.S_ISDIR(status.st_mode) or status.st_uid != os.geteuid():
        return False
    if status.st_mode & _BY_OTHERS:
        return False
    try:
        return all(map(_is_safe, _on_the_way(folder.absolute())))
    except OSError:
        return False


def _on_the_way(folder: Path) -> Iterator[os.stat_result]:
    """Status of each folder and link through which a path leads, without the last."""
    here, ahead = Path(folder.anchor), list(reversed(folder.parts[1:]))
    for _ in range(MOST_ON_THE_WAY):
        yield here.lstat()
        if not ahead:
            return
        part = ahead.pop()
        there = here.parent if part == ".." else here / part
        if there.is_symlink():
            yield there.lstat()
            target = here / there.readlink()
            here, ahead = Path(target.anchor), ahead + list(reversed(target.parts[1:]))
        elif ahead:
            here = there
    raise OSError(f"{folder} leads through too many links")


def _is_safe(status: os.stat_result) -> bool:
    """Whether only this user and the system may change a folder, or where a link leads."""
    if status.st_uid not in {0, os.geteuid()}:
        return False
    is_sticky = status.st_mode & stat.S_ISVTX
    return stat.S_ISLNK(status.st_mode) or bool(is_sticky) or not status.st_mode & _BY_OTHERS


def _takes_files(folder: Path) -> bool:
    """Whether a file can be written there: rights alone do not tell of read-only disks."""
    with tempfile.TemporaryFile(dir=folder):
        return True


def _temporary(name: str) -> Path | None:
    """A folder for this process alone, removed at its end."""
    # Without a usable temporary folder Python takes the current one.
    if Path(tempfile.gettempdir()) == Path.cwd():
        return None
    try:
        made = TemporaryFolder(re.sub("[^a-z]", "", name))
    except OSError:
        return None
    _FOR_THIS_PROCESS.append(made)
    return made.path


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):
        path.unlink()
