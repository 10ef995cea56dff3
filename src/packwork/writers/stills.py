"""Layouts as JPEG, WebP and TIFF, converted from the PNG."""

from __future__ import annotations

import warnings
from io import BytesIO
from tempfile import TemporaryFile
from typing import TYPE_CHECKING, Any

from packwork.errors import RecipeError
from packwork.scene.layout import Layout
from packwork.writers.frame import dots_per_inch
from packwork.writers.png import png_bytes
from packwork.writers.svg import SvgOptions

if TYPE_CHECKING:
    from PIL import Image

JPEG_QUALITY = 95
"""Of 95 at most. Smaller shows its blocks round edges of plain colour. Chosen."""

MOST_WEBP_PX = 16_383
"""Longer side of a WebP at most. Derived: its header has 14 bits."""


def jpeg_bytes(layout: Layout, longer_side_px: int, options: SvgOptions | None = None) -> bytes:
    r"""JPEG file of a layout, as :func:`packwork.writers.png.png_bytes` draws it.

    Where the background is clear, it is white: a JPEG knows no other.

    Raises
    ------
    RecipeError
        If the size is out of bounds.
    WriteError
        If the renderer cannot draw an item's art.

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
    return _saved(paper, "JPEG", quality=JPEG_QUALITY, **known)


def webp_bytes(layout: Layout, longer_side_px: int, options: SvgOptions | None = None) -> bytes:
    """WebP file of a layout, without loss.

    Raises
    ------
    RecipeError, WriteError
        As :func:`jpeg_bytes`; also if it is longer than a WebP can be.
    """
    check_webp_side(longer_side_px)
    return _saved(_drawn(layout, longer_side_px, options), "WEBP", lossless=True, quality=80)


def check_webp_side(longer_side_px: int) -> None:
    """Refuse a size that no WebP has.

    Raises
    ------
    RecipeError
        About ``pixels``.

    Examples
    --------
    >>> check_webp_side(1_600)
    """
    if longer_side_px > MOST_WEBP_PX:
        raise RecipeError(
            "pixels", f"a WebP is at most {MOST_WEBP_PX} px long, not {longer_side_px}; use a PNG"
        )


def tiff_bytes(layout: Layout, longer_side_px: int, options: SvgOptions | None = None) -> bytes:
    """TIFF file of a layout, without loss; clear places stay clear, an opaque one has no alpha.

    Raises
    ------
    RecipeError, WriteError
        As :func:`jpeg_bytes`.
    """
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


def _saved(picture: Image.Image, kind: str, **settings: Any) -> bytes:
    file = BytesIO()
    picture.save(file, kind, **settings)
    return file.getvalue()
