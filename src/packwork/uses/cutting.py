"""Items of which a part is seen: outline, ink and drawing cut alike."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace
from typing import cast

import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.distance import snap_rounded
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, difference, intersection, polygon_parts
from packwork.geometry.polygon import Region, oriented_rings
from packwork.scene.item import (
    Art,
    Crop,
    FlatArt,
    Item,
    Original,
    PhotoArt,
    PictureArt,
    VectorArt,
)
from packwork.scene.mapped import mapped_art

PART = 0.05
"""Share of an item below which a part that is cut off from the rest is left out. Larger leaves
gaps in clefts of the container, smaller leaves slivers. Chosen by eye."""

FREE = 0.02
"""Width by which a drawing's window is larger than the item where nothing is cut, as a share of
its extent: smaller would pale the item's own edges, which are drawn softly too. Chosen."""


@dataclass(frozen=True, eq=False)
class Cut:
    """The part of an item that is seen, its centroid's place in the whole, and its share."""

    item: Item
    centre: tuple[float, float]
    share: float


@dataclass(frozen=True, eq=False)
class Window:
    """Opening through which a part of a drawing is seen: an SVG element in units of the whole item.

    ``place`` is a 2 x 3 map from those to units that begin at the part's own centroid; the name
    is the window's own in any document.
    """

    name: str
    clip: str
    place: FloatArray
    is_traced: bool

    def over(self, art: VectorArt | PictureArt) -> VectorArt:
        """A drawing behind the window."""
        matrix = " ".join(f"{value:.12g}" for value in art.matrix.T.ravel())
        return VectorArt(
            f'<clipPath id="{self.name}">{self.clip}</clipPath><g clip-path="url(#{self.name})">'
            f'<g transform="matrix({matrix})">{art.markup}</g></g>',
            self.place,
            self.is_traced,
        )


@dataclass(frozen=True, eq=False)
class CutOriginal:
    """A photograph on disk of which a part is printed."""

    original: Original
    window: Window

    def printed(self, px_per_unit: float) -> VectorArt:
        """That part with so many pixels per item unit, never more than the photo has."""
        return self.window.over(self.original.printed(px_per_unit))


def cut(item: Item, matrix: FloatArray, window: Region, name: str) -> Cut | None:
    """Part of an item in place that lies in a window; None if that is nothing to speak of.

    ``matrix`` is a 2 x 3 map from the item's units to the window's, whose name no other has.

    Examples
    --------
    >>> tile = Outline.from_rings([[[-2, -1], [2, -1], [2, 1], [-2, 1]]])
    >>> whole = Item("tile", "", tile, tile, FlatArt())
    >>> part = cut(whole, affine.similarity(0, 0, 0, 1), shapely.box(0, -9, 9, 9), "edge-1")
    >>> part.share, part.centre[0], part.item.outline.bounds
    (0.5, 1.0, (-1.0, -1.0, 1.0, 1.0))
    """
    whole = item.outline.mapped(matrix)
    parts = polygon_parts(intersection(whole.region, window))
    parts = [part for part in parts if part.area >= PART * whole.area]
    if not parts:
        return None
    back = affine.inverse(matrix)
    seen = snap_rounded(shapely.MultiPolygon(parts))
    ink = snap_rounded(intersection(item.ink.mapped(matrix).region, seen))
    opening = intersection(buffered(seen, FREE * whole.extent, join_style="mitre"), window)
    rings = oriented_rings(Outline.from_region(opening).mapped(back).region)
    path = "".join(
        "M" + " ".join(f"{v:.9g}" for v in ring.ravel().tolist()) + "Z" for ring in rings
    )
    clip = f'<path clip-rule="evenodd" d="{path}"/>'
    outline = Outline.from_region(seen).mapped(back)
    inked = outline if ink.area == 0 else Outline.from_region(ink).mapped(back)
    part = _seen_through(item, outline, inked, name, clip, is_traced=True)
    x, y = outline.centroid
    return Cut(part, (float(x), float(y)), float(seen.area) / whole.area)


def part_of(item: Item, share: float) -> Item:
    """The left part of an item that has a share of its outline's area, cut straight.

    Examples
    --------
    >>> tile = Outline.from_rings([[[-2, -1], [2, -1], [2, 1], [-2, 1]]])
    >>> part_of(Item("tile", "", tile, tile, FlatArt()), 0.25).outline.bounds
    (-0.5, -1.0, 0.5, 1.0)
    """
    region, ink = item.outline.region, item.ink.region
    at = _cut_line(region, share)
    outline = Outline.from_region(snap_rounded(_left(region, at)))
    inked = snap_rounded(_left(ink, at))
    left, top, _, bottom = item.ink.bounds
    # The line of the cut is sharp; on all other sides the window is wider than the drawing.
    free = bottom - top + at - left
    clip = (
        f'<rect x="{left - free!r}" y="{top - free!r}"'
        f' width="{at - left + free!r}" height="{bottom - top + 2 * free!r}"/>'
    )
    name = f"part-{at - left:.9g}".replace(".", "-")
    inked_outline = outline if inked.area == 0 else Outline.from_region(inked)
    return _seen_through(item, outline, inked_outline, name, clip, is_traced=False)


def _seen_through(
    item: Item, outline: Outline, ink: Outline, name: str, clip: str, *, is_traced: bool
) -> Item:
    """A part of an item about its own centroid, its drawing behind a window."""
    x, y = (float(value) for value in outline.centroid)
    window = Window(name, clip, affine.similarity(-x, -y, 0.0, 1.0), is_traced)
    art: Art = item.art
    if isinstance(art, PhotoArt):
        art = PhotoArt(window.over(art.preview), CutOriginal(art.original, window))
    elif not isinstance(art, FlatArt):
        art = window.over(art)
    return replace(
        item, outline=outline.mapped(window.place), ink=ink.mapped(window.place), art=art
    )


NOTHING = 1e-9
"""Share of a frame that may be bare and is not seen. Derived: rounding."""


def cropped(art: PhotoArt, frame: Outline, zoom: float, x: float, y: float) -> PhotoArt:
    """A photograph enlarged in its frame and moved, no farther than it still fills it.

    ``zoom``, ``x``, ``y``: as those of a :class:`~packwork.scene.item.Crop`, of the whole of it.
    """
    whole = art if art.crop is None else art.crop.whole
    if zoom <= 1.0:
        return whole
    left, top, right, bottom = frame.bounds
    width, height = right - left, bottom - top

    def moved(share: float) -> FloatArray:
        across = (1.0 - zoom) * (left + right) / 2.0 + share * x * width
        down = (1.0 - zoom) * (top + bottom) / 2.0 + share * y * height
        return affine.similarity(across, down, 0.0, zoom)

    def fills(share: float) -> bool:
        bare = difference(frame.region, frame.mapped(moved(share)).region)
        return bool(bare.area <= NOTHING * width * height)

    low, high = 0.0, 1.0
    if fills(1.0):
        low = 1.0
    else:
        for _ in range(30):
            middle = (low + high) / 2.0
            low, high = (middle, high) if fills(middle) else (low, middle)
    drawn = cast(PhotoArt, mapped_art(whole, moved(low)))
    rings = "".join(
        "M" + " ".join(f"{v:.9g}" for v in ring.ravel().tolist()) + "Z" for ring in frame.rings
    )
    clip = f'<path clip-rule="evenodd" d="{rings}"/>'
    told = f"{whole.preview.markup}{rings}{zoom!r} {x!r} {y!r}".encode()
    name = f"crop-{hashlib.sha256(told).hexdigest()[:12]}"
    window = Window(name, clip, affine.identity(), is_traced=False)
    original = CutOriginal(drawn.original, window)
    return PhotoArt(window.over(drawn.preview), original, Crop(whole, zoom, low * x, low * y))


def _cut_line(region: Region, share: float) -> float:
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
