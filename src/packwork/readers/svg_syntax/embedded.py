"""Pictures inside a drawing, as ``data:`` references hold them: their bytes and their size."""

from __future__ import annotations

import base64
import binascii
import re

from packwork.readers.pictures.decode import picture_size

MAX_ENCODED = 15_000_000
"""Letters of one embedded picture in base64, about 11 MB of file. Chosen."""

_HEAD = re.compile(r"data:image/(png|jpeg|jpg|webp|gif)\s*;\s*base64\s*,", re.IGNORECASE)


def embedded_size(reference: str) -> tuple[int, int] | None:
    """Width and height in pixels of an embedded picture, None if it is not usable.

    Examples
    --------
    >>> embedded_size("data:image/png;base64,####") is None
    True
    """
    data = embedded_bytes(reference)
    return None if data is None else picture_size(data)


def embedded_bytes(reference: str) -> bytes | None:
    """Bytes of an embedded picture."""
    head = _HEAD.match(reference)
    if head is None or len(reference) > MAX_ENCODED:
        return None
    try:
        return base64.b64decode(re.sub(r"\s+", "", reference[head.end() :]), validate=True)
    except (binascii.Error, ValueError):
        return None
