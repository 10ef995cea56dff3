"""Layouts as PNG: the SVG that would be written, rendered."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass

from packwork.errors import WriteError
from packwork.raster.drawing import drawn_png
from packwork.scene.layout import Layout
from packwork.writers.colours import parse_colour
from packwork.writers.frame import dots_per_inch, picture_frame
from packwork.writers.svg import Sheet, SvgOptions, svg_document

METRES_PER_INCH = 0.0254

_AFTER_HEADER = 33
"""Bytes of the signature and of the chunk that has to come first."""


@dataclass(frozen=True, kw_only=True)
class PngOptions:
    """How a layout is rendered.

    Parameters
    ----------
    background
        CSS colour behind everything; ``None`` or ``"transparent"`` leaves it clear.
    show_container
        Draw the container's line.

    Raises
    ------
    RecipeError
        If ``background`` is not a colour.

    Examples
    --------
    >>> PngOptions().background
    '#ffffff'
    """

    background: str | None = "#ffffff"
    show_container: bool = False

    def __post_init__(self) -> None:
        if self.background is not None:
            parse_colour("background", self.background)


def png_bytes(layout: Layout, longer_side_px: int, options: PngOptions | None = None) -> bytes:
    """PNG file (RGBA) of a layout, its canvas's longer side ``longer_side_px`` long.

    The shorter side is rounded up to a whole pixel; nothing is stretched.

    Raises
    ------
    RecipeError
        If the size is out of bounds (see ``writers.frame``).
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
    >>> png_bytes(empty, 16)[1:4]
    b'PNG'
    """
    options = options or PngOptions()
    frame = picture_frame(layout.container, longer_side_px)
    # Whole pixels both ways: the renderer fits a fractional canvas with soft edges.
    size = (float(frame.columns), float(frame.rows))
    view = (size[0] / frame.px_per_cu, size[1] / frame.px_per_cu)
    sheet = Sheet(size=size, unit="px", view=view)
    drawn = SvgOptions(background=options.background, show_container=options.show_container)
    return _with_density(
        _rendered(svg_document(layout, drawn, sheet)),
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
