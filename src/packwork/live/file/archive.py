"""A session's file: one zip of parts, its sizes bounded before anything is unpacked."""

from __future__ import annotations

import contextlib
import io
import re
import zipfile
import zlib
from collections.abc import Iterator, Mapping

from packwork.readers.reading import UnfitError

MOST_BYTES = 1_000_000_000
"""Of a session file, packed and unpacked. Chosen: two hundred photographs."""

MOST_PART_BYTES = 120_000_000
"""Of one part unpacked: the large and the small copy of a photograph, or six million numbers.
Larger takes gigabytes once it is read. Derived."""

EASILY_UNPACKED, MOST_FOLD = 100_000_000, 50
"""Bytes that any file may unpack to, and how many times its own size a larger one may: photographs
and coordinates are packed by less than ten. Larger lets a small file fill the memory. Chosen."""

MOST_PARTS = 100_010
"""As many items as a layout may have, and a few. Chosen."""

PART = re.compile(r"session\.json|(items|containers)/[0-9a-f]{64}\.json|fonts/[0-9a-f]{64}")
"""Names of parts; no others are read."""

_STILL = (1980, 1, 1, 0, 0, 0)
"""Time of all parts: the same session gives the same bytes."""


def packed(parts: Mapping[str, bytes]) -> bytes:
    """A zip of parts by their paths.

    Examples
    --------
    >>> parts = {"session.json": b"{}"}
    >>> unpacked(packed(parts)) == parts
    True
    """
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in parts.items():
            archive.writestr(zipfile.ZipInfo(name, _STILL), data, zipfile.ZIP_DEFLATED)
    return file.getvalue()


def unpacked(data: bytes) -> Mapping[str, bytes]:
    """Parts of a zip, each unpacked whenever it is asked for, so that never all are in memory.

    Raises
    ------
    UnfitError
        If it is none, is spoilt, or holds more or larger parts than a session has; of a part, when
        it is asked for.
    """
    return _Parts(data)


class _Parts(Mapping[str, bytes]):
    def __init__(self, data: bytes) -> None:
        with _refusing():
            self._archive = zipfile.ZipFile(io.BytesIO(data))
            self._infos = {info.filename: info for info in self._archive.infolist()}
            _check(self._archive.infolist(), len(data))

    def __getitem__(self, name: str) -> bytes:
        info = self._infos[name]
        with _refusing():
            return _read(self._archive, info)

    def __iter__(self) -> Iterator[str]:
        return iter(self._infos)

    def __len__(self) -> int:
        return len(self._infos)


@contextlib.contextmanager
def _refusing() -> Iterator[None]:
    try:
        yield
    except UnfitError:
        raise
    except (
        zipfile.BadZipFile, zlib.error, EOFError, ValueError, OverflowError, NotImplementedError,
        RuntimeError, OSError, KeyError, IndexError, UnicodeDecodeError,
    ) as error:  # fmt: skip
        raise UnfitError(f"is no session file, or a spoilt one ({str(error)[:80]})") from None


def _check(infos: list[zipfile.ZipInfo], size: int) -> None:
    names = [info.filename for info in infos]
    if len(infos) > MOST_PARTS or len(set(names)) < len(names):
        raise UnfitError(f"holds {len(infos)} parts; {MOST_PARTS} different ones go")
    strange = next((name for name in names if not PART.fullmatch(name)), None)
    if strange is not None:
        raise UnfitError(f"holds {strange[:60]!r}, which is no part of a session")
    if any(info.flag_bits & 0x1 for info in infos):
        raise UnfitError("is locked by a password")
    if "session.json" not in names:
        raise UnfitError("is no session file: it has no session.json")
    most = min(MOST_BYTES, max(EASILY_UNPACKED, MOST_FOLD * size))
    if sum(info.file_size for info in infos) > most:
        raise UnfitError(f"unpacks to more than {most // 1_000_000} MB, the most for its size")


def _read(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> bytes:
    if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise UnfitError("is packed in a way that session files are not")
    with archive.open(info) as part:
        data = part.read(MOST_PART_BYTES + 1)
    if len(data) > MOST_PART_BYTES:
        raise UnfitError(f"holds a part of more than {MOST_PART_BYTES // 1_000_000} MB")
    return data
