"""Items cut to a window in place: outline, ink and drawing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, intersection, polygon_parts
from packwork.geometry.polygon import Region, oriented_rings
from packwork.geometry.snapping import sound
from packwork.readers.charts.part import markup_of
from packwork.scene.item import Art, FlatArt, Item, Original, PhotoArt, VectorArt

PART = 0.05
"""Share of an item below which a part that is cut off from the rest is left out. Larger leaves
gaps in clefts of the container, smaller leaves slivers. Chosen by eye."""

FREE = 0.02
"""Width by which a drawing's window is larger than the item where nothing is cut, as a share of
its extent: smaller would pale the item's own edges, which are drawn softly too. Chosen."""


@dataclass(frozen=True, eq=False)
class Cut:
    """An item of which a part is seen.

    Parameters
    ----------
    item
        That part, with a centroid of its own.
    centre
        Where that centroid lies, in the units of the whole item.
    share
        Of the whole item's area.
    """

    item: Item
    centre: tuple[float, float]
    share: float


@dataclass(frozen=True, eq=False)
class CutOriginal:
    """A photograph on disk of which a part is printed."""

    original: Original
    name: str
    path: str
    place: FloatArray

    def printed(self, px_per_unit: float) -> VectorArt:
        """That part with so many pixels per item unit, never more than the photo has."""
        return _behind(self.original.printed(px_per_unit), self.name, self.path, self.place)


def cut(item: Item, matrix: FloatArray, window: Region, name: str) -> Cut | None:
    """Part of an item in place that lies in a window; None if that is nothing to speak of.

    Parameters
    ----------
    matrix
        2 x 3 map from the item's units to those of the window.
    name
        Of the window, its own in any document.

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
    seen = sound(shapely.MultiPolygon(parts))
    outline = Outline.from_region(seen).mapped(back)
    x, y = (float(value) for value in outline.centroid)
    place = affine.similarity(-x, -y, 0.0, 1.0)
    ink = sound(intersection(item.ink.mapped(matrix).region, seen))
    inked = outline if ink.area == 0 else Outline.from_region(ink).mapped(back)
    opening = intersection(buffered(seen, FREE * whole.extent, join_style="mitre"), window)
    path = _path(Outline.from_region(opening).mapped(back).region)
    part = replace(
        item,
        outline=outline.mapped(place),
        ink=inked.mapped(place),
        art=_cut_art(item.art, name, path, place),
    )
    return Cut(part, (x, y), float(seen.area) / whole.area)


def _cut_art(art: Art, name: str, path: str, place: FloatArray) -> Art:
    if isinstance(art, FlatArt):
        return art
    if isinstance(art, PhotoArt):
        preview = _behind(art.preview, name, path, place)
        return PhotoArt(preview, CutOriginal(art.original, name, path, place))
    inner = VectorArt(markup_of(art), art.matrix)
    return _behind(inner, name, path, place)


def _behind(art: VectorArt, name: str, path: str, place: FloatArray) -> VectorArt:
    """Drawing behind a window, in units that begin at the part's own centroid."""
    matrix = " ".join(f"{value:.12g}" for value in art.matrix.T.ravel())
    return VectorArt(
        f'<clipPath id="{name}"><path clip-rule="evenodd" d="{path}"/></clipPath>'
        f'<g clip-path="url(#{name})"><g transform="matrix({matrix})">{art.markup}</g></g>',
        place,
        is_traced=True,
    )


def _path(region: Region) -> str:
    return "".join(
        "M" + " ".join(f"{v:.9g}" for v in ring.ravel().tolist()) + "Z"
        for ring in oriented_rings(region)
    )
