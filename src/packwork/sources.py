"""Sources that readers look in: memory, a mirror of another machine's files, then the disk.

A recipe names files. What is in memory has no file: a run stores it under a name such as
``memory:bear.png``, and readers look there first; so whatever may be a path may be a value. A
recipe that is run elsewhere names files as they lie where it was written: their content is sent,
laid in a folder, and read through :func:`here_of`, so that names, and with them all that is written
about a run, stay the same.

What is read from the disk is noted, for programs that ask for that, so that no result is written
over it: nothing has to be foreseen of folders, patterns or files that name other files.
"""

from __future__ import annotations

import glob
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePath
from typing import Final, TypeAlias

from packwork.errors import WriteError

MEMORY = "memory:"
"""Before the name of what is in memory."""

_LONGEST_NAME = 60
_NO_LETTER = re.compile(r"[^\w .()+-]")


@dataclass
class MemoryStore:
    """Values of one run by name.

    Parameters
    ----------
    values
        Encoded files as ``bytes``, or what a reader understands.
    """

    values: dict[str, object] = field(default_factory=dict)

    def put(self, value: object, name: str, ending: str = "") -> str:
        """Name under which a value is found from now on: a new one, unless it is here already.

        Parameters
        ----------
        ending
            Of a file of such content, as ``.png``.

        Examples
        --------
        >>> memory = MemoryStore()
        >>> memory.put(b"a", "bear", ".svg"), memory.put(b"b", "bear", ".svg")
        ('memory:bear.svg', 'memory:bear 2.svg')
        """
        plain = _NO_LETTER.sub("_", name).strip(" .")[:_LONGEST_NAME] or "value"
        number = 1
        while True:
            called = f"{MEMORY}{plain}{f' {number}' if number > 1 else ''}{ending}"
            if called not in self.values:
                self.values[called] = value
            if self.values[called] is value:
                return called
            number += 1


@dataclass(frozen=True)
class Sources:
    """Values by name and a folder, in which readers look before they look on the disk."""

    memory: MemoryStore = field(default_factory=MemoryStore)
    mirror: Path | None = None


_NOTHING = Sources()
_IN_USE: ContextVar[Sources] = ContextVar("sources", default=_NOTHING)


@contextmanager
def _using(sources: Sources) -> Iterator[None]:
    before = _IN_USE.set(sources)
    try:
        yield
    finally:
        _IN_USE.reset(before)


@contextmanager
def memory_in_use() -> Iterator[MemoryStore]:
    """Values that readers find inside the block, before they look for files.

    What an outer block holds is in this one too.

    Examples
    --------
    >>> with memory_in_use() as memory:
    ...     stored(memory.put(b"<svg/>", "bear", ".svg"))
    b'<svg/>'
    >>> stored("memory:bear.svg") is None
    True
    """
    outer = _IN_USE.get()
    memory = MemoryStore(dict(outer.memory.values))
    with _using(replace(outer, memory=memory)):
        yield memory


def stored(name: str) -> object | None:
    """The value of that name that is in use; None if there is none."""
    return _IN_USE.get().memory.values.get(name)


@contextmanager
def mirrored(folder: Path) -> Iterator[None]:
    """Look for files in a folder first, inside the block."""
    with _using(replace(_IN_USE.get(), mirror=folder)):
        yield


def here_of(path: str | Path) -> Path:
    """Path of this machine for one that is mirrored; the path itself unless it was mirrored.

    Examples
    --------
    >>> here_of("bear.svg").name
    'bear.svg'
    """
    folder = _IN_USE.get().mirror
    if folder is None:
        return Path(path)
    copy = place_in(folder, path)
    return copy if copy.exists() else Path(path)


def place_in(folder: Path, path: str | PurePath) -> Path:
    """Path of a file of that name in a mirror: inside it, whatever the name.

    Examples
    --------
    >>> place_in(Path("m"), "/a/b.svg").as_posix(), place_in(Path("m"), "../b.svg").as_posix()
    ('m/^/a/b.svg', 'm/^^/b.svg')
    """
    plain = PurePath(path)
    parts = ["^^" if part == ".." else part for part in plain.parts]
    if plain.anchor:
        parts[0] = "^" + "".join(c for c in plain.anchor if c.isalnum())
    return folder.joinpath(*parts)


def names_like(pattern: str) -> list[str]:
    """Names of the files that a pattern names, of those that are mirrored where some are.

    ``**`` stands for any number of folders.
    """
    folder = _IN_USE.get().mirror
    if folder is None:
        return glob.glob(pattern, recursive=True)  # noqa: PTH207
    place = place_in(Path(glob.escape(str(folder))), pattern)
    found = glob.glob(str(place), recursive=True)  # noqa: PTH207
    return [_name_in(folder, Path(one)) for one in found]


def _name_in(folder: Path, copy: Path) -> str:
    """Name of a mirrored file: the inverse of :func:`place_in`."""
    first, *rest = copy.relative_to(folder).parts
    if first.startswith("^") and first != "^^":
        first = f"{first[1:]}:\\" if first[1:] else "/"
    return str(Path(*(".." if part == "^^" else part for part in (first, *rest))))


_Identity: TypeAlias = tuple[int, int] | str

_KEEPING: Final[list[dict[_Identity, str]]] = []
"""Notes of each program that keeps some: identity of a file to the name it was read by."""


@contextmanager
def noting_inputs() -> Iterator[Mapping[_Identity, str]]:
    """Keep notes of the files that are read inside the block; names by which they were read.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder, noting_inputs():
    ...     file = Path(folder, "bear.svg")
    ...     _ = file.write_text("<svg/>")
    ...     note_input(file)
    ...     met = input_at(Path(folder, ".", "bear.svg")) == str(file)
    >>> met
    True
    """
    notes: dict[_Identity, str] = {}
    _KEEPING.append(notes)
    try:
        yield notes
    finally:
        # By identity: two empty notes are equal.
        _KEEPING[:] = [kept for kept in _KEEPING if kept is not notes]


def note_input(file: str | Path | int, name: str = "") -> None:
    """Note that a file, or what an open descriptor stands for, is read."""
    for notes in _KEEPING:
        for identity in _identities(file):
            notes.setdefault(identity, name or str(file))


def forget_input(file: str | Path) -> None:
    """Note that a file was read to be changed: it is no input."""
    for notes in _KEEPING:
        for identity in _identities(file):
            notes.pop(identity, None)


def input_at(path: str | Path) -> str | None:
    """Name by which the file at a path was read; None if it was not.

    Links, hard links and, where the disk makes no difference, capitals are seen through.
    """
    for notes in _KEEPING:
        for identity in _identities(path):
            if identity in notes:
                return notes[identity]
    return None


def check_no_input(path: str | Path) -> None:
    """Refuse to write where something was read."""
    read = input_at(path)
    if read is not None:
        known = "" if read == str(path) else f" (as {read})"
        raise WriteError(path, f"is read by this run too{known}; write to another file")


def _identities(file: str | Path | int) -> list[_Identity]:
    """Identities of a file: its number on the disk, and its path where disks have none."""
    try:
        found = os.stat(file)  # noqa: PTH116 - descriptors too
    except (OSError, ValueError):
        return []
    if found.st_ino:
        return [(found.st_dev, found.st_ino)]
    return [] if isinstance(file, int) else [os.path.normcase(os.path.realpath(file))]
