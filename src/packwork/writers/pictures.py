"""Items as pixels: drawings rendered, photographs opened once more at the size of the print."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from packwork.geometry import affine
from packwork.raster.drawing import drawn_png
from packwork.scene.item import Art, Item, PhotoArt, PictureArt, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.notation import decimals
from packwork.units import convert
from packwork.writers.film.options import MAX_SIDE_PX
from packwork.writers.svg_symbols import element, largest_scales, paint

MAX_PICTURE_PX = MAX_SIDE_PX
"""Longer side of a drawing's picture at most: that of a film."""

_MARGIN_PX = 2
"""Free edge of such a picture: soft edges reach a pixel beyond the ink."""


def as_picture(item: Item, px_per_unit: float) -> PictureArt:
    """An item's drawing as a picture, no finer than ``MAX_PICTURE_PX`` allows.

    Its ink says how far it reaches. A ValueError if it cannot be rendered.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.item import FlatArt
    >>> ink = Outline.from_rings([[[-2, -1], [2, -1], [2, 1], [-2, 1]]])
    >>> picture = as_picture(Item("tile", "", ink, ink, FlatArt("red")), 10.0)
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
    return PictureArt(
        drawn_png(document), width, height, affine.similarity(left, top, 0.0, 1 / scale)
    )


DPI = 300
"""Pixels of a photo to the inch of paper, where nothing else is asked. More: larger files.
Chosen, as printers do."""

SPARE = 1.2
"""Pixels of a photo per pixel of a picture that it is drawn into: it is turned there, which
softens what has no more than one. Larger takes longer and more memory. Tried by eye."""


def with_fine_photos(layout: Layout, px_per_cu: float) -> Layout:
    """Layout whose photos have that many pixels per canvas unit, if there are as many.

    One photo at a time is in memory; what stays of it is a file in text. A ReadError if one is no
    longer there, or broken.
    """
    layout = _with_backdrop(layout, px_per_cu)
    arts: dict[Art, VectorArt] = {
        art: art.original.printed(scale * px_per_cu)
        for art, scale in largest_scales(layout, lambda item: item.art).items()
        if isinstance(art, PhotoArt)
    }
    if not arts:
        return layout
    photos = (item for item in dict.fromkeys(layout.items) if item.art in arts)
    known = {item: replace(item, art=arts[item.art]) for item in photos}
    return replace(layout, items=tuple(known.get(item, item) for item in layout.items))


def _with_backdrop(layout: Layout, px_per_cu: float) -> Layout:
    """The same layout, the picture behind as fine as that."""
    container = layout.container
    behind = container.backdrop
    if behind is None:
        return layout
    art = behind.art.original.printed(float(np.hypot(*behind.matrix[:, 0])) * px_per_cu)
    behind = replace(behind, art=replace(behind.art, preview=art))
    return replace(layout, container=replace(container, backdrop=behind))


def with_photos_for_paper(layout: Layout, dpi: float) -> Layout:
    """The same layout, its photos with that many pixels per inch of the canvas."""
    return with_fine_photos(layout, dpi * convert(1.0, layout.container.unit, "in"))
