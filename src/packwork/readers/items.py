"""Items from files, folders, patterns and built-in names."""

from __future__ import annotations

import glob
import logging
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from packwork.errors import ReadError
from packwork.readers.builtin import ALL_ICONS, builtin_item, icon_names, item_names
from packwork.readers.files import exists, is_folder
from packwork.readers.folders import Listing, listed, matched
from packwork.readers.memory.items import items_in_memory
from packwork.readers.options import ReadOptions
from packwork.readers.pages import Read, agreed
from packwork.readers.pictures.decode import PICTURE_ENDINGS
from packwork.readers.pictures.silhouette import read_picture
from packwork.readers.regions import Holes
from packwork.readers.svg.item import read_svg
from packwork.recipe_paths import BUILTIN
from packwork.scene.item import Item
from packwork.shelf import shelved

_LOG = logging.getLogger("packwork")

_READERS: dict[str, Callable[[str, Holes, ReadOptions], Read]] = {
    ".svg": read_svg,
    ".svgz": read_svg,
    **dict.fromkeys(PICTURE_ENDINGS, read_picture),
}


@dataclass(frozen=True)
class ItemsRead:
    """What came of reading.

    Parameters
    ----------
    items
        In the order of the sources, files of a folder by name.
    skipped
        Why files among many were left out.
    """

    items: tuple[Item, ...]
    skipped: tuple[ReadError, ...]


@dataclass(frozen=True)
class _Asked:
    """What is asked of all files of a run."""

    holes: Holes
    reading: ReadOptions
    strict: bool

    def read(self, file: str) -> Read:
        """One file, by the reader of its ending."""
        return _READERS[Path(file).suffix.lower()](file, self.holes, self.reading)


_ReadAndRefused: TypeAlias = tuple[list[Read], list[ReadError]]


def read_items(
    sources: str | Path | Iterable[str | Path],
    *,
    holes: Holes = "fill",
    strict: bool = False,
    reading: ReadOptions | None = None,
) -> ItemsRead:
    """Items of files, folders (not the folders inside), patterns and built-in names.

    A path that exists wins over a built-in name; ``builtin:star`` is never a path. A file
    named by itself must be usable; one among many of a folder or a pattern is skipped
    with a warning if it is not.

    Parameters
    ----------
    sources
        One or several; ``icons`` stands for all the bundled icons.
    holes
        Whether outlines are silhouettes (``fill``) or keep their holes (``keep``).
    strict
        Whether an unusable file among many is an error too.
    reading
        How files are understood; by themselves if None.

    Raises
    ------
    ReadError
        If a source does not exist or gives no item at all.

    Examples
    --------
    >>> [item.name for item in read_items(["circle", "star"]).items]
    ['circle', 'star']
    """
    many = [sources] if isinstance(sources, str | Path) else list(sources)
    asked = _Asked(holes, reading or ReadOptions(), strict)
    reads: list[Read] = []
    skipped: list[ReadError] = []
    for source in many:
        found, left_out = _read_source(str(source), asked)
        reads += found
        skipped += left_out
    if not reads:
        raise ReadError("items", "none were given; give a file, a folder or a built-in name")
    return ItemsRead(tuple(agreed(reads)), tuple(skipped))


def _read_source(source: str, asked: _Asked) -> _ReadAndRefused:
    if not source.strip():
        # As a path it would stand for the whole of the working folder.
        raise ReadError("items", "an empty name stands for nothing; give a file or a folder")
    if (made := items_in_memory(shelved(source), source, asked.holes)) is not None:
        return [Read(item) for item in made], []
    if source.startswith(BUILTIN):
        return _built_in(source.removeprefix(BUILTIN), asked)
    path = Path(source)
    if is_folder(path):
        if source in {ALL_ICONS, *item_names()}:
            _LOG.warning("%s: the folder here is meant; %s%s is bundled", source, BUILTIN, source)
        return _read_many(source, listed(path, _READERS), asked)
    if path.suffix.lower() in _READERS and (exists(path) or not glob.has_magic(source)):
        return [asked.read(source)], []
    if glob.has_magic(source):
        return _read_many(source, matched(source, _READERS), asked)
    if exists(path) or len(path.parts) > 1:
        raise ReadError(source, _why_not(path))
    return _built_in(source, asked)


def _built_in(name: str, asked: _Asked) -> _ReadAndRefused:
    names = icon_names() if name == ALL_ICONS else [name]
    return [Read(builtin_item(n, asked.holes)) for n in names], []


def _read_many(source: str, listing: Listing, asked: _Asked) -> _ReadAndRefused:
    if asked.strict and listing.unread:
        raise listing.unread[0]
    reads: list[Read] = []
    skipped: list[ReadError] = []
    for file in listing.files:
        try:
            reads.append(asked.read(file))
        except ReadError as error:
            if asked.strict:
                raise
            skipped.append(error)
    if not reads:
        raise ReadError(source, _why_none([*skipped, *listing.unread]))
    for refusal in skipped:
        _LOG.warning("left out %s", refusal)
    listing.tell(source)
    return reads, [*skipped, *listing.unread]


def _why_not(path: Path) -> str:
    if not exists(path):
        return "there is no such file"
    endings = ", ".join(_READERS)
    return f"has the unknown ending {path.suffix!r}; items are files in {endings}"


def _why_none(skipped: list[ReadError]) -> str:
    if not skipped:
        return f"holds no file that could be an item; those end in {', '.join(_READERS)}"
    first = skipped[0]
    if len(skipped) == 1:
        return f"its one file cannot be used, {first}"
    return f"none of {len(skipped)} files can be used; the first, {first}"
