"""A session's file: one zip of parts, its sizes bounded before anything is unpacked."""

from __future__ import annotations

import io
import re
import zipfile
import zlib
from collections.abc import Mapping

from packwork.readers.unfit import UnfitError

MOST_BYTES = 1_000_000_000
"""Of a session file, packed and unpacked. Chosen: two hundred photographs."""

MOST_PART_BYTES = 200_000_000
"""Of one part unpacked. Larger takes gigabytes once it is read. Chosen."""

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


def unpacked(data: bytes) -> dict[str, bytes]:
    """Parts of a zip.

    Raises
    ------
    UnfitError
        If it is none, is spoilt, or holds more or larger parts than a session has.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            infos = archive.infolist()
            _check(infos)
            return {info.filename: _read(archive, info) for info in infos}
    except UnfitError:
        raise
    except (
        zipfile.BadZipFile, zlib.error, EOFError, ValueError, OverflowError, NotImplementedError,
        RuntimeError, OSError, KeyError, IndexError, UnicodeDecodeError,
    ) as error:  # fmt: skip
        raise UnfitError(f"is no session file, or a spoilt one ({str(error)[:80]})") from None


def _check(infos: list[zipfile.ZipInfo]) -> None:
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
    if sum(info.file_size for info in infos) > MOST_BYTES:
        raise UnfitError(f"unpacks to more than {MOST_BYTES // 1_000_000} MB")


def _read(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> bytes:
    if info.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise UnfitError("is packed in a way that session files are not")
    with archive.open(info) as part:
        data = part.read(MOST_PART_BYTES + 1)
    if len(data) > MOST_PART_BYTES:
        raise UnfitError(f"holds a part of more than {MOST_PART_BYTES // 1_000_000} MB")
    return data
