"""Layouts as JPEG: the PNG that would be written, on paper."""

from __future__ import annotations

import warnings
from io import BytesIO

from packwork.scene.layout import Layout
from packwork.writers.frame import dots_per_inch
from packwork.writers.png import PngOptions, png_bytes

QUALITY = 95
"""Of 95 at most. Smaller shows its blocks round edges of plain colour. Chosen."""


def jpeg_bytes(layout: Layout, longer_side_px: int, options: PngOptions | None = None) -> bytes:
    """JPEG file of a layout, as :func:`packwork.writers.png.png_bytes` draws it.

    Where the background is clear, it is white: a JPEG knows no other.

    Raises
    ------
    RecipeError
        If the size is out of bounds.
    WriteError
        If the renderer cannot draw an item's art.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.container import Container
    >>> from packwork.scene.pose import Poses
    >>> import numpy as np
    >>> tile = Outline.from_rings([[[0, 0], [4, 0], [4, 4]]])
    >>> none = np.zeros(0)
    >>> empty = Layout(
    ...     Container("tile", "tile", tile, 4.0, 4.0), (), Poses(none, none, none, none), none
    ... )
    >>> jpeg_bytes(empty, 16)[:2].hex()
    'ffd8'
    """
    from PIL import Image

    drawn = png_bytes(layout, longer_side_px, options)
    density = dots_per_inch(layout.container, longer_side_px)
    known = {} if density is None else {"dpi": (density, density)}
    file = BytesIO()
    with warnings.catch_warnings():
        # The picture is ours: how large it may be was checked before it was drawn.
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        with Image.open(BytesIO(drawn)) as picture:
            paper = Image.new("RGB", picture.size, "white")
            paper.paste(picture, mask=picture.getchannel("A"))
    paper.save(file, "JPEG", quality=QUALITY, **known)
    return file.getvalue()
