"""Films as animated PNG: every colour, and of each frame only what changed."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Iterator

import numpy as np
from PIL import Image

from packwork.raster.drawing import encoded_picture
from packwork.raster.overlay import Picture
from packwork.writers.film.film import Film, Tell, delays, tell_nobody
from packwork.writers.film.projector import Projector, Rectangle, changes

COMPRESSION = 4
"""Of zlib, 1 to 9. More: a twentieth smaller, twice the time. Tried."""

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_RGBA = 6
_SOURCE, _OVER = 0, 1
_MILLISECONDS = 1_000


def apng_bytes(film: Film, tell: Tell = tell_nobody) -> bytes:
    """APNG file of a film; programs that know no films show the first frame."""
    projector, options = Projector(film), film.options
    frame = projector.frame
    out = io.BytesIO()
    size = struct.pack(">II", frame.columns, frame.rows)
    out.write(_SIGNATURE + _chunk(b"IHDR", size + bytes([8, _RGBA, 0, 0, 0])))
    out.write(_chunk(b"acTL", struct.pack(">II", options.frames, 0 if options.loop else 1)))
    shown = delays(options, _MILLISECONDS)
    number = 0
    for k, (picture, changed, part) in enumerate(changes(projector.pictures(tell))):
        pixels = picture[part.rows, part.columns]
        if film.is_opaque:
            # Clear where nothing changed.
            pixels = np.where(changed[part.rows, part.columns, None], pixels, np.uint8(0))
        blend = _OVER if film.is_opaque and k else _SOURCE
        out.write(_chunk(b"fcTL", struct.pack(">I", number) + _control(part, shown[k], blend)))
        number += 1
        for data in _compressed(pixels):
            if k == 0:
                out.write(_chunk(b"IDAT", data))
                continue
            out.write(_chunk(b"fdAT", struct.pack(">I", number) + data))
            number += 1
    out.write(_chunk(b"IEND", b""))
    return out.getvalue()


def _control(part: Rectangle, delay: int, blend: int) -> bytes:
    size = part.right - part.left, part.bottom - part.top
    times = struct.pack(">HH", min(delay, 65_535), _MILLISECONDS)
    return struct.pack(">IIII", *size, part.left, part.top) + times + bytes([0, blend])


def _compressed(pixels: Picture) -> Iterator[bytes]:
    """Data of the chunks in which Pillow puts a picture."""
    drawn = Image.fromarray(np.ascontiguousarray(pixels), "RGBA")
    png = encoded_picture(drawn, "PNG", compress_level=COMPRESSION)
    place = len(_SIGNATURE)
    while place < len(png):
        (length,) = struct.unpack(">I", png[place : place + 4])
        if png[place + 4 : place + 8] == b"IDAT":
            yield png[place + 8 : place + 8 + length]
        place += length + 12


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
