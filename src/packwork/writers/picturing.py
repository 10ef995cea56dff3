"""Drawings as pictures, for formats and moments that take no vectors."""

from __future__ import annotations

import math

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.raster.drawing import drawn_png
from packwork.scene.item import Item, PictureArt
from packwork.scene.notation import decimals
from packwork.writers.marks import element, paint

MAX_PICTURE_PX = 4_096
"""Longer side of such a picture at most. Chosen."""

_MARGIN_PX = 2
"""Free edge of such a picture: soft edges reach a pixel beyond the ink."""


def pictured(item: Item, px_per_unit: float) -> PictureArt:
    """An item's drawing as a picture, no finer than ``MAX_PICTURE_PX`` allows.

    Parameters
    ----------
    item
        Its ink says how far its drawing reaches.

    Raises
    ------
    ValueError
        If the drawing cannot be rendered.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.item import FlatArt
    >>> ink = Outline.from_rings([[[-2, -1], [2, -1], [2, 1], [-2, 1]]])
    >>> picture = pictured(Item("tile", "", ink, ink, FlatArt("red")), 10.0)
    >>> picture.width, picture.height
    (44, 24)
    """
    left, top, right, bottom = item.ink.bounds
    extent = max(right - left, bottom - top)
    scale = min(px_per_unit, (MAX_PICTURE_PX - 2 * _MARGIN_PX) / extent)
    width, height = (
        math.ceil(side * scale - 1e-6) + 2 * _MARGIN_PX for side in (right - left, bottom - top)
    )
    left, top = left - _MARGIN_PX / scale, top - _MARGIN_PX / scale
    body = element(item, paint(item), "", decimals(1 / scale))
    document = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width}" height="{height}"'
        f' viewBox="{left:.17g} {top:.17g} {width / scale:.17g} {height / scale:.17g}">{body}</svg>'
    )
    return PictureArt(drawn_png(document), width, height, _placed(left, top, scale))


def _placed(left: float, top: float, scale: float) -> FloatArray:
    return affine.similarity(left, top, 0.0, 1 / scale)
