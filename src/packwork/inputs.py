"""Files that a program has read, so that no result is written over one of them.

Readers note what they open, writers ask before they write: nothing has to be foreseen of
folders, patterns or files that name other files. Only programs that say so keep notes.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Final, TypeAlias

from packwork.errors import WriteError

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
    """Refuse to write where something was read.

    Raises
    ------
    WriteError
        Naming the input.
    """
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
