"""Embedded pictures: which ``data:`` references may stay, and as what.

Programs disagree about pictures that move and about pictures that a note in their file turns;
such a picture is written anew: its first frame, upright.
"""

from __future__ import annotations

import base64
import warnings
from io import BytesIO

from PIL import Image, ImageOps

from packwork.readers.account import spend
from packwork.readers.pictures.decode import eight_bit, opened
from packwork.readers.svg_syntax.embedded import embedded_bytes, embedded_size
from packwork.readers.unfit import UnfitError

MAX_EMBEDDED_PIXELS = 16_000_000
"""Pixels of one embedded picture: four bytes each once decoded. Chosen."""

_PIXEL_NS = 150.0
"""For a pixel that is decoded and written anew. Measured."""

_QUALITY = 95
_ORIENTATION = 0x0112
_ALL_READ = frozenset({"PNG", "JPEG"})
"""Kinds that every program shows, if they neither move nor are turned."""


def is_harmless_picture(reference: str) -> bool:
    """Whether a reference is an embedded pixel picture of sane size.

    The kind is read from the picture itself: an SVG that calls itself PNG is none.

    Examples
    --------
    >>> is_harmless_picture("file:///etc/passwd")
    False
    >>> is_harmless_picture("data:image/svg+xml;base64,PHN2Zy8+")
    False
    """
    size = embedded_size(reference)
    return size is not None and 0 < size[0] * size[1] <= MAX_EMBEDDED_PIXELS


def one_picture(reference: str) -> str | None:
    """The embedded picture as one that all programs show alike; None if it is not usable.

    Examples
    --------
    >>> one_picture("file:///etc/passwd") is None
    True
    """
    if not is_harmless_picture(reference):
        return None
    data = embedded_bytes(reference)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with opened(data or b"") as image:
                if image.format in _ALL_READ and not _is_special(image):
                    return reference
                spend(_PIXEL_NS * image.width * image.height, "holds too large pictures")
                return _upright(image)
    except UnfitError:
        return None


def _is_special(image: Image.Image) -> bool:
    """Whether it moves or is turned by a note in its file."""
    is_still = getattr(image, "n_frames", 1) == 1
    return not is_still or image.getexif().get(_ORIENTATION, 1) != 1


def _upright(image: Image.Image) -> str:
    """First frame of a picture, upright, as a reference."""
    is_photo = image.format == "JPEG"
    plain = ImageOps.exif_transpose(eight_bit(image, "RGB" if is_photo else "RGBA"))
    file = BytesIO()
    if is_photo:
        plain.save(file, "JPEG", quality=_QUALITY)
    else:
        plain.save(file, "PNG")
    kind = "jpeg" if is_photo else "png"
    return f"data:image/{kind};base64,{base64.b64encode(file.getvalue()).decode('ascii')}"
