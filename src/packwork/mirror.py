"""Files of another machine, under their names there, in a folder of this one.

A recipe names files as they lie where it was written. What runs it elsewhere is sent their content,
lays it in a folder, and reads through :func:`here_of`: names, and with them all that is written
about a run, stay the same.
"""

from __future__ import annotations

import glob
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path, PurePath

_MIRROR: ContextVar[Path | None] = ContextVar("mirror", default=None)


@contextmanager
def mirrored(folder: Path) -> Iterator[None]:
    """Look for files in a folder first, inside the block."""
    before = _MIRROR.set(folder)
    try:
        yield
    finally:
        _MIRROR.reset(before)


def here_of(path: str | Path) -> Path:
    """Path of this machine for one that is mirrored; the path itself unless it was mirrored.

    Examples
    --------
    >>> here_of("bear.svg").name
    'bear.svg'
    """
    folder = _MIRROR.get()
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
    folder = _MIRROR.get()
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
