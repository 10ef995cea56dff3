"""Bitmap glyphs of colour fonts, such as emoji: cleaned, and their outline traced."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO

import numpy as np
import shapely
from PIL import Image

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region
from packwork.readers.fonts.face import Bitmap
from packwork.readers.pictures.decode import Pixels, decode_picture
from packwork.readers.pictures.silhouette import outline_of_cut_out

MOST_PX = 1_024
"""Longer side of a glyph's picture; fonts have 136 and 160. Chosen."""


@dataclass(frozen=True, eq=False)
class GlyphPicture:
    """A glyph's picture in place.

    Parameters
    ----------
    png
        A complete PNG file.
    width, height
        Its size in pixels.
    matrix
        2 x 3 map from pixels to the word's units.
    region
        What it shows, in the word's units.
    """

    png: bytes
    width: int
    height: int
    matrix: FloatArray
    region: Region


def picture_of(bitmap: Bitmap, origin: tuple[float, float], scale: float) -> GlyphPicture:
    """Picture of a glyph whose origin stands there, its font's units that large.

    Raises
    ------
    UnfitError
        If the font's picture is broken or shows nothing.

    Examples
    --------
    >>> made = BytesIO()
    >>> Image.new("RGBA", (4, 2), "teal").save(made, format="png")
    >>> picture = picture_of(Bitmap(made.getvalue(), 0, -100, 200, 0), (10.0, 0.0), 1.0)
    >>> [round(side) for side in picture.region.bounds]
    [10, -100, 210, 0]
    """
    pixels = decode_picture(bitmap.png, MOST_PX).pixels
    height, width = pixels.shape[:2]
    wide = scale * (bitmap.right - bitmap.left) / width
    high = scale * (bitmap.bottom - bitmap.top) / height
    left, top = origin[0] + scale * bitmap.left, origin[1] + scale * bitmap.top
    matrix = np.array([[wide, 0.0, left], [0.0, high, top]])
    outline = outline_of_cut_out(pixels)
    return GlyphPicture(
        _png(pixels),
        width,
        height,
        matrix,
        shapely.transform(outline, lambda points: affine.apply(matrix, points)),
    )


def _png(pixels: Pixels) -> bytes:
    made = BytesIO()
    Image.fromarray(pixels).save(made, format="png")
    return made.getvalue()
