"""Pictures for notebooks of layouts, items and containers: an SVG, or a PNG instead of a long one.

Items and containers lie below what draws them, so their methods are put on them here.
"""

from __future__ import annotations

import base64
import hashlib
import re
from dataclasses import replace

import numpy as np

from packwork.scene.container import Container
from packwork.scene.item import Item, PhotoArt, PictureArt, VectorArt
from packwork.scene.layout import Layout, blank, sheet
from packwork.scene.pose import Poses
from packwork.writers.bitmaps import png_bytes
from packwork.writers.svg import SheetSize, SvgOptions, svg_document
from packwork.writers.svg_symbols import shape_key

SIDE_PX = 600
"""Longer side of the picture on screen, whatever the canvas: fits a notebook's column.
Chosen."""

SHARPNESS = 2
"""Pixels of a PNG per pixel on screen: smaller is blurred on fine screens. Chosen."""

SMALL_PX = 200
"""The same of what is shown alone: an item, a container. Chosen."""

LONGEST_SVG = 2_000_000
"""Characters of an SVG, about, beyond which a PNG is shown: a notebook keeps what it shows,
and photographs are in an SVG at full size. Larger makes heavy notebooks. Chosen."""

_ON_PAPER = SvgOptions(background="white")
"""Dark items would be lost on a dark page."""

_PER_POINT = 16
_PER_COPY = 130
_SHAPE_ID = re.compile(r'( id="| xlink:href="#)(shape-\d+)"')


def notebook_svg(layout: Layout, side: int = SIDE_PX) -> str | None:
    """SVG to stand in a page beside others; None where it would be too long.

    Some notebooks put the SVGs of all cells into one page, where each id must be unique.

    >>> from packwork.scene.layout import blank
    >>> 'width="600" height="300" viewBox="0 0 200 100"' in notebook_svg(blank(200.0, 100.0, "mm"))
    True
    """
    if _is_long(layout):
        return None
    container = layout.container
    page = SheetSize(size=_size(layout, side), unit="px", view=(container.width, container.height))
    options = _ON_PAPER if layout.items else replace(_ON_PAPER, show_container=True)
    text = svg_document(layout, options, page)
    digest = hashlib.sha256(text.encode()).hexdigest()[:10]
    return _SHAPE_ID.sub(rf'\1\2-{digest}"', text)


def notebook_png(layout: Layout, side: int = SIDE_PX) -> tuple[bytes, dict[str, int]] | None:
    """PNG and its size on screen; None where an SVG is shown.

    Raises ``WriteError`` if an item's drawing cannot be rendered.

    >>> from packwork.scene.layout import blank
    >>> notebook_png(blank()) is None
    True
    """
    if not _is_long(layout):
        return None
    width, height = _size(layout, side)
    picture = png_bytes(layout, SHARPNESS * side, _ON_PAPER)
    return picture, {"width": round(width), "height": round(height)}


def still_html(layout: Layout, name: str) -> str:
    """The picture as an element that a page may hide by the name of its class.

    >>> still_html(blank(), "shown")[:64]
    '<img class="shown" alt="Layout" src="data:image/svg+xml;base64,P'
    """
    if svg := notebook_svg(layout):
        kind, picture, size = "svg+xml", svg.encode(), ""
    else:
        kind, picture = "png", png_bytes(layout, SHARPNESS * SIDE_PX, _ON_PAPER)
        size = f' width="{_size(layout, SIDE_PX)[0]:.0f}"'
    data = base64.b64encode(picture).decode("ascii")
    return f'<img class="{name}" alt="Layout"{size} src="data:image/{kind};base64,{data}">'


def _alone(shown: Item | Container) -> Layout:
    """Layout of an item alone, or of a container without items."""
    if isinstance(shown, Container):
        return replace(blank(), container=shown)
    left, top, right, bottom = shown.ink.bounds
    page = sheet(shown.name, right - left, bottom - top)
    return Layout(page, (shown,), Poses([-left], [-top], 0.0, 1.0), np.ones(1))


for _kind in (Item, Container):
    _kind._repr_svg_ = lambda shown: notebook_svg(_alone(shown), SMALL_PX)  # type: ignore[union-attr]
    _kind._repr_png_ = lambda shown: notebook_png(_alone(shown), SMALL_PX)  # type: ignore[union-attr]


def _size(layout: Layout, side: int) -> tuple[float, float]:
    container = layout.container
    per_cu = side / container.side
    return container.width * per_cu, container.height * per_cu


def _is_long(layout: Layout) -> bool:
    drawings = {shape_key(item): item for item in layout.items}.values()
    length = sum(_length(item) for item in drawings) + _PER_COPY * len(layout.items)
    return length > LONGEST_SVG


def _length(item: Item) -> float:
    """About how many characters a drawing takes."""
    if isinstance(item.art, VectorArt):
        return len(item.art.markup)
    if isinstance(item.art, PhotoArt):
        return len(item.art.preview.markup)
    if isinstance(item.art, PictureArt):
        return len(item.art.png) * 4 / 3
    return _PER_POINT * len(item.ink.points)
