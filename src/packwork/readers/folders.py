"""Files of a folder or a pattern: those that can be read, and those that only look so."""

from __future__ import annotations

import logging
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from pathlib import Path

from packwork.errors import ReadError
from packwork.mirror import here_of, names_like
from packwork.phrasing import enumerated

LOOK_LIKE_PICTURES = frozenset(
    f".{ending}"
    for ending in [
        "svg",
        "svgz",
        "png",
        "jpg",
        "jpeg",
        "jfif",
        "webp",
        "gif",
        "bmp",
        "tif",
        "tiff",
        "avif",
        "heic",
        "heif",
        "jxl",
        "jp2",
        "j2k",
        "jpe",
        "apng",
        "ico",
        "icns",
        "psd",
        "psb",
        "xcf",
        "kra",
        "ai",
        "eps",
        "pdf",
        "cdr",
        "emf",
        "wmf",
        "sketch",
        "tga",
        "pcx",
        "ppm",
        "pgm",
        "pbm",
        "pnm",
        "exr",
        "hdr",
        "dds",
        "dxf",
        "qoi",
        "cr2",
        "cr3",
        "nef",
        "arw",
        "dng",
        "raf",
        "orf",
        "rw2",
    ]
)
"""Endings of drawings, pictures and photos of whatever kind, in lower case: what a folder holds
of those and no reader opens is named. Readmes and the like are not."""

MOST_NAMED = 3
"""Files left out that are named one by one on the terminal; a report has all. Chosen."""

_LOG = logging.getLogger("packwork")


@dataclass(frozen=True)
class Listing:
    """What a folder or a pattern holds.

    Parameters
    ----------
    files
        Those whose ending is read, by name.
    unread
        Why others that look like drawings or pictures are not.
    """

    files: list[str]
    unread: list[ReadError]

    def tell(self, source: str) -> None:
        """Notice, in one line, what is left out."""
        if not self.unread:
            return
        names = [f"{Path(one.file).name} ({one.problem})" for one in self.unread]
        _LOG.warning(
            "%s: left out %s; save such files as SVG, PNG or JPEG",
            source, enumerated(names, MOST_NAMED),
        )  # fmt: skip


def listed(folder: Path, endings: Collection[str]) -> Listing:
    """Files in a folder, not in the folders inside; hidden ones are passed over.

    Parameters
    ----------
    endings
        That are read, in lower case.

    Raises
    ------
    ReadError
        If the folder cannot be opened.
    """
    try:
        here = here_of(folder)
        return _sorted_out((folder / each.name for each in here.iterdir()), endings)
    except OSError as error:
        raise ReadError(folder, f"cannot be opened: {error.strerror}") from None


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
