"""Values in memory to containers."""

from __future__ import annotations

import shapely

from packwork.geometry.polygon import Region, united
from packwork.readers.memory.coverage import Coverage
from packwork.readers.memory.shapes import Shapes
from packwork.readers.options import ReadOptions
from packwork.readers.pictures.silhouette import SPECK, outline_of_coverage
from packwork.readers.regions import clean_union
from packwork.readers.trimming import Box, canvas_box
from packwork.readers.unfit import UnfitError, naming
from packwork.scene.canvas import placed_container
from packwork.scene.container import Container
from packwork.scene.item import Item


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
    >>> mask = Coverage("half", np.arange(20) < np.full((10, 1), 10))
    >>> half = container_in_memory(mask, "memory:half", 600.0, ReadOptions())
    >>> half.width, half.height, [round(side) for side in half.outline.bounds]
    (600.0, 300.0, [0, 0, 300, 300])
    """
    with naming(source):
        if isinstance(value, Item):
            return _boxed(value.name, source, value.ink.region, side)
        if isinstance(value, Shapes):
            return _boxed(value.name, source, united(s.region for s in value.shapes), side)
        if isinstance(value, Coverage):
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
