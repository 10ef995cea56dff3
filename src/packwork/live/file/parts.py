"""Parts of a session file as they lie in it, each packed once."""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Mapping
from typing import NamedTuple

MOST_FOLD = 50
"""Times its own size that a large file may unpack to: photographs and coordinates are packed by
less than ten. Larger lets a small file fill the memory. Chosen."""

_STILL = (1980, 1, 1, 0, 0, 0)
"""Time of all parts: the same session gives the same bytes."""


class PackedPart(NamedTuple):
    """Packed content, its bytes once unpacked, and the CRC-32 of these."""

    packed: bytes
    size: int
    crc: int


def part_of(content: bytes, level: int = zlib.Z_DEFAULT_COMPRESSION) -> PackedPart:
    """A part of a content, at most ``MOST_FOLD`` times as large as it is packed.

    Examples
    --------
    >>> len(part_of(b" " * 1_000_000).packed) < 130_000
    True
    """
    packed = _deflated(content, level, zlib.Z_DEFAULT_STRATEGY)
    if len(content) > MOST_FOLD * len(packed):
        # Each letter takes a bit then, at least: an eighth of all.
        packed = _deflated(content, level, zlib.Z_HUFFMAN_ONLY)
    return PackedPart(packed, len(content), zlib.crc32(content))


def _deflated(content: bytes, level: int, strategy: int) -> bytes:
    deflating = zlib.compressobj(level, wbits=-zlib.MAX_WBITS, strategy=strategy)
    return deflating.compress(content) + deflating.flush()


def packed(parts: Mapping[str, PackedPart]) -> bytes:
    """A zip of parts by their paths."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, part in parts.items():
            info = zipfile.ZipInfo(name, _STILL)
            archive.writestr(info, part.packed)
            info.compress_type, info.file_size, info.CRC = zipfile.ZIP_DEFLATED, part.size, part.crc
            # The head that says so is as long as that of a part which is not packed.
            file.seek(info.header_offset)
            file.write(info.FileHeader(zip64=False))
            file.seek(0, io.SEEK_END)
    return file.getvalue()
