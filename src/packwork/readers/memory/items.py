"""Values in memory to items and containers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from packwork.geometry import affine
from packwork.geometry.polygon import Region, united
from packwork.readers.memory.coverage import CoverageArray
from packwork.readers.memory.shapes import GivenShape, GivenShapes
from packwork.readers.options import ReadOptions
from packwork.readers.pictures.silhouette import SPECK, outline_of_coverage
from packwork.readers.reading import UnfitError, reading_file
from packwork.readers.regions import Box, Holes, canvas_box, centred, clean_union
from packwork.scene.colour import css_colour
from packwork.scene.container import Container, placed_container
from packwork.scene.item import FlatArt, Item, PhotoArt


def container_in_memory(
    value: object, source: str, side: float, reading: ReadOptions
) -> Container | None:
    """Container of a value on the shelf, its longer side ``side``; None of a file's bytes.

    The canvas of an array is the array; that of geometries is their box.

    Raises
    ------
    ReadError
        About ``source``, if it is none.

    Examples
    --------
    >>> import numpy as np
    >>> mask = CoverageArray("half", np.arange(20) < np.full((10, 1), 10))
    >>> half = container_in_memory(mask, "memory:half", 600.0, ReadOptions())
    >>> half.width, half.height, [round(side) for side in half.outline.bounds]
    (600.0, 300.0, [0, 0, 300, 300])
    """
    with reading_file(source):
        if isinstance(value, Item):
            return _boxed(value.name, source, value.ink.region, side)
        if isinstance(value, GivenShapes):
            return _boxed(value.name, source, united(s.region for s in value.shapes), side)
        if isinstance(value, CoverageArray):
            rows, columns = value.shares.shape
            if value.shares.max() < 0.5:
                raise UnfitError("is False, or 0, all over; True, or 1, is inside")
            region = clean_union(outline_of_coverage(value.shares), speck=SPECK)
            page = float(columns), float(rows)
            canvas = canvas_box(region.bounds, page, reading.trim, None)
            return placed_container(value.name, source, region, canvas, side)
    return None


def _boxed(name: str, source: str, region: Region, side: float) -> Container:
    left, top, right, bottom = region.bounds
    # About its own corner first: far from the origin few digits are left for the shape.
    near = clean_union(shapely.transform(region, lambda points: points - (left, top)))
    canvas: Box = (0.0, 0.0, right - left, bottom - top)
    return placed_container(name, source, near, canvas, side)


OFF_CENTRE = 0.01
"""Distance of an outline's centroid from its origin, as a share of its extent, from which the
item is moved there. Below lie items whose lines have become thinner. Chosen."""


def items_in_memory(value: object, source: str, holes: Holes) -> list[Item] | None:
    """Items of a value on the shelf; None of one that readers of files understand.

    Raises
    ------
    ReadError
        About ``source``, if it is none.

    Examples
    --------
    >>> mask = CoverageArray("all", np.ones((10, 10)))
    >>> [item.name for item in items_in_memory(mask, "memory:all", "fill")]
    ['all']
    """
    with reading_file(source):
        if isinstance(value, Item):
            return [recentred(value)]
        if isinstance(value, GivenShapes):
            return [_item_of_shape(shape, source, holes) for shape in value.shapes]
        if isinstance(value, CoverageArray):
            if value.shares.max() < 0.5:
                raise UnfitError("is False, or 0, all over; True, or 1, is inside")
            region = clean_union(outline_of_coverage(value.shares), speck=SPECK)
            return [_item_of_shape(GivenShape(value.name, region), source, holes)]
        if isinstance(value, Container):
            return [_item_of_shape(GivenShape(value.name, value.outline.region), source, holes)]
    return None


def recentred(item: Item) -> Item:
    """The item with its outline's centroid at the origin; itself, if it is there.

    Examples
    --------
    >>> import shapely
    >>> from packwork.geometry.outline import Outline
    >>> far = Outline.from_region(shapely.box(10, 10, 12, 12))
    >>> recentred(Item("tile", "", far, far, FlatArt())).outline.bounds
    (-1.0, -1.0, 1.0, 1.0)
    """
    x, y = item.outline.centroid
    if np.hypot(x, y) <= OFF_CENTRE * item.outline.extent:
        return item
    place = affine.similarity(-float(x), -float(y), 0.0, 1.0)
    art = item.art
    if isinstance(art, PhotoArt):
        raise UnfitError("has an outline off its photograph's middle; recentre both")
    if not isinstance(art, FlatArt):
        art = replace(art, matrix=affine.compose(place, art.matrix))
    return replace(item, outline=item.outline.mapped(place), ink=item.ink.mapped(place), art=art)


def _item_of_shape(shape: GivenShape, source: str, holes: Holes) -> Item:
    outline, ink, _ = centred(clean_union(shape.region), holes)
    art = FlatArt(shape.fill) if _is_colour(shape.fill) else FlatArt()
    return Item(shape.name, source, outline, ink, art, weight=shape.weight, row=shape.row)


def _is_colour(text: str) -> bool:
    try:
        return css_colour(text)[3] > 0
    except ValueError:
        return False
