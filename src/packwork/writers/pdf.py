"""Layouts as PDF: the SVG that would be written, on one page of the canvas's true size.

Typst sets the page. It reads SVG with the library that also renders our PNGs, so that
fills, strokes, gradients, clips and masks stay vectors and look as they do there; numbers
keep seven digits. Only drawings with text become pictures: their letters would come from
the fonts of another machine than the one on which they were measured.
"""

from __future__ import annotations

import math
from dataclasses import replace

from packwork.errors import WriteError
from packwork.geometry import affine
from packwork.raster.drawing import drawn_png
from packwork.scene.item import Item, PictureArt, VectorArt
from packwork.scene.layout import Layout
from packwork.units import convert
from packwork.writers.marks import element
from packwork.writers.notation import decimals, sound_text
from packwork.writers.svg import NAME_LENGTH, SvgOptions, svg_text

PICTURE_DPI = 600
"""Pixels to the inch of a drawing that becomes a picture. More: larger files. Chosen."""

MAX_PICTURE_PX = 4_096
"""Longer side of such a picture at most. Chosen."""

_MARGIN_PX = 2
"""Free edge of such a picture: soft edges reach a pixel beyond the ink."""

_PAGE = """\
#set document(title: sys.inputs.title, date: none)
#set page(width: {width:.12f}pt, height: {height:.12f}pt, margin: 0pt)
#image(bytes(sys.inputs.drawing), format: "svg", width: 100%, height: 100%, fit: "stretch")
"""


def pdf_bytes(layout: Layout, options: SvgOptions | None = None) -> bytes:
    """PDF file of a layout: one page, as large as the canvas; the same bytes every time.

    Raises
    ------
    WriteError
        If an item's drawing cannot be rendered.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.container import Container
    >>> from packwork.scene.pose import Poses
    >>> import numpy as np
    >>> tile = Outline.from_rings([[[0, 0], [4, 0], [4, 4]]])
    >>> none = np.zeros(0)
    >>> sheet = Container("tile", "tile", tile, 4.0, 4.0, "cm")
    >>> pdf_bytes(Layout(sheet, (), Poses(none, none, none, none), none))[:5]
    b'%PDF-'
    """
    import typst

    container = layout.container
    width, height = (convert(v, container.unit, "pt") for v in (container.width, container.height))
    # A PDF's words are curves: what sets the page would take fonts of its own for text.
    curves = replace(options or SvgOptions(), text="outlines")
    drawing = svg_text(without_text(layout), curves)
    try:
        return typst.compile(
            _PAGE.format(width=width, height=height).encode(),
            sys_inputs={"drawing": drawing, "title": sound_text(container.name[:NAME_LENGTH])},
            ignore_system_fonts=True,
        )
    except RuntimeError as error:
        reason = " ".join(str(error).split())
        raise WriteError("PDF", f"an item's drawing cannot be rendered ({reason})") from error


def without_text(layout: Layout) -> Layout:
    """The same layout, drawings with text in it replaced by pictures of them."""
    px_per_cu = convert(1.0, layout.container.unit, "in") * PICTURE_DPI
    largest: dict[int, float] = {}
    scales = layout.poses.axis_scales.max(axis=1).tolist()
    for item, scale in zip(layout.items, scales, strict=True):
        largest[id(item)] = max(largest.get(id(item), 0.0), scale)
    pictured = {
        id(item): _pictured(item, largest[id(item)] * px_per_cu)
        for item in layout.items
        if isinstance(item.art, VectorArt) and "<text" in item.art.markup
    }
    items = tuple(pictured.get(id(item), item) for item in layout.items)
    return replace(layout, items=items) if pictured else layout


def _pictured(item: Item, px_per_unit: float) -> Item:
    """Item drawn as a picture, no finer than ``MAX_PICTURE_PX`` allows."""
    left, top, right, bottom = item.ink.bounds
    extent = max(right - left, bottom - top)
    scale = min(px_per_unit, (MAX_PICTURE_PX - 2 * _MARGIN_PX) / extent)
    width, height = (
        math.ceil(side * scale - 1e-6) + 2 * _MARGIN_PX for side in (right - left, bottom - top)
    )
    left, top = left - _MARGIN_PX / scale, top - _MARGIN_PX / scale
    body = element(item, {}, "", decimals(1 / scale))
    document = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width}" height="{height}"'
        f' viewBox="{left!r} {top!r} {width / scale!r} {height / scale!r}">{body}</svg>'
    )
    try:
        png = drawn_png(document)
    except ValueError as error:
        raise WriteError("PDF", f"an item's drawing cannot be rendered ({error})") from error
    matrix = affine.similarity(left, top, 0.0, 1 / scale)
    return replace(item, art=PictureArt(png, width, height, matrix))
