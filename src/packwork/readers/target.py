"""Pictures that layouts are to show from afar."""

from __future__ import annotations

from pathlib import Path
from typing import cast

import numpy as np
from PIL import Image

from packwork.arrays import FloatArray
from packwork.errors import ReadError
from packwork.geometry.outline import Outline
from packwork.raster.drawing import drawn_png
from packwork.readers.options import ReadOptions
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES, Pixels, decode_picture
from packwork.readers.pictures.developing import Photograph, inspected
from packwork.readers.reading import read_bytes, reading_file, stem
from packwork.readers.svg.art import KeptOriginal
from packwork.readers.svg.item import item_of_svg
from packwork.scene.colour import hex_colour
from packwork.scene.container import Container
from packwork.scene.contrast import light_of
from packwork.scene.item import Item, PhotoArt, VectorArt
from packwork.scene.notation import matrix_text
from packwork.scene.target import TargetPicture

LONGEST_PX = 320
"""Longer side of the canvas in the pixels of a target. Larger shows no more through items, and
takes longer by its square. Chosen."""

DECODED_PX = 1_600
"""Longer side to which a picture is decoded. As above."""

PREVIEW_PX = 1_200
"""Longer side of the copy of a kept picture that screens show. Chosen."""

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
    if _is_drawing(source, data):
        item = item_of_svg(data, stem(source), str(source), reading=reading)
        return target_of(item, container)
    return _target(data, str(source), container)


def target_of(picture: Item, container: Container) -> TargetPicture:
    """The same of a picture that is an item: all of what it draws."""
    return _target(painted(picture), picture.name, container)


def kept_picture(source: str | Path, longest_px: int) -> Item:
    """Picture of a file as one item, which holds no more than so many pixels along its longer side.

    What is no drawing is a photograph that needs its file no more.
    """
    data, name = read_bytes(source, MAX_PICTURE_BYTES), stem(source)
    with reading_file(str(source)):
        if _is_drawing(source, data):
            return item_of_svg(data, name, str(source))
        negative = inspected(data)
        wide, high = float(negative.width), float(negative.height)
        photo = Photograph(
            str(source), name, (0.0, 0.0, wide, high), "", "", "none", (-wide / 2, -high / 2)
        )
        seen, art = (
            photo.drawn(photo.developed(data, px / max(wide, high)))
            for px in (min(longest_px, PREVIEW_PX), longest_px)
        )
    box = Outline.box(-wide / 2, -high / 2, wide / 2, high / 2)
    return Item(name, name, box, box, PhotoArt(seen, KeptOriginal(art)))


def picture_colours(source: str | Path, count: int) -> list[str]:
    """Colours of a picture that differ most, so many at most, the most frequent first."""
    data = read_bytes(source, MAX_PICTURE_BYTES)
    with reading_file(str(source)):
        pixels = decode_picture(data, LONGEST_PX).pixels
    solid = pixels[pixels[..., 3] >= SOLID][:, :3]
    if not len(solid):
        raise ReadError(source, "shows nothing, for it is clear; use a picture that is seen")
    few = Image.fromarray(solid[None]).quantize(count, Image.Quantize.MEDIANCUT)
    listed = np.reshape(few.getpalette() or [], (-1, 3)).tolist()
    often = np.bincount(np.asarray(few).ravel())
    return [hex_colour(tuple(listed[k])) for k in np.argsort(-often, kind="stable") if often[k]]


def _is_drawing(source: str | Path, data: bytes) -> bool:
    return Path(source).suffix.lower() in DRAWINGS or data.lstrip(_BLANK)[:1] == b"<"


def _target(data: bytes, source: str, container: Container) -> TargetPicture:
    with reading_file(source):
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


def painted(item: Item) -> bytes:
    """PNG of what a drawing or a photograph shows; this one has no more pixels than its copy."""
    art, most_px = item.art, DECODED_PX
    if isinstance(art, PhotoArt):
        art, most_px = art.preview, min(DECODED_PX, PREVIEW_PX)
    art = cast("VectorArt", art)
    left, top, right, bottom = item.ink.bounds
    px = max(right - left, bottom - top) / most_px
    size = [max(round((right - left) / px), 1), max(round((bottom - top) / px), 1)]
    document = (
        f'<svg {_SPACES} width="{size[0]}" height="{size[1]}" preserveAspectRatio="none"'
        f' viewBox="{left!r} {top!r} {right - left!r} {bottom - top!r}">'
        f'<g transform="{matrix_text(art.matrix)}">{art.markup}</g></svg>'
    )
    try:
        return drawn_png(document)
    except ValueError as error:
        raise ReadError(item.name, f"cannot be drawn: {error}") from None


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
