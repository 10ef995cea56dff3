"""Films as animated WebP: small, every colour, and of each frame only where it changed."""

from __future__ import annotations

import struct

import numpy as np
from PIL import Image

from packwork.raster.drawing import encoded_picture
from packwork.raster.overlay import Picture
from packwork.writers.film.film import Film, Tell, delays, tell_nobody
from packwork.writers.film.projector import Projector, Rectangle, changes

QUALITY = 85
"""Of WebP, 0 to 100. Larger: larger files; smaller: rings about edges. Chosen by eye."""

METHOD = 1
"""Effort of WebP, 0 to 6. More: a little smaller, several times the time. Tried."""

_ANIMATED, _ALPHA = 0x02, 0x10
_REPLACES = 0x02
_PICTURE_CHUNKS = (b"ALPH", b"VP8 ", b"VP8L")
_MILLISECONDS = 1_000
_LONGEST_MS = 2**24 - 1


def webp_bytes(film: Film, tell: Tell = tell_nobody) -> bytes:
    """WebP file of a film."""
    projector = Projector(film)
    frame = projector.frame
    shown = delays(film.seconds, _MILLISECONDS)
    flags = _ANIMATED | (0 if film.is_opaque else _ALPHA)
    size = _three(frame.columns - 1) + _three(frame.rows - 1)
    chunks = [
        _chunk(b"VP8X", bytes([flags, 0, 0, 0]) + size),
        _chunk(b"ANIM", bytes(4) + struct.pack("<H", int(film.options.loop == "once"))),
    ]
    frames = changes(projector.pictures(tell))
    for delay, (picture, _, changed) in zip(shown, frames, strict=True):
        # Rectangles begin at even places.
        part = Rectangle(changed.top & ~1, changed.left & ~1, changed.bottom, changed.right)
        pixels = picture[part.rows, part.columns]
        chunks.append(_chunk(b"ANMF", _frame(part, pixels, delay, film.is_opaque)))
    body = b"WEBP" + b"".join(chunks)
    return b"RIFF" + struct.pack("<I", len(body)) + body


def _frame(part: Rectangle, pixels: Picture, delay: int, is_opaque: bool) -> bytes:
    size = _three(part.right - part.left - 1) + _three(part.bottom - part.top - 1)
    place = _three(part.left // 2) + _three(part.top // 2)
    head = place + size + _three(min(delay, _LONGEST_MS)) + bytes([_REPLACES])
    return head + _compressed(pixels, is_opaque)


def _compressed(pixels: Picture, is_opaque: bool) -> bytes:
    """Chunks of the picture itself, out of the file that Pillow makes of it."""
    seen = Image.fromarray(np.ascontiguousarray(pixels[:, :, :3] if is_opaque else pixels))
    webp = encoded_picture(seen, "WEBP", quality=QUALITY, method=METHOD)
    place, found = 12, []
    while place < len(webp):
        (length,) = struct.unpack("<I", webp[place + 4 : place + 8])
        after = place + 8 + length + length % 2
        if webp[place : place + 4] in _PICTURE_CHUNKS:
            found.append(webp[place:after])
        place = after
    return b"".join(found)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return kind + struct.pack("<I", len(data)) + data + bytes(len(data) % 2)


def _three(number: int) -> bytes:
    return number.to_bytes(3, "little")
