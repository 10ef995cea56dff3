"""Workspaces on the disk and their addresses: what was not saved is found again.

Each workspace is a session file in a private folder, with a journal; beside it stand its page's
port and a key that the page has too, so that one that is still open goes on by itself when its
workspace is opened again: both prove to each other that they know the key.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import shlex
from base64 import b64decode, b64encode
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from filelock import FileLock, Timeout

from packwork.errors import PackworkError
from packwork.folders import private_folder
from packwork.live.face.exporting import layout_bytes
from packwork.live.face.opening import lock_of, read_once

MOST_WORKSPACES = 50
"""Workspaces that are kept; then the one left alone for longest is written over. Chosen."""

MOST_RECENT = 6
"""Workspaces of which a page is told, which shows all: each is read and drawn."""

ENDING = ".packwork"

_KEY = re.compile("[0-9a-f]{64}")


@dataclass(frozen=True)
class KeptWorkspace:
    """A workspace on disk.

    ``place``: where its port and key stand; None if nothing may be kept.
    """

    file: Path
    place: Path | None

    @property
    def address(self) -> tuple[int, str]:
        """Port and key that its page had; 0 and nothing if there was none."""
        if self.place is None:
            return 0, ""
        try:
            stored = json.loads(self.place.read_text(encoding="utf-8"))
            port, key = stored["port"], stored["key"]
        except (OSError, ValueError, TypeError, KeyError):
            return 0, ""
        is_sound = isinstance(port, int) and 0 < port < 65_536 and isinstance(key, str)
        return (port, key) if is_sound and _KEY.fullmatch(key) else (0, "")

    @property
    def inputs(self) -> str:
        """Arguments by which a command line opens it."""
        is_ours = self.file.parent == _folder()
        return "--again" if is_ours else shlex.quote(str(self.file))

    def remember(self, port: int, key: str) -> None:
        """Keep where its page is, for the same user alone to read."""
        if self.place is not None:
            with contextlib.suppress(OSError):
                self.place.unlink(missing_ok=True)
                flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL
                with os.fdopen(os.open(self.place, flags, 0o600), "w", encoding="utf-8") as out:
                    json.dump({"port": port, "key": key}, out)


def _folder() -> Path | None:
    """The folder of workspaces; None if nothing may be kept."""
    return private_folder("studio", kind="data")


def of_file(file: Path) -> KeptWorkspace:
    """Workspace of a session file that somebody has named."""
    folder = _folder()
    name = hashlib.sha256(str(file.absolute()).encode()).hexdigest()[:16]
    return KeptWorkspace(file, None if folder is None else folder / f"{name}.json")


def new() -> KeptWorkspace | None:
    """An empty workspace, or the one left alone for longest; None if none may be kept.

    None that somebody works at, however long it was left alone.
    """
    folder = _folder()
    if folder is None:
        return None
    files = [folder / f"desk-{number}{ENDING}" for number in range(1, MOST_WORKSPACES + 1)]
    for file in sorted(files, key=_last_taken):
        with contextlib.suppress(Timeout, OSError), FileLock(lock_of(file), blocking=False):
            # From now on another that begins sees it as taken, until its session holds the lock.
            os.utime(lock_of(file))
            for one in (file, file.with_name(file.name + ".log")):
                one.unlink(missing_ok=True)
            return KeptWorkspace(file, file.with_suffix(".json"))
    return None


class Shelf:
    """Workspaces on disk for one page, whose port and key they are given."""

    def __init__(self, port: int, key: str) -> None:
        self._port, self._key = port, key

    def new_file(self) -> Path | None:
        """File of an empty workspace; None if none may be kept."""
        made = new()
        return None if made is None else self._remembered(made)

    def file(self, name: str) -> Path:
        """File of a workspace that :meth:`recent` has told of."""
        found = next((file for file in _known() if file.stem == name), None)
        if found is None:
            raise PackworkError("that is not there any more; open another one")
        return self._remembered(KeptWorkspace(found, found.with_suffix(".json")))

    def recent(self) -> list[Recent]:
        """Newest workspaces that nobody works at; what cannot be read is left out."""
        found = list[Recent]()
        for file in sorted(_known(), key=_last_used, reverse=True):
            if len(found) == MOST_RECENT:
                break
            taken = contextlib.suppress(Timeout, OSError, PackworkError)
            with taken, FileLock(lock_of(file), blocking=False):
                found.append(_known_look(file) or _looked_at(file))
        return found

    def _remembered(self, kept: KeptWorkspace) -> Path:
        kept.remember(self._port, self._key)
        return kept.file


@dataclass(frozen=True)
class Recent:
    """Workspace as a list shows it.

    ``name``: of its file, without folder and ending; ``changed``: seconds since 1970.
    """

    name: str
    title: str
    count: int
    changed: float
    png: bytes


LOOK = ".look"
"""Ending of files that keep how a workspace looks in the list."""

PICTURE_PX = 240
"""Longer side of its picture. Chosen."""


def _known_look(file: Path) -> Recent | None:
    """Workspace as it was looked at last; None if it was changed since, or never looked at."""
    try:
        known = json.loads(file.with_suffix(LOOK).read_text(encoding="utf-8"))
        title, count, changed = str(known["title"]), int(known["count"]), float(known["changed"])
        png = b64decode(known["png"], validate=True)
    except (OSError, ValueError, TypeError, KeyError):
        return None
    is_same = changed == _last_used(file)
    return Recent(file.stem, title, count, changed, png) if is_same else None


def _looked_at(file: Path) -> Recent:
    """Workspace read and drawn, which takes long beside a run: kept for the next start."""
    document = read_once(file).document
    png = layout_bytes(document.layout, "png", {"pixels": PICTURE_PX, "show_container": True})
    found = Recent(file.stem, document.title, len(document), _last_used(file), png)
    known = {**asdict(found), "png": b64encode(png).decode("ascii")}
    with contextlib.suppress(OSError):
        file.with_suffix(LOOK).write_text(json.dumps(known), encoding="utf-8")
    return found


def last() -> KeptWorkspace:
    """The workspace that was used last."""
    found = max(_known(), key=_last_used, default=None)
    if found is None:
        raise PackworkError("nothing is kept to go on with; leave --again out")
    return KeptWorkspace(found, found.with_suffix(".json"))


def _known() -> Iterator[Path]:
    folder = _folder()
    if folder is not None:
        yield from folder.glob(f"desk-*{ENDING}")


def _last_taken(file: Path) -> float:
    """Time when a workspace was last written to, or chosen for a new session; 0 if it is none."""
    with contextlib.suppress(OSError):
        return max(_last_used(file), lock_of(file).stat().st_mtime)
    return _last_used(file)


def _last_used(file: Path) -> float:
    """Time when a workspace was last written to; 0 if it is none."""
    times = [0.0]
    for one in (file, file.with_name(file.name + ".log")):
        with contextlib.suppress(OSError):
            times.append(one.stat().st_mtime)
    return max(times)
