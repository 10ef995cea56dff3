"""The one colour that stands for an item where only one can be written."""

from __future__ import annotations

import base64
import io
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias
from weakref import WeakKeyDictionary

import numpy as np
from PIL import Image, UnidentifiedImageError

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.raster.drawing import drawn_png
from packwork.scene.colour import ABSENT, css_colour, hex_colour
from packwork.scene.contrast import light_of
from packwork.scene.item import Art, FlatArt, Item, PhotoArt, PictureArt, VectorArt
from packwork.scene.notation import attributes, matrix_text

NEUTRAL = "#808080"
"""Stands for arts whose colour cannot be told cheaply."""

ShownLight: TypeAlias = tuple[FloatArray, FloatArray]
"""Light ``(n, 3)`` of pixels of a small copy, and how solid each is ``(n,)``."""

_PAINT = re.compile(r"""(?:\bfill|\bstop-color)\s*[=:]\s*["']?\s*([^"';}<>]{1,40})""")
_ALONE = re.compile(
    r"""<image [^<>]*href="data:image/(?:png|jpeg);base64,([A-Za-z0-9+/=]+)"[^<>]*/>"""
)
"""Preview of a photograph without a border that is cut to no shape: one picture, five times as
quick to decode as to render."""

_SAMPLE_PX = 64
"""Longer side a picture is reduced to before its mean is taken. Larger: slower, same mean;
smaller: the soft edges of white parts pale it. Chosen."""

_NEAR_WHITE = 235
"""Each channel of what cannot be seen on paper, of 255, at least. Larger lets highlights
pale the mean, smaller leaves pastels out. Chosen."""

_COLOURED_SHARE = 0.05
"""Share of what shows that must not be all but white to stand for the whole: larger lets a
white thing with a coloured rim vanish, smaller lets its soft edge decide. Chosen."""

_LIGHTS: WeakKeyDictionary[Art, FloatArray] = WeakKeyDictionary()

_SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'


def representative_colour(item: Item) -> str:
    """Colour ``#rrggbb`` that a viewer would name first, cheaply.

    The fill of flat ink; of drawings and pictures the mean of what shows, all but white
    parts left out where there are others; ``NEUTRAL`` where nothing shows.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> ink = Outline.from_rings([[[-1, -1], [2, -1], [-1, 2]]])
    >>> representative_colour(Item("tri", "", ink, ink, FlatArt("teal")))
    '#008080'
    """
    art = item.art.preview if isinstance(item.art, PhotoArt) else item.art
    if isinstance(art, FlatArt):
        return _solid(art.fill) or NEUTRAL
    if isinstance(art, VectorArt):
        png = _drawn(art, item.ink)
        return (None if png is None else _mean_shown(png)) or _most_named(art.markup)
    return _mean_shown(art.png) or NEUTRAL


def mean_light(item: Item) -> FloatArray:
    """Mean of what shows, as light ``(3,)``: the colour of an item that is seen from afar.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> ink = Outline.from_rings([[[-1, -1], [2, -1], [-1, 2]]])
    >>> mean_light(Item("tri", "", ink, ink, FlatArt("white"))).tolist()
    [1.0, 1.0, 1.0]
    """
    shown = shown_light(item)
    if shown is None:
        return light_of(np.array(css_colour(representative_colour(item))[:3]) / 255)
    return np.asarray(np.average(shown[0], axis=0, weights=shown[1]))


def mean_lights(items: Sequence[Item]) -> FloatArray:
    """``(n, 3)`` :func:`mean_light` of items, once of each drawing."""
    found = list[FloatArray]()
    for item in items:
        # Looked up once: what an equal art that is gone was known by may go at any time.
        light = _LIGHTS.get(item.art)
        if light is None:
            light = _LIGHTS[item.art] = mean_light(item)
        found.append(light)
    return np.array(found)


def patch_of(item: Item, grid: int) -> FloatArray:
    """``(grid * grid, 3)`` light of the parts of an item's box, row by row.

    The mean of all where nothing shows in a part, or the item is dear to render.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> ink = Outline.box(-1, -1, 1, 1)
    >>> patch_of(Item("tile", "", ink, ink, FlatArt("black")), 2).tolist()[3]
    [0.0, 0.0, 0.0]
    """
    pixels = _shown_pixels(item)
    if pixels is None:
        return np.tile(mean_light(item), (grid * grid, 1))
    light, solid = light_of(pixels[..., :3] / 255), pixels[..., 3]
    mean = np.average(light.reshape(-1, 3), axis=0, weights=solid.ravel())
    cuts = [np.linspace(0, side, grid + 1).round().astype(int) for side in solid.shape]
    found = np.tile(mean, (grid * grid, 1))
    for row in range(grid):
        for column in range(grid):
            part = (slice(*cuts[0][row : row + 2]), slice(*cuts[1][column : column + 2]))
            if (weights := solid[part]).sum() > 0:
                colours = light[part].reshape(-1, 3)
                found[row * grid + column] = np.average(colours, axis=0, weights=weights.ravel())
    return found


def shown_light(item: Item) -> ShownLight | None:
    """Light ``(n, 3)`` of the pixels of a small copy, and how solid each is ``(n,)``.

    None where nothing shows, or it is dear to render.
    """
    image = _shown_pixels(item)
    if image is None:
        return None
    pixels = image.reshape(-1, 4)
    return light_of(pixels[:, :3] / 255), pixels[:, 3]


def _shown_pixels(item: Item) -> FloatArray | None:
    """``(rows, columns, 4)`` channels, 0..255, of a small copy of what shows; None as above."""
    png = _photo(item.art) if isinstance(item.art, PhotoArt) else None
    if png is None:
        art = item.art.preview if isinstance(item.art, PhotoArt) else item.art
        png = small_png(replace(item, art=art))
    image = None if png is None else _small_pixels(png)
    return None if image is None or image[..., 3].sum() == 0 else image


def small_png(item: Item) -> bytes | None:
    """Small picture of a drawing, or its own of a picture; None of what is dear to render."""
    if isinstance(item.art, VectorArt):
        return _drawn(item.art, item.ink)
    return item.art.png if isinstance(item.art, PictureArt) else None


def _photo(art: PhotoArt) -> bytes | None:
    """Small copy of a photograph as it is, if that is all that its preview shows."""
    alone = _ALONE.fullmatch(art.preview.markup.strip())
    return base64.b64decode(alone[1]) if alone else None


def _drawn(art: VectorArt, ink: Outline) -> bytes | None:
    """Small rendering; nothing of what is empty, or dear to render."""
    if "<text" in art.markup:  # fonts take longer to look up than all else
        return None
    left, top, right, bottom = ink.bounds
    px = max(right - left, bottom - top) / _SAMPLE_PX
    size = {"width": f"{(right - left) / px:.6g}", "height": f"{(bottom - top) / px:.6g}"}
    view = {"viewBox": f"{left!r} {top!r} {right - left!r} {bottom - top!r}"}
    placed = f"<g{attributes({'transform': matrix_text(art.matrix)})}>{art.markup}</g>"
    try:
        return drawn_png(f"<svg {_SPACES}{attributes(size | view)}>{placed}</svg>")
    except ValueError:
        return None


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


def _small_pixels(png: bytes) -> FloatArray | None:
    """``(rows, columns, 4)`` channels, 0..255, of a small copy; None of what is broken."""
    try:
        with Image.open(io.BytesIO(png)) as picture:
            picture.thumbnail((_SAMPLE_PX, _SAMPLE_PX), reducing_gap=1.0)
            small = picture.convert("RGBA")
    except (OSError, ValueError, UnidentifiedImageError, Image.DecompressionBombError):
        return None
    return np.asarray(small, dtype=np.float64)


def _mean_shown(png: bytes) -> str | None:
    image = _small_pixels(png)
    if image is None:
        return None
    pixels = image.reshape(-1, 4)
    colours, weights = pixels[:, :3], pixels[:, 3]
    if weights.sum() == 0:
        return None
    coloured = np.where(colours.min(axis=1) < _NEAR_WHITE, weights, 0.0)
    if coloured.sum() >= _COLOURED_SHARE * weights.sum():
        weights = coloured
    return hex_colour(tuple(round(c) for c in np.average(colours, axis=0, weights=weights)))
