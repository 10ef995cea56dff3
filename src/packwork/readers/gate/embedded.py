"""Pictures inside a drawing: which ``data:`` references may stay."""

from __future__ import annotations

import base64
import binascii
import re

from packwork.readers.pictures.decode import picture_size

MAX_ENCODED = 15_000_000
"""Letters of one embedded picture in base64, about 11 MB of file. Chosen."""

MAX_EMBEDDED_PIXELS = 16_000_000
"""Pixels of one embedded picture: four bytes each once decoded. Chosen."""

_HEAD = re.compile(r"data:image/(png|jpeg|jpg|webp|gif)\s*;\s*base64\s*,", re.IGNORECASE)


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


def embedded_size(reference: str) -> tuple[int, int] | None:
    """Width and height in pixels of an embedded picture, None if it is not usable.

    Examples
    --------
    >>> embedded_size("data:image/png;base64,####") is None
    True
    """
    head = _HEAD.match(reference)
    if head is None or len(reference) > MAX_ENCODED:
        return None
    try:
        data = base64.b64decode(re.sub(r"\s+", "", reference[head.end() :]), validate=True)
    except (binascii.Error, ValueError):
        return None
    return picture_size(data)
