"""A part of a mark: its left share, by area."""

from __future__ import annotations

import base64
from dataclasses import replace

import shapely

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import intersection
from packwork.geometry.polygon import Region
from packwork.geometry.snapping import sound
from packwork.scene.item import FlatArt, Item, PictureArt, VectorArt


def part_of(item: Item, share: float) -> Item:
    """The left part of an item that has a share of its outline's area, cut straight.

    Examples
    --------
    >>> tile = Outline.from_rings([[[-2, -1], [2, -1], [2, 1], [-2, 1]]])
    >>> part_of(Item("tile", "", tile, tile, FlatArt()), 0.25).outline.bounds
    (-0.5, -1.0, 0.5, 1.0)
    """
    at = _cut(item.outline.region, share)
    outline = Outline.from_region(sound(_left(item.outline.region, at)))
    x, y = (float(value) for value in outline.centroid)
    place = affine.similarity(-x, -y, 0.0, 1.0)
    ink = sound(_left(item.ink.region, at))
    inked = outline if ink.area == 0 else Outline.from_region(ink)
    return replace(
        item,
        outline=outline.mapped(place),
        ink=inked.mapped(place),
        art=_cut_art(item, at, x, y),
    )


def _cut(region: Region, share: float) -> float:
    """Place of the vertical line that leaves that share of the area on its left."""
    # What it brings along takes a quarter of a second, and few charts cut a mark.
    from scipy.optimize import brentq

    left, _, right, _ = region.bounds
    whole = float(region.area)

    def excess(at: float) -> float:
        return float(_left(region, at).area) / whole - share

    return float(brentq(excess, left, right, xtol=1e-12 * (right - left), rtol=1e-14))


def _left(region: Region, at: float) -> Region:
    left, top, _, bottom = region.bounds
    if at <= left:
        return shapely.Polygon()
    return intersection(region, shapely.box(left, top, at, bottom))


def _cut_art(item: Item, at: float, x: float, y: float) -> FlatArt | VectorArt:
    """Drawing behind a window, in units that begin at the part's own centroid."""
    art = item.art
    if not isinstance(art, VectorArt | PictureArt):
        return art if isinstance(art, FlatArt) else FlatArt()
    inner = markup_of(art)
    left, top, _, bottom = item.ink.bounds
    # The line of the cut is sharp; on all other sides the window is wider than the drawing.
    free = bottom - top + at - left
    name = f"part-{at - left:.9g}".replace(".", "-")
    window = (
        f'<clipPath id="{name}"><rect x="{left - free!r}" y="{top - free!r}"'
        f' width="{at - left + free!r}" height="{bottom - top + 2 * free!r}"/></clipPath>'
    )
    matrix = " ".join(f"{value:.12g}" for value in art.matrix.T.ravel())
    markup = f'{window}<g clip-path="url(#{name})"><g transform="matrix({matrix})">{inner}</g></g>'
    return VectorArt(markup, affine.similarity(-x, -y, 0.0, 1.0))


def markup_of(art: VectorArt | PictureArt) -> str:
    """Markup of its drawing, in units that its matrix maps."""
    if isinstance(art, VectorArt):
        return art.markup
    data = base64.b64encode(art.png).decode("ascii")
    return (
        f'<image width="{art.width}" height="{art.height}" preserveAspectRatio="none"'
        f' xlink:href="data:image/png;base64,{data}"/>'
    )
