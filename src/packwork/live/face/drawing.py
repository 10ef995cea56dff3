"""Items and containers as a page draws them: outlines as paths, arts as documents of their own."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

from packwork.geometry.outline import Outline
from packwork.scene.colour import css_colour
from packwork.scene.item import FlatArt, Item, PhotoArt
from packwork.scene.notation import decimals, matrix_text, path_data

FINENESS = 1e-3
"""By how much a silhouette may be off on the page, as a share of its extent: it is clicked on and
marked by, not measured. Larger shows corners, smaller is longer on its way. Chosen."""

INK_FINENESS = 2e-4
"""The same where the path is the drawing. Chosen."""

MARGIN = 0.01
"""Free edge of a drawing, as a share of its extent: soft edges reach beyond the ink. Chosen."""


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """Drawing of one item, in its own units.

    Parameters
    ----------
    key
        The same for all that look so.
    outline
        Its silhouette, as path data.
    box
        Left, top, right and bottom of the drawing.
    fill
        Colour of ``ink``; empty where ``svg`` tells.
    ink
        What is drawn, as path data; empty where ``svg`` tells.
    svg
        A whole document, cleaned, of the size of ``box``; empty where the ink in one colour is all.
    """

    key: str
    outline: str
    box: tuple[float, float, float, float]
    fill: str
    ink: str
    svg: str


def drawing_of(item: Item) -> Drawing:
    """Drawing of an item.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_item
    >>> star = drawing_of(builtin_item("star"))
    >>> star.fill, star.svg, len(star.box)
    ('#1f6f78ff', '', 4)
    """
    outline = path_of(item.outline, FINENESS)
    left, top, right, bottom = item.ink.bounds
    edge = MARGIN * max(right - left, bottom - top)
    box = (left - edge, top - edge, right + edge, bottom + edge)
    art = item.art.preview if isinstance(item.art, PhotoArt) else item.art
    fill = ink = svg = ""
    if isinstance(art, FlatArt):
        fill, ink = _seen(art.fill), path_of(item.ink, INK_FINENESS)
    else:
        svg = _document(f'<g transform="{matrix_text(art.matrix)}">{art.markup}</g>', box)
    said = "\0".join((outline, fill, ink, svg)).encode()
    key = hashlib.sha256(said).hexdigest()[:24]
    return Drawing(key=key, outline=outline, box=box, fill=fill, ink=ink, svg=svg)


def path_of(outline: Outline, fineness: float) -> str:
    """Path data of an outline that is off by no more than a share of its extent.

    Examples
    --------
    >>> path_of(Outline.box(0.0, 0.0, 9.0, 4.0), 0.01).count(" ")
    7
    """
    step = fineness * outline.extent
    region = outline.region.simplify(step)
    plain = Outline.from_region(region) if not region.is_empty and region.area > 0 else outline
    return path_data(plain, decimals(step / 4))


def _seen(colour: str) -> str:
    """A colour as hex digits, opacity with it."""
    return "#" + "".join(f"{channel:02x}" for channel in css_colour(colour))


def _document(inside: str, box: tuple[float, float, float, float]) -> str:
    left, top, right, bottom = box
    width, height = right - left, bottom - top
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width:.6g}" height="{height:.6g}"'
        f' viewBox="{left:.6g} {top:.6g} {width:.6g} {height:.6g}">{inside}</svg>'
    )
