"""Words on pixels: coverage of their outlines, without a document of drawings between."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from PIL import Image

from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.raster.coverage import Rasteriser

FAINT = 4
"""Coverage, of 255, below which a pixel of an edge is left out, so that clouds in other
colours fill the same pixels. Chosen."""

Colour = tuple[int, int, int, int]


def paint(picture: Image.Image, words: Iterable[tuple[Outline, Colour]], scale: float) -> None:
    """Lay words over a picture (RGBA), ``scale`` of its pixels to one unit of theirs.

    Examples
    --------
    >>> picture = Image.new("RGBA", (2, 1))
    >>> paint(picture, [(Outline.box(0, 0, 1.5, 1), (255, 0, 0, 255))], 1.0)
    >>> [picture.getpixel((x, 0)) for x in (0, 1)]
    [(255, 0, 0, 255), (255, 0, 0, 128)]
    """
    for outline, colour in words:
        seen = outline.mapped(similarity(0.0, 0.0, 0.0, scale))
        left, top = (max(math.floor(v), 0) for v in seen.bounds[:2])
        ends = zip(seen.bounds[2:], picture.size, strict=True)
        right, bottom = (min(math.ceil(v), most) for v, most in ends)
        if left < right and top < bottom:
            mask = _opacity(seen, left, top, right, bottom, colour[3])
            tile = Image.new("RGBA", mask.size, colour)
            tile.putalpha(mask)
            picture.alpha_composite(tile, (left, top))


def _opacity(
    outline: Outline, left: int, top: int, right: int, bottom: int, most: int
) -> Image.Image:
    """Share of each pixel of a box that an outline covers, of ``most``."""
    rasteriser = Rasteriser((bottom - top, right - left))
    rasteriser.sweep(outline.points - (left, top), outline.starts)
    covered = rasteriser.density().clip(0.0, 1.0)
    covered[covered < FAINT / 255] = 0.0
    return Image.fromarray(np.rint(covered * most).astype(np.uint8))
