"""Decoding of pixel files in bands, every limit checked from the header first."""

from __future__ import annotations

import math
import struct
import threading
import warnings
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from importlib.util import find_spec
from io import BytesIO

import numpy as np
import numpy.typing as npt
from PIL import ExifTags, Image, UnidentifiedImageError

from packwork.errors import PackworkError
from packwork.readers.reading import UnfitError

BAND_PIXELS = 4_000_000
"""Pixels that are converted at a time. Larger costs memory, smaller time. Chosen."""

_TURNS = {
    2: Image.Transpose.FLIP_LEFT_RIGHT,
    3: Image.Transpose.ROTATE_180,
    4: Image.Transpose.FLIP_TOP_BOTTOM,
    5: Image.Transpose.TRANSPOSE,
    6: Image.Transpose.ROTATE_270,
    7: Image.Transpose.TRANSVERSE,
    8: Image.Transpose.ROTATE_90,
}
_SIDEWAYS = frozenset({5, 6, 7, 8})
_FROM_RIGHT = frozenset({2, 3, 7, 8})
_FROM_BELOW = frozenset({3, 4, 6, 7})


def shrunk(
    image: Image.Image, size: tuple[int, int], convert: Callable[[Image.Image], Image.Image]
) -> Image.Image:
    """Picture of a smaller size, each of whose pixels is the mean of what it stands for.

    ``convert`` is given bands of whole rows in the file's own mode, and makes their values such
    that they may be averaged.

    >>> striped = Image.new("1", (4, 9)); striped.paste(1, (0, 0, 4, 3))
    >>> small = shrunk(striped, (1, 3), lambda band: band.convert("L"))
    >>> [small.getpixel((0, row)) for row in range(3)]
    [255, 0, 0]
    """
    columns, rows = size
    scale = image.height / rows
    deep = max(1, int(BAND_PIXELS / image.width / scale))
    bands: list[Image.Image] = []
    for first in range(0, rows, deep):
        after = min(first + deep, rows)
        top, bottom = first * scale, min(after * scale, image.height)
        above, below = math.floor(top), min(math.ceil(bottom), image.height)
        band = convert(image.crop((0, above, image.width, below)))
        box = (0.0, top - above, float(image.width), bottom - above)
        bands.append(band.resize((columns, after - first), Image.Resampling.BOX, box))
    whole = Image.new(bands[0].mode, size)
    for number, band in enumerate(bands):
        whole.paste(band, (0, number * deep))
    return whole


def orientation(image: Image.Image) -> int:
    """Orientation of the picture in its file, 1 to 8 as EXIF has it; 1 is upright."""
    found = image.getexif().get(ExifTags.Base.Orientation, 1)
    return found if found in _TURNS else 1


def is_sideways(lies: int) -> bool:
    """Whether the upright picture is as wide as the file's is high."""
    return lies in _SIDEWAYS


def upright(image: Image.Image, lies: int) -> Image.Image:
    """Picture turned as it is to be seen.

    >>> upright(Image.new("L", (3, 2)), 6).size
    (2, 3)
    """
    return image.transpose(_TURNS[lies]) if lies in _TURNS else image


def as_it_lies(
    window: tuple[float, float, float, float], size: tuple[int, int], lies: int
) -> tuple[float, float, float, float]:
    """Window of an upright picture, where it lies in the file's picture of ``size``.

    >>> as_it_lies((0, 0, 2, 1), (30, 20), 6)
    (0, 18, 1, 20)
    """
    left, top, right, bottom = window
    if is_sideways(lies):
        left, top, right, bottom = top, left, bottom, right
    if lies in _FROM_RIGHT:
        left, right = size[0] - right, size[0] - left
    if lies in _FROM_BELOW:
        top, bottom = size[1] - bottom, size[1] - top
    return left, top, right, bottom


MAX_PIXELS = 64_000_000
"""Pixels of a picture: four bytes each once decoded, so a quarter gigabyte. Chosen."""

MAX_HEAVY_PIXELS = MAX_PIXELS // 2
"""The same of kinds whose decoders hold several copies of the whole picture."""

MAX_SIDE_PX = 100_000
"""Longest side of a picture: each row costs memory of its own, and what is a thousand times as
long as wide is no picture. Chosen."""

LARGE_PIXELS = MAX_PIXELS // 4
"""Pixels of a picture from which only one is decoded at a time, however many threads read.
Larger takes more memory at once, smaller waits more."""

MAX_JPEG_PIXELS = 160_000_000
"""The same of a JPEG that is decoded at the size that is needed: a progressive one is still
held whole as coefficients, about 3 bytes each. Chosen."""

MAX_PICTURE_BYTES = 100_000_000
"""Size of a picture file. Chosen."""

_HAS_AVIF = find_spec("PIL._avif") is not None

FORMATS = ("PNG", "JPEG", "WEBP", "GIF", "BMP", "TIFF", *(["AVIF"] if _HAS_AVIF else []))
"""Kinds that are opened, whatever the file's ending says."""

PICTURE_ENDINGS = (
    ".png", ".jpg", ".jpeg", ".jfif", ".webp", ".gif", ".bmp", ".tif", ".tiff",
    *([".avif"] if _HAS_AVIF else []),
)  # fmt: skip
"""Endings of files that are read as pictures, in lower case."""

_HEAVY = ("WEBP", "AVIF")

_EMBEDDABLE = ("PNG", "JPEG", "WEBP", "GIF")
_DEEP_GREY = 65_535.0
_BAND_ROWS = 64
_FAILURES = (
    UnidentifiedImageError,
    Image.DecompressionBombError,
    OSError,
    SyntaxError,
    ValueError,
    TypeError,
    KeyError,
    IndexError,
    AttributeError,
    ArithmeticError,
    EOFError,
    MemoryError,
    NotImplementedError,
    struct.error,
    zlib.error,
)
"""What Pillow's decoders raise on broken files."""

_ONE_AT_A_TIME = threading.RLock()

Pixels = npt.NDArray[np.uint8]


def picture_size(data: bytes) -> tuple[int, int] | None:
    """Width and height from the header of a picture fit to be embedded, else None."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Image.open(BytesIO(data), formats=_EMBEDDABLE) as image:
                return image.size
    except _FAILURES:
        return None


@dataclass(frozen=True, eq=False)
class DecodedPicture:
    """Decoded pixels ``(rows, columns, 4)`` RGBA, upright.

    ``unit`` is how many pixels of the file one is; above 1 if it was shrunk.
    """

    pixels: Pixels
    unit: float


def decode_picture(data: bytes, longest_px: int) -> DecodedPicture:
    """Picture of a file's bytes, shrunk to ``longest_px`` at most; the first frame if it moves.

    >>> file = BytesIO()
    >>> Image.new("L", (30, 20)).save(file, "PNG")
    >>> picture = decode_picture(file.getvalue(), 15)
    >>> picture.pixels.shape, picture.unit
    ((10, 15, 4), 2.0)
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with opened(data, shrinking=True) as image:
            whole, lies = image.size, orientation(image)
            size = fitting(whole, longest_px)
            if size == whole:
                small = eight_bit(image)
            else:
                image.draft(None, size)
                small = shrunk(image, size, averageable)
            pixels = np.asarray(upright(small, lies).convert("RGBA"))
            return DecodedPicture(pixels, max(whole) / max(size))


@contextmanager
def opened(data: bytes, *, shrinking: bool = False) -> Iterator[Image.Image]:
    """Picture of a file's bytes, not yet decoded, its size checked.

    Whatever goes wrong inside the block is told as what is wrong with the file. With ``shrinking``
    a JPEG will be decoded no larger than it is needed, so it may be larger.
    """
    most = MAX_PIXELS
    try:
        with Image.open(BytesIO(data), formats=FORMATS) as image:
            is_reduced = shrinking and image.format == "JPEG"
            most = MAX_HEAVY_PIXELS if image.format in _HEAVY else MAX_PIXELS
            if is_reduced:
                most = MAX_JPEG_PIXELS
            _check_size(image.size, most)
            is_large = image.width * image.height > (MAX_PIXELS if is_reduced else LARGE_PIXELS)
            with _ONE_AT_A_TIME if is_large else nullcontext():
                yield image
    except PackworkError:
        raise
    except UnidentifiedImageError:
        raise UnfitError("is not a picture that can be read; give PNG, JPEG or WebP") from None
    except Image.DecompressionBombError:
        raise UnfitError(_too_large("far more", most)) from None
    except _FAILURES as error:
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise UnfitError(f"is a broken picture ({reason}); save it again") from None


def _check_size(size: tuple[int, int], most_pixels: int) -> None:
    if size[0] * size[1] > most_pixels:
        raise UnfitError(_too_large(f"{size[0]} x {size[1]}", most_pixels))
    if max(size) > MAX_SIDE_PX:
        raise UnfitError(
            f"has {size[0]} x {size[1]} pixels; {MAX_SIDE_PX:,} on a side are the most, so scale "
            "it down"
        )


def _too_large(met: str, most_pixels: int) -> str:
    return f"has {met} pixels; {most_pixels // 1_000_000} million are the most, so scale it down"


def eight_bit(image: Image.Image, mode: str = "RGBA") -> Image.Image:
    """Picture in a mode; grey of one with deep numbers.

    >>> eight_bit(Image.new("1", (2, 2))).mode, eight_bit(Image.new("I;16", (2, 2))).mode
    ('RGBA', 'L')
    """
    if not image.mode.startswith(("I", "F")):
        return image.convert(mode)
    scale = 255.0 / (_DEEP_GREY if image.mode.startswith("I") else 1.0)
    grey = np.empty(image.size[::-1], dtype=np.uint8)
    # In bands: eight bytes for each pixel at once would be half a gigabyte.
    for top in range(0, len(grey), _BAND_ROWS):
        rows = grey[top : top + _BAND_ROWS]
        deep = np.asarray(image.crop((0, top, image.width, top + len(rows))), dtype=np.float64)
        rows[:] = np.clip(np.nan_to_num(deep) * scale, 0, 255)
    return Image.fromarray(grey)


def png_of_pixels(pixels: Pixels) -> bytes:
    """PNG file of RGBA pixels."""
    file = BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


def fitting(size: tuple[int, int], longest_px: int) -> tuple[int, int]:
    """Width and height of a picture that is ``longest_px`` long at most.

    >>> fitting((300, 2), 100), fitting((30, 20), 100)
    ((100, 1), (30, 20))
    """
    factor = min(1.0, longest_px / max(size))
    return max(1, round(size[0] * factor)), max(1, round(size[1] * factor))


def averageable(image: Image.Image) -> Image.Image:
    """Picture in a mode whose values may be averaged: grey, or weighted by its opacity."""
    plain = eight_bit(image)
    # Pillow weighs colours by alpha only in this mode: else edges darken.
    return plain if plain.mode == "L" else plain.convert("RGBa")
