"""Files of a folder or a pattern: those that can be read, and those that only look so."""

from __future__ import annotations

import logging
import os
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from pathlib import Path

import numpy as np

from packwork.errors import ReadError
from packwork.phrasing import enumerated
from packwork.readers.reading import stem
from packwork.sources import here_of, names_like

LOOK_LIKE_PICTURES = frozenset(f".{ending}" for ending in (
    "svg", "svgz", "png", "jpg", "jpeg", "jfif", "webp", "gif", "bmp", "tif", "tiff", "avif",
    "heic", "heif", "jxl", "jp2", "j2k", "jpe", "apng", "ico", "icns", "psd", "psb", "xcf",
    "kra", "ai", "eps", "pdf", "cdr", "emf", "wmf", "sketch", "tga", "pcx", "ppm", "pgm", "pbm",
    "pnm", "exr", "hdr", "dds", "dxf", "qoi", "cr2", "cr3", "nef", "arw", "dng", "raf", "orf",
    "rw2",
))  # fmt: skip
"""Endings of drawings, pictures and photos of whatever kind, in lower case: what a folder holds
of those and no reader opens is named. Readmes and the like are not."""

MOST_FILES = 100_000
"""Files in the folders of a folder at most. Larger waits longer where a whole disk is named.
Chosen."""

_LOG = logging.getLogger("packwork")


@dataclass(frozen=True)
class Listing:
    """Files of a folder or a pattern whose ending is read, by name; others that look like drawings.

    ``inner`` are the folders in a folder that hold such files too, and are not read.
    """

    files: list[str]
    unread: list[ReadError]
    inner: tuple[str, ...] = ()

    def tell(self, source: str) -> None:
        """Notice, a line each, what is left out."""
        if self.inner:
            _LOG.warning(
                "%s: the folders in it (%s) are not read; '%s' reads all",
                source, enumerated(self.inner), Path(source, "**", "*"),
            )  # fmt: skip
        if not self.unread:
            return
        names = [f"{Path(one.file).name} ({one.problem})" for one in self.unread]
        _LOG.warning(
            "%s: left out %s; save such files as SVG, PNG or JPEG",
            source, enumerated(names),
        )  # fmt: skip


def listed(folder: Path, endings: Collection[str]) -> Listing:
    """Files in a folder that are not hidden; where it holds none, those in the folders inside."""
    try:
        here = here_of(folder)
        found = _sorted_out((folder / each.name for each in here.iterdir()), endings)
        if not found.files:
            inside = _sorted_out(_below(folder, here), endings)
            return inside if inside.files else found
        folders = sorted(each for each in here.iterdir() if _is_open(each) and each.is_dir())
        inner = [each.name for each in folders if _holds(each, endings)]
        return replace(found, inner=tuple(inner))
    except OSError as error:
        raise ReadError(folder, f"cannot be opened: {error.strerror}") from None


def _is_open(path: Path) -> bool:
    return not path.name.startswith(".")


def _holds(folder: Path, endings: Collection[str]) -> bool:
    """Whether a file that is read lies in a folder; not if it cannot be opened."""
    try:
        return any(_is_open(each) and each.suffix.lower() in endings for each in folder.iterdir())
    except OSError:
        return False


def _below(folder: Path, here: Path) -> Iterator[Path]:
    met = 0
    for place, folders, names in os.walk(here):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        met += len(names)
        if met > MOST_FILES:
            raise ReadError(
                folder, f"holds more than {MOST_FILES:,} files in its folders; name one of these"
            )
        yield from (folder / Path(place).relative_to(here) / name for name in names)


def matched(pattern: str, endings: Collection[str]) -> Listing:
    """Files that a pattern names."""
    return _sorted_out(map(Path, names_like(pattern)), endings)


def _sorted_out(paths: Iterable[Path], endings: Collection[str]) -> Listing:
    files: list[str] = []
    unread: list[ReadError] = []
    for path in sorted(paths):
        ending = path.suffix.lower()
        if path.name.startswith("."):
            continue
        if ending in endings and here_of(path).is_file():
            files.append(str(path))
        elif path.is_symlink() and not path.exists():
            unread.append(ReadError(path, "a link to nothing"))
        elif ending in LOOK_LIKE_PICTURES and not path.is_dir():
            unread.append(ReadError(path, f"{ending} is not read"))
    return Listing(sorted(files), unread)


@dataclass(frozen=True)
class Sample:
    """Choice of some of many items, drawn by a seed, or the first of them.

    All of a plain name in ``wanted`` are taken before others, and one of a pattern.
    """

    most: int
    seed: int | None = None
    wanted: tuple[str, ...] = ()

    def order(self, names: Sequence[str]) -> list[int]:
        """Indices of names in the order in which they are taken.

        Examples
        --------
        >>> names = ["ant", "bee", "cat", "dog"]
        >>> Sample(2).order(names), Sample(2, wanted=("dog", "b*")).order(names)
        ([0, 1, 2, 3], [3, 1, 0, 2])
        """
        count = len(names)
        drawn = range(count)
        if self.seed is not None:
            drawn = np.random.default_rng(self.seed).permutation(count).tolist()
        first: list[int] = []
        for pattern in self.wanted:
            hits = [k for k in drawn if fnmatchcase(names[k], pattern)]
            first += hits if all(names[k] == pattern for k in hits) else hits[:1]
        return list(dict.fromkeys([*first, *drawn]))

    def order_of_files(self, files: Sequence[str], alone: Sequence[int], most: int) -> list[int]:
        """Indices of files: those named by themselves first, unless these are too many."""
        drawn = self.order([stem(file) for file in files])
        return list(dict.fromkeys([*(alone if len(alone) <= most else ()), *drawn]))

    def tell(self, sources: Sequence[str], of: int) -> None:
        """Notice that not all are taken."""
        how = "the first by name"
        if self.seed is not None:
            how = "drawn by the seed; --items-from first takes the first"
        _LOG.warning("%s: %s", enumerated(sources), f"{self.most:,} of {of:,} are taken, {how}")
