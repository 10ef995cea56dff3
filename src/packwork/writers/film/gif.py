"""Films as GIF: 256 colours for the whole film, and of each frame only what changed.

Pillow makes the blocks of each frame by itself, so that a long film needs no more memory than
its file.
"""

from __future__ import annotations

import io
import logging
import struct

import numpy as np
import numpy.typing as npt
from PIL import Image
from PIL.GifImagePlugin import getdata

from packwork.raster.overlay import Picture
from packwork.writers.film.film import Film, Tell, delays, tell_nobody
from packwork.writers.film.projector import Projector, Rectangle, changes

MAX_FPS = 50.0
"""GIF counts hundredths of a second, and browsers slow down what is shorter than two."""

COLOURS = 255
"""One of 256 stays for what is clear or has not changed."""

CLEAR = 255

EXACT = 96
"""So many colours, those of the most pixels, are kept as they are; the rest of the palette
shares out what lies between. Fewer shift the colours of areas, more coarsen soft edges and
photographs. Tried."""

BITS = 6
"""Of each channel, by which a colour is looked up. More take eight times the memory each."""

_HALF = 128
_HUNDREDTHS = 100

_Indices = npt.NDArray[np.uint8]
_LOG = logging.getLogger(__name__)


def gif_bytes(film: Film, tell: Tell = tell_nobody) -> bytes:
    """GIF file of a film; at most ``MAX_FPS`` frames a second."""
    film = _slowed(film)
    projector = Projector(film)
    palette = _palette(projector, film)
    lookup = _lookup(palette)
    frame, options = projector.frame, film.options
    out = io.BytesIO()
    out.write(_head(frame.columns, frame.rows, palette, options.loop != "once"))
    indexed = (_indices(picture, lookup) for picture in projector.pictures(tell))
    shown = delays(film.seconds, _HUNDREDTHS)
    for delay, (pixels, changed, part) in zip(shown, changes(indexed), strict=True):
        if film.is_opaque:
            pixels = np.where(changed, pixels, CLEAR)[part.rows, part.columns].astype(np.uint8)
        else:
            # What was shown is cleared before.
            part = Rectangle(0, 0, *pixels.shape)
        out.write(_image(pixels, (part.left, part.top), delay, 1 if film.is_opaque else 2))
    out.write(b";")
    return out.getvalue()


def _slowed(film: Film) -> Film:
    options = film.options
    if options.fps <= MAX_FPS:
        return film
    _LOG.warning("GIF: %g pictures a second instead of %g: it knows no more", MAX_FPS, options.fps)
    slower = options.model_copy(update={"fps": MAX_FPS})
    return Film(film.layout, slower, film.background, film.show_container)


def _palette(projector: Projector, film: Film) -> npt.NDArray[np.uint8]:
    """``(COLOURS, 3)`` colours of the first and the last frame."""
    seen = [projector.picture(film.frames[k]) for k in (0, film.arrival)]
    pixels = np.concatenate([picture[picture[:, :, 3] >= _HALF][:, :3] for picture in seen])
    if len(pixels) == 0:
        return np.zeros((COLOURS, 3), np.uint8)
    packed = pixels.astype(np.uint32) @ np.array([65_536, 256, 1], np.uint32)
    values, counts = np.unique(packed, return_counts=True)
    common = values[np.argsort(-counts.astype(np.int64), kind="stable")][:EXACT]
    exact = np.column_stack([common >> 16, common >> 8 & 255, common & 255]).astype(np.uint8)
    strip = Image.fromarray(pixels[None], "RGB")
    mixed = strip.quantize(COLOURS - len(exact), method=Image.Quantize.MEDIANCUT).getpalette() or []
    rest = np.array(mixed, np.uint8).reshape(-1, 3)[: COLOURS - len(exact)]
    whole = np.concatenate([exact, rest])
    return np.pad(whole, ((0, COLOURS - len(whole)), (0, 0)), mode="edge")


def _lookup(palette: npt.NDArray[np.uint8]) -> _Indices:
    """Nearest palette entry of each colour, told apart by ``BITS`` bits of a channel."""
    levels = (np.arange(2**BITS) + 0.5) * 2 ** (8 - BITS) - 0.5
    cells = np.stack(np.meshgrid(levels, levels, levels, indexing="ij"), axis=-1).reshape(-1, 3)
    # Takes a quarter of a second to load, and most runs write no film.
    from scipy.spatial import KDTree

    nearest: _Indices = KDTree(palette.astype(np.float64)).query(cells)[1].astype(np.uint8)
    # What is in the palette is met exactly, whatever else lies in its cell.
    for k in range(len(palette) - 1, -1, -1):
        nearest[_cell(palette[k])] = k
    return nearest


def _cell(colours: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint32]:
    coarse = (colours >> (8 - BITS)).astype(np.uint32)
    return np.asarray((coarse[..., 0] << 2 * BITS) | (coarse[..., 1] << BITS) | coarse[..., 2])


def _indices(picture: Picture, lookup: _Indices) -> _Indices:
    indices = lookup[_cell(picture)]
    indices[picture[:, :, 3] < _HALF] = CLEAR
    return indices


def _head(width: int, height: int, palette: npt.NDArray[np.uint8], loop: bool) -> bytes:
    table = np.zeros((256, 3), np.uint8)
    table[:COLOURS] = palette
    head = b"GIF89a" + struct.pack("<HHBBB", width, height, 0xF7, CLEAR, 0) + table.tobytes()
    return head + (b"!\xff\x0bNETSCAPE2.0\x03\x01\0\0\0" if loop else b"")


def _image(pixels: _Indices, corner: tuple[int, int], delay: int, disposal: int) -> bytes:
    """Control and image blocks of one frame, which goes by the palette of all."""
    blocks = getdata(
        Image.fromarray(pixels, "P"), corner,
        duration=1_000 * delay // _HUNDREDTHS, disposal=disposal, transparency=CLEAR,
    )  # fmt: skip
    return b"".join(blocks)
