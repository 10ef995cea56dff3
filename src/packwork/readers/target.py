"""Pictures that layouts are to show from afar."""

from __future__ import annotations

from pathlib import Path
from typing import cast

import numpy as np
from PIL import Image

from packwork.arrays import FloatArray
from packwork.errors import ReadError
from packwork.raster.drawing import drawn_png
from packwork.readers.files import read_bytes, stem
from packwork.readers.options import ReadOptions
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES, Pixels, decode_picture
from packwork.readers.reading import reading_file
from packwork.readers.svg.item import item_of_svg
from packwork.scene.container import Container
from packwork.scene.contrast import light_of
from packwork.scene.item import VectorArt
from packwork.scene.notation import matrix_text
from packwork.scene.target import TargetPicture

LONGEST_PX = 320
"""Longer side of the canvas in the pixels of a target. Larger shows no more through items, and
takes longer by its square. Chosen."""

DECODED_PX = 1_600
"""Longer side to which a picture is decoded. As above."""

PLAIN = 0.005
"""Standard deviation of light below which a picture shows nothing. Chosen."""

DRAWINGS = (".svg", ".svgz")

SOLID = 128
"""Opacity of 255 from which a cut-out's pixel is a part of it."""

_BLANK = b"\xef\xbb\xbf \t\r\n"
_SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'


def read_target(
    source: str | Path, container: Container, reading: ReadOptions | None = None
) -> TargetPicture:
    """Picture of a file, laid so that it covers the container's box, on white where it is clear.

    Of a cut-out or an SVG that is what is seen of it, so that a container made of it lies on
    it.
    """
    data = read_bytes(source, MAX_PICTURE_BYTES)
    if Path(source).suffix.lower() in DRAWINGS or data.lstrip(_BLANK)[:1] == b"<":
        data = _painted(data, str(source), reading)
    with reading_file(str(source)):
        pixels = decode_picture(data, DECODED_PX).pixels
    if not (pixels[..., 3] >= SOLID).any():
        raise ReadError(source, "shows nothing, for it is clear; use a picture that is seen")
    scale = LONGEST_PX / container.side
    shape = (max(round(container.height * scale), 1), max(round(container.width * scale), 1))
    box = np.array(container.outline.bounds) * scale
    # The part of a cut-out that is solid; any other picture whole.
    rows, columns = np.nonzero(pixels[..., 3] >= SOLID)
    seen = pixels[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]
    target = TargetPicture(_laid(_on_white(seen), box, shape), scale)
    if target.spread < PLAIN:
        raise ReadError(source, "has one colour only; a layout cannot show it: use --palette")
    return target


def _painted(data: bytes, source: str, reading: ReadOptions | None) -> bytes:
    """PNG of what an SVG's bytes draw, without its page unless that is to stay."""
    item = item_of_svg(data, stem(source), source, reading=reading)
    left, top, right, bottom = item.ink.bounds
    px = max(right - left, bottom - top) / DECODED_PX
    size = [max(round((right - left) / px), 1), max(round((bottom - top) / px), 1)]
    art = cast("VectorArt", item.art)
    document = (
        f'<svg {_SPACES} width="{size[0]}" height="{size[1]}" preserveAspectRatio="none"'
        f' viewBox="{left!r} {top!r} {right - left!r} {bottom - top!r}">'
        f'<g transform="{matrix_text(art.matrix)}">{art.markup}</g></svg>'
    )
    try:
        return drawn_png(document)
    except ValueError as error:
        raise ReadError(source, f"cannot be drawn: {error}") from None


def _on_white(pixels: Pixels) -> FloatArray:
    opacity = pixels[..., 3:].astype(np.float64) / 255
    return np.asarray(opacity * light_of(pixels[..., :3] / 255.0) + (1 - opacity))


def _laid(light: FloatArray, box: FloatArray, shape: tuple[int, int]) -> FloatArray:
    """Light of a canvas of ``shape``, the picture covering ``box`` (left, top, right, bottom).

    Its middle on that of the box; beyond the box there is its mean.
    """
    first = np.maximum(np.floor(box[:2]), 0).astype(int)
    last = np.minimum(np.ceil(box[2:]), shape[::-1]).astype(int)
    size = np.array(light.shape[1::-1], dtype=np.float64)
    # Pixels of the picture per pixel of the canvas, along both sides.
    step = float((size / (box[2:] - box[:2])).min())
    middle = (box[:2] + box[2:]) / 2
    window = [np.clip(size / 2 + (at - middle) * step, 0, size) for at in (first, last)]
    laid = np.broadcast_to(light.mean(axis=(0, 1)), (*shape, 3)).copy()
    (left, top), (right, bottom) = first, last
    for k in range(3):
        channel = Image.fromarray(light[..., k].astype(np.float32))
        small = channel.resize(
            (int(right - left), int(bottom - top)),
            Image.Resampling.BOX if step >= 1 else Image.Resampling.BILINEAR,
            box=(*window[0].tolist(), *window[1].tolist()),
        )
        laid[top:bottom, left:right, k] = np.asarray(small)
    return np.asarray(np.clip(laid, 0.0, 1.0))
