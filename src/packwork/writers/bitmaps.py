"""Layouts as PNG, JPEG, WebP and TIFF: the SVG that would be written, rendered."""

from __future__ import annotations

import struct
import warnings
import zlib
from dataclasses import replace
from io import BytesIO
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Any

import numpy as np

from packwork.errors import RecipeError, WriteError
from packwork.raster.drawing import drawn_png, encoded_picture
from packwork.scene.layout import Layout
from packwork.writers.frame import dots_per_inch, picture_frame
from packwork.writers.svg import SvgOptions, sheet_of, svg_document

if TYPE_CHECKING:
    from PIL import Image


ON_WHITE = SvgOptions(background="#ffffff")
"""How pictures are drawn unless something else is asked for."""

METRES_PER_INCH = 0.0254

_AFTER_HEADER = 33
"""Bytes of the signature and of the chunk that has to come first."""


def png_bytes(layout: Layout, longer_side_px: int, options: SvgOptions | None = None) -> bytes:
    """PNG file (RGBA) of a layout, its canvas's longer side ``longer_side_px`` long.

    The shorter side is rounded up to a whole pixel; nothing is stretched. On white unless the
    options say otherwise.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> png_bytes(blank(), 16)[1:4]
    b'PNG'
    """
    options, container = options or ON_WHITE, layout.container
    if options.tiles > 1 and container.lattice is not None:
        return _laid_out(layout, longer_side_px, options)
    sheet = sheet_of(picture_frame(container, longer_side_px), container)
    try:
        png = drawn_png(svg_document(layout, options, sheet))
    except ValueError as error:
        raise WriteError("PNG", f"an item's drawing cannot be rendered ({error})") from error
    return _with_density(png, dots_per_inch(layout.container, longer_side_px))


def _laid_out(layout: Layout, longer_side_px: int, options: SvgOptions) -> bytes:
    """Pixels of one tile, side by side: no renderer's pattern comes between them."""
    from PIL import Image

    side = max(longer_side_px // options.tiles, 1)
    one = _drawn(layout, side, replace(options, tiles=1))
    times = options.tiles, options.tiles, 1
    whole = Image.fromarray(np.tile(np.asarray(one), times))
    png = encoded_picture(whole, "PNG")
    return _with_density(png, dots_per_inch(layout.container, side))


def _with_density(png: bytes, dpi: float | None) -> bytes:
    """The same file with the size that it is to have on paper, if it has one."""
    if dpi is None:
        return png
    per_metre = round(dpi / METRES_PER_INCH)
    body = b"pHYs" + struct.pack(">IIB", per_metre, per_metre, 1)
    chunk = struct.pack(">I", len(body) - 4) + body + struct.pack(">I", zlib.crc32(body))
    return png[:_AFTER_HEADER] + chunk + png[_AFTER_HEADER:]


JPEG_QUALITY = 95
"""The most that makes a difference. Smaller shows its blocks round edges of plain colour."""

MOST_WEBP_PX = 16_383
"""Longer side of a WebP at most. Derived: its header has 14 bits."""


def jpeg_bytes(layout: Layout, longer_side_px: int, options: SvgOptions | None = None) -> bytes:
    r"""JPEG file of a layout, as :func:`packwork.writers.bitmaps.png_bytes` draws it.

    Where the background is clear, it is white: a JPEG knows no other.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> jpeg_bytes(blank(), 16)[:2], webp_bytes(blank(), 16)[8:12], tiff_bytes(blank(), 16)[:2]
    (b'\xff\xd8', b'WEBP', b'II')
    """
    from PIL import Image

    picture = _drawn(layout, longer_side_px, options)
    paper = Image.new("RGB", picture.size, "white")
    paper.paste(picture, mask=picture.getchannel("A"))
    known = _density(layout, longer_side_px)
    return encoded_picture(paper, "JPEG", quality=JPEG_QUALITY, **known)


def webp_bytes(layout: Layout, longer_side_px: int, options: SvgOptions | None = None) -> bytes:
    """WebP file of a layout, without loss."""
    check_webp_side(longer_side_px)
    return encoded_picture(
        _drawn(layout, longer_side_px, options), "WEBP", lossless=True, quality=80
    )


def check_webp_side(longer_side_px: int) -> None:
    """Refuse a size that no WebP has."""
    if longer_side_px > MOST_WEBP_PX:
        raise RecipeError(
            "pixels", f"a WebP is at most {MOST_WEBP_PX} px long, not {longer_side_px}; use a PNG"
        )


def tiff_bytes(layout: Layout, longer_side_px: int, options: SvgOptions | None = None) -> bytes:
    """TIFF file of a layout, without loss; clear places stay clear, an opaque one has no alpha."""
    picture = _drawn(layout, longer_side_px, options)
    if picture.getextrema()[-1] == (255, 255):
        picture = picture.convert("RGB")
    known = _density(layout, longer_side_px)
    # In memory libtiff leaves the byte between data of an odd length and what follows as it finds
    # it; in a file that is 0.
    with TemporaryFile() as file:
        picture.save(file, "TIFF", compression="tiff_adobe_deflate", **known)
        file.seek(0)
        return file.read()


def _density(layout: Layout, longer_side_px: int) -> dict[str, Any]:
    """Pixels to the inch, across and down, as Pillow takes them; nothing of a canvas in px."""
    density = dots_per_inch(layout.container, longer_side_px)
    return {} if density is None else {"dpi": (density, density)}


def _drawn(layout: Layout, longer_side_px: int, options: SvgOptions | None) -> Image.Image:
    from PIL import Image

    drawn = png_bytes(layout, longer_side_px, options)
    with warnings.catch_warnings():
        # The picture is ours: how large it may be was checked before it was drawn.
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        with Image.open(BytesIO(drawn)) as picture:
            return picture.convert("RGBA")
