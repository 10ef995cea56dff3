"""Layouts as PNG: the SVG that would be written, rendered."""

from __future__ import annotations

import struct
import zlib

from packwork.errors import WriteError
from packwork.raster.drawing import drawn_png
from packwork.scene.layout import Layout
from packwork.writers.frame import dots_per_inch, picture_frame
from packwork.writers.svg import SvgOptions, sheet_of, svg_document

ON_WHITE = SvgOptions(background="#ffffff")
"""How pictures are drawn unless something else is asked for."""

METRES_PER_INCH = 0.0254

_AFTER_HEADER = 33
"""Bytes of the signature and of the chunk that has to come first."""


def png_bytes(layout: Layout, longer_side_px: int, options: SvgOptions | None = None) -> bytes:
    """PNG file (RGBA) of a layout, its canvas's longer side ``longer_side_px`` long.

    The shorter side is rounded up to a whole pixel; nothing is stretched.

    Parameters
    ----------
    options
        ``ON_WHITE`` if None.

    Raises
    ------
    RecipeError
        If the size is out of bounds (see ``writers.frame``).
    WriteError
        If the renderer cannot draw an item's art.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> png_bytes(blank(), 16)[1:4]
    b'PNG'
    """
    sheet = sheet_of(picture_frame(layout.container, longer_side_px))
    return _with_density(
        _rendered(svg_document(layout, options or ON_WHITE, sheet)),
        dots_per_inch(layout.container, longer_side_px),
    )


def _with_density(png: bytes, dpi: float | None) -> bytes:
    """The same file with the size that it is to have on paper, if it has one."""
    if dpi is None:
        return png
    per_metre = round(dpi / METRES_PER_INCH)
    body = b"pHYs" + struct.pack(">IIB", per_metre, per_metre, 1)
    chunk = struct.pack(">I", len(body) - 4) + body + struct.pack(">I", zlib.crc32(body))
    return png[:_AFTER_HEADER] + chunk + png[_AFTER_HEADER:]


def _rendered(text: str) -> bytes:
    try:
        return drawn_png(text)
    except ValueError as error:
        raise WriteError("PNG", f"an item's drawing cannot be rendered ({error})") from error
