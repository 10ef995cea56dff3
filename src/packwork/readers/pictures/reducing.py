"""Downscaling of pictures in bands, without a second copy at full size."""

from __future__ import annotations

import math
from collections.abc import Callable

from PIL import ExifTags, Image

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

    Parameters
    ----------
    image
        At full size, in the file's own mode.
    size
        Width and height, no larger than the image's.
    convert
        To a mode whose values may be averaged; is given bands of whole rows.

    Examples
    --------
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
    """How the picture lies in its file, 1 to 8 as EXIF has it; 1 is upright."""
    found = image.getexif().get(ExifTags.Base.Orientation, 1)
    return found if found in _TURNS else 1


def is_sideways(lies: int) -> bool:
    """Whether the upright picture is as wide as the file's is high."""
    return lies in _SIDEWAYS


def upright(image: Image.Image, lies: int) -> Image.Image:
    """Picture turned as it is to be seen.

    Examples
    --------
    >>> upright(Image.new("L", (3, 2)), 6).size
    (2, 3)
    """
    return image.transpose(_TURNS[lies]) if lies in _TURNS else image


def as_it_lies(
    window: tuple[float, float, float, float], size: tuple[int, int], lies: int
) -> tuple[float, float, float, float]:
    """Window of an upright picture, where it lies in the file's.

    Parameters
    ----------
    window
        Left, top, right and bottom, upright.
    size
        Width and height of the file's picture.

    Examples
    --------
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
