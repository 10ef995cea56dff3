"""Items and drawings in other units: turned over, moved, enlarged."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import cast

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.scene.item import Art, Crop, FlatArt, Item, Original, PhotoArt, VectorArt


@dataclass(frozen=True, eq=False)
class MappedOriginal:
    """A photograph on disk in other item units, opened anew each time it is printed.

    ``matrix``: 2 x 3 map from the item units of ``original``.
    """

    original: Original
    matrix: FloatArray

    def printed(self, px_per_unit: float) -> VectorArt:
        """The photograph with that many pixels per item unit."""
        factor = math.sqrt(abs(float(np.linalg.det(self.matrix[:, :2]))))
        art = self.original.printed(px_per_unit * factor)
        return replace(art, matrix=affine.compose(self.matrix, art.matrix))


def mirrored(item: Item) -> Item:
    """The item turned over, left to right about its origin; what it says is curves then.

    >>> flag = Item("flag", outline=[(-1, -1), (2, -1), (-1, 2)])
    >>> mirrored(flag).outline.bounds
    (-2.0, -1.0, 1.0, 2.0)
    """
    turned = affine.mirrored()

    def over(outline: Outline) -> Outline:
        return Outline.of(
            shapely.transform(outline.region, lambda points: affine.apply(turned, points))
        )

    outline = over(item.outline)
    ink = outline if item.ink is item.outline else over(item.ink)
    art, own = _turned_over(item.art), item.own_art
    own = None if own is None else _turned_over(own)
    return replace(item, outline=outline, ink=ink, art=art, text=None, own_art=own)


def _turned_over(art: Art) -> Art:
    turned = affine.mirrored()
    made = mapped_art(art, turned)
    if not isinstance(made, PhotoArt) or (crop := made.crop) is None:
        return made
    whole = cast(PhotoArt, mapped_art(crop.whole, turned))
    return replace(made, crop=Crop(whole, crop.zoom, -crop.x, crop.y))


def mapped_art(art: Art, matrix: FloatArray) -> Art:
    """A drawing in other item units, by their 2 x 3 map; a colour as it is."""
    if isinstance(art, FlatArt):
        return art
    if isinstance(art, PhotoArt):
        preview = replace(art.preview, matrix=affine.compose(matrix, art.preview.matrix))
        return PhotoArt(preview, MappedOriginal(art.original, matrix), art.crop)
    return replace(art, matrix=affine.compose(matrix, art.matrix))
