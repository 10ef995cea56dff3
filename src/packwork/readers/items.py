"""Items from files, folders, patterns and built-in names."""

from __future__ import annotations

import glob
import logging
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from packwork.errors import ReadError
from packwork.readers.builtin import ALL_ICONS, builtin_item, icon_names, item_names
from packwork.readers.engraving import Engraving
from packwork.readers.folders import Listing, Sample, listed, matched
from packwork.readers.memory.items import items_in_memory
from packwork.readers.options import ReadOptions
from packwork.readers.pages import Read, with_pages_alike
from packwork.readers.pictures.decode import PICTURE_ENDINGS
from packwork.readers.pictures.silhouette import read_picture
from packwork.readers.reading import exists, is_folder
from packwork.readers.regions import Holes
from packwork.readers.svg.item import read_svg
from packwork.recipe_paths import BUILTIN
from packwork.scene.item import Item
from packwork.sources import stored

_LOG = logging.getLogger("packwork")

_ONE_EACH: dict[str, Callable[[str, Holes, ReadOptions], Read]] = {
    ".svg": read_svg,
    ".svgz": read_svg,
    **dict.fromkeys(PICTURE_ENDINGS, read_picture),
}


def _read_dxf(file: str, holes: Holes, engraving: Engraving) -> Sequence[Read]:
    # Loads what no other file needs.
    from packwork.readers.dxf.item import read_dxf

    return read_dxf(file, holes, engraving)


def _read_lines(file: str, holes: Holes, engraving: Engraving) -> Sequence[Read]:
    # The same.
    from packwork.readers.line_drawings import read_line_drawing

    return read_line_drawing(file, holes, engraving)


_Several: TypeAlias = dict[str, Callable[[str, Holes, Engraving], Sequence[Read]]]

_SEVERAL: _Several = {".dxf": _read_dxf}
"""Readers of files that hold several items."""

_FOR_MACHINES: _Several = {**_SEVERAL, ".svg": _read_lines, ".svgz": _read_lines}
"""The same where items are cut by their lines."""

_ENDINGS = (*_ONE_EACH, *_SEVERAL)


@dataclass(frozen=True)
class ItemsRead:
    """Items in the order of their sources, and files among many that were left out."""

    items: tuple[Item, ...]
    skipped: tuple[ReadError, ...]


@dataclass(frozen=True)
class _Asked:
    """Options of reading all files of a run."""

    holes: Holes
    reading: ReadOptions
    strict: bool
    engraving: Engraving | None

    def read(self, file: str) -> Sequence[Read]:
        """Items of one file, by the reader of its ending."""
        ending = Path(file).suffix.lower()
        several = _SEVERAL if self.engraving is None else _FOR_MACHINES
        if ending in several:
            return several[ending](file, self.holes, self.engraving or Engraving())
        return [_ONE_EACH[ending](file, self.holes, self.reading)]


@dataclass(frozen=True)
class _Source:
    """Meaning of a source: items at once, or files that are yet to be read.

    ``listing`` is that of a folder or a pattern; a file without one must be usable.
    """

    name: str
    reads: tuple[Read, ...] = ()
    files: tuple[str, ...] = ()
    listing: Listing | None = None


def read_items(
    sources: str | Path | Iterable[str | Path],
    *,
    holes: Holes = "fill",
    strict: bool = False,
    reading: ReadOptions | None = None,
    sample: Sample | None = None,
    engraving: Engraving | None = None,
) -> ItemsRead:
    """Items of files, folders, patterns and built-in names.

    Of a folder without such files those in the folders inside are read.

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
    sample
        Which are taken where there are more files than are needed; no others are read. Of files
        named by themselves all are, unless these alone are too many.
    engraving
        What of them is engraved, where SVGs are drawings for a machine, which follows their lines.

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
    asked = _Asked(holes, reading or ReadOptions(), strict, engraving)
    found = [_found(str(source), asked) for source in many]
    listings = [one.listing for one in found if one.listing is not None]
    unread = [error for listing in listings for error in listing.unread]
    if strict and unread:
        raise unread[0]
    reads, skipped = _read_all(found, asked, sample)
    for listing, source in ((one.listing, one.name) for one in found if one.listing is not None):
        listing.tell(source)
    if not reads:
        raise ReadError("items", "none were given; give a file, a folder or a built-in name")
    return ItemsRead(tuple(with_pages_alike(reads)), (*skipped, *unread))


def is_several(source: str) -> bool:
    """Whether a source is a folder or a pattern.

    Examples
    --------
    >>> is_several("icons/*.svg"), is_several("star")
    (True, False)
    """
    return is_folder(source) or (glob.has_magic(source) and not exists(source))


def _found(source: str, asked: _Asked) -> _Source:
    if not source.strip():
        # As a path it would stand for the whole of the working folder.
        raise ReadError("items", "an empty name stands for nothing; give a file or a folder")
    if (made := items_in_memory(stored(source), source, asked.holes)) is not None:
        return _Source(source, tuple(Read(item) for item in made))
    if source.startswith(BUILTIN):
        return _built_in(source.removeprefix(BUILTIN), asked)
    path = Path(source)
    if is_folder(path):
        if source in {ALL_ICONS, *item_names()}:
            _LOG.warning("%s: the folder here is meant; %s%s is bundled", source, BUILTIN, source)
        return _several(source, listed(path, _ENDINGS))
    if path.suffix.lower() in _ENDINGS and (exists(path) or not glob.has_magic(source)):
        return _Source(source, files=(source,))
    if glob.has_magic(source):
        return _several(source, matched(source, _ENDINGS))
    if exists(path) or len(path.parts) > 1:
        raise ReadError(source, _why_not(path))
    return _built_in(source, asked)


def _built_in(name: str, asked: _Asked) -> _Source:
    names = icon_names() if name == ALL_ICONS else [name]
    return _Source(name, tuple(Read(builtin_item(n, asked.holes)) for n in names))


def _several(source: str, listing: Listing) -> _Source:
    if not listing.files:
        raise ReadError(source, _why_none(listing.unread))
    return _Source(source, files=tuple(listing.files), listing=listing)


def _read_all(
    sources: Sequence[_Source], asked: _Asked, sample: Sample | None
) -> tuple[list[Read], list[ReadError]]:
    """Items of all sources in their order, and files among many that are no items."""
    files = [(k, file) for k, source in enumerate(sources) for file in source.files]
    at_once = sum(len(source.reads) for source in sources)
    order, most = list(range(len(files))), len(files)
    if sample is not None and at_once + len(files) > sample.most:
        most = max(sample.most - at_once, 0)
        alone = [k for k, (number, _) in enumerate(files) if sources[number].listing is None]
        order = sample.order_of_files([file for _, file in files], alone, most)
    reads: dict[int, Sequence[Read]] = {}
    refused: dict[int, ReadError] = {}
    for k in order:
        if len(reads) == most:
            break
        number, file = files[k]
        try:
            reads[k] = asked.read(file)
        except ReadError as error:
            if asked.strict or sources[number].listing is None:
                raise
            refused[k] = error
    for number, source in enumerate(sources):
        own = [k for k, (of, _) in enumerate(files) if of == number]
        if own and source.listing is not None and all(k in refused for k in own):
            why = _why_none([*(refused[k] for k in own), *source.listing.unread])
            raise ReadError(source.name, why)
    skipped = [refused[k] for k in sorted(refused)]
    for refusal in skipped:
        _LOG.warning("left out %s", refusal)
    if sample is not None and len(reads) + len(refused) < len(files):
        sample.tell([one.name for one in sources if one.files], at_once + len(files))
    made = [
        read
        for number, source in enumerate(sources)
        for read in (
            *source.reads,
            *(read for k in sorted(reads) if files[k][0] == number for read in reads[k]),
        )
    ]
    return made, skipped


def _why_not(path: Path) -> str:
    if not exists(path):
        return "there is no such file"
    endings = ", ".join(_ENDINGS)
    return f"has the unknown ending {path.suffix!r}; items are files in {endings}"


def _why_none(skipped: list[ReadError]) -> str:
    if not skipped:
        return f"holds no file that could be an item; those end in {', '.join(_ENDINGS)}"
    first = skipped[0]
    if len(skipped) == 1:
        return f"its one file cannot be used, {first}"
    return f"none of {len(skipped)} files can be used; the first, {first}"
