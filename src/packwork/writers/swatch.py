"""The one colour that stands for an item where only one can be written."""

from __future__ import annotations

import io
import re
from collections import Counter

import numpy as np
from PIL import Image, UnidentifiedImageError

from packwork.scene.colour import ABSENT, css_colour
from packwork.scene.item import Art, FlatArt, VectorArt
from packwork.writers.colours import hex_colour

NEUTRAL = "#808080"
"""Stands for arts whose colour cannot be told cheaply."""

_PAINT = re.compile(r"""(?:\bfill|\bstop-color)\s*[=:]\s*["']?\s*([^"';}<>]{1,40})""")
_SAMPLE_PX = 32
"""Longer side a picture is reduced to before its mean is taken. Larger: slower, same
mean. Chosen."""


def representative_colour(art: Art) -> str:
    """Colour ``#rrggbb`` that a viewer would name first, cheaply.

    The fill of flat ink, the colour a drawing names most often, the mean of a picture's
    opaque pixels; ``NEUTRAL`` where there is none.

    Examples
    --------
    >>> representative_colour(FlatArt("teal"))
    '#008080'
    """
    if isinstance(art, FlatArt):
        return _solid(art.fill) or NEUTRAL
    if isinstance(art, VectorArt):
        return _most_named(art.markup)
    return _mean_opaque(art.png)


def _solid(text: str) -> str | None:
    """``#rrggbb`` of a text, or nothing for references, no paint and other words."""
    if text.strip().lower() in ABSENT:
        return None
    try:
        return hex_colour(css_colour(text))
    except ValueError:
        return None


def _most_named(markup: str) -> str:
    named = Counter(m.group(1).strip() for m in _PAINT.finditer(markup))
    for text, _ in named.most_common():
        if colour := _solid(text):
            return colour
    return NEUTRAL


def _mean_opaque(png: bytes) -> str:
    try:
        with Image.open(io.BytesIO(png)) as picture:
            picture.thumbnail((_SAMPLE_PX, _SAMPLE_PX), reducing_gap=1.0)
            small = picture.convert("RGBA")
    except (OSError, ValueError, UnidentifiedImageError, Image.DecompressionBombError):
        return NEUTRAL
    pixels = np.asarray(small, dtype=np.float64).reshape(-1, 4)
    weight = pixels[:, 3].sum()
    if weight == 0:
        return NEUTRAL
    mean = (pixels[:, :3] * pixels[:, 3:]).sum(axis=0) / weight
    return hex_colour(tuple(round(c) for c in mean))
