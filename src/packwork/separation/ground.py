"""Sheets side by side, of any outline, as one strip: what is no sheet is an obstacle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import shapely
from shapely.geometry import MultiPolygon, box

from packwork.geometry.overlay import difference, intersection, polygon_parts
from packwork.geometry.polygon import Region
from packwork.separation.shapes import Floats

WALL = 0.1
"""Width of what parts two sheets, over the strip's height."""

MOST_APART = 300
"""Parts that lie already, each an obstacle by itself; more are put together by tiles."""

TILES = 4
"""Tiles of the shorter side into which obstacles are cut: larger ones have worse poles, and are
priced with parts far from them."""


@dataclass(frozen=True)
class Bay:
    """A sheet's stretch of the strip, from ``start`` to ``end``, and the area that is free in it.

    ``offset``: (x, y) that takes a point of the sheet to the strip.
    """

    start: float
    end: float
    area: float
    offset: tuple[float, float]


@dataclass(frozen=True)
class Ground:
    """Sheets side by side, or a strip without end where there are none."""

    height: float
    bays: tuple[Bay, ...] = ()
    obstacles: tuple[Region, ...] = ()
    axes: tuple[int, ...] = (0,)
    """Along which a shorter one is shorter: x, y."""
    measure: str = "length"
    """Name of what gets shorter, as progress tells it."""

    def height_at(self, length: float) -> float:
        """Height of what is cut off at a length."""
        del length
        return self.height

    @property
    def end(self) -> float:
        """Right edge of the last sheet; infinite for a strip."""
        return self.bays[-1].end if self.bays else math.inf

    def length_for(self, area: float) -> float:
        """Line with that much free area to its left; the end where there is less."""
        if not self.bays:
            return area / self.height
        for bay in self.bays:
            if area <= bay.area:
                return bay.start + area / bay.area * (bay.end - bay.start)
            area -= bay.area
        return self.end

    def start_at(self, x: float) -> float:
        """Left edge of the sheet on which a line lies; 0 on a strip."""
        return next((bay.start for bay in self.bays if x <= bay.end), 0.0)

    def skip_forward(self, x: float, widest: float) -> float:
        """The line, or one further right where nothing fits between it and the sheet's edge."""
        for bay in self.bays:
            if x <= bay.end:
                return min(max(x, bay.start + widest), bay.end)
        return self.end

    def bay_at(self, x: Floats) -> npt.NDArray[np.int64]:
        """Number of the sheet on which each of several lines lies."""
        return np.searchsorted([bay.end for bay in self.bays], x, side="left")

    def skip_back(self, x: float, narrowest: float) -> float:
        """The line, or the end of the sheet before where nothing fits between them."""
        start = self.start_at(x)
        ends = [bay.end for bay in self.bays if bay.end < start]
        return ends[-1] if ends and x - start < narrowest else x


def ground_of(sheets: Sequence[Region], held: Sequence[Sequence[Region]] = ()) -> Ground:
    """Ground of sheets, in their order.

    Parameters
    ----------
    sheets
        Free regions, each in coordinates of its own.
    held
        Of each sheet what lies on it already, in the sheet's coordinates.
    """
    bounds = [sheet.bounds for sheet in sheets]
    height = max(y1 - y0 for _, y0, _, y1 in bounds)
    bays, obstacles, x = list[Bay](), list[Region](), 0.0
    for k, (sheet, (x0, y0, x1, _)) in enumerate(zip(sheets, bounds, strict=True)):
        offset = (x - x0, -y0)
        end = x + (x1 - x0)
        about = box(x0, y0, x1, y0 + height)
        taken = [difference(about, sheet), *(_grouped(held[k], height / TILES) if held else ())]
        wall = box(end, 0.0, end + WALL * height, height)
        obstacles += tiles(_moved(taken[0], offset), height / TILES)
        obstacles += [_moved(one, offset) for one in taken[1:]]
        obstacles += tiles(wall, height)
        free = sheet.area - sum(one.area for one in taken[1:])
        bays.append(Bay(x, end, max(free, 1e-9 * sheet.area), offset))
        x = end + WALL * height
    return Ground(height, tuple(bays), tuple(obstacles))


def tiles(region: Region, side: float) -> list[Region]:
    """Polygons that make up a region, none larger than a square of a side."""
    found = list[Region]()
    for part in polygon_parts(region):
        x0, y0, x1, y1 = part.bounds
        across, down = math.ceil((x1 - x0) / side), math.ceil((y1 - y0) / side)
        if across * down <= 1:
            found.append(part)
            continue
        wide, tall = (x1 - x0) / across, (y1 - y0) / down
        for i in range(across):
            for j in range(down):
                square = box(x0 + i * wide, y0 + j * tall, x0 + (i + 1) * wide, y0 + (j + 1) * tall)
                found += polygon_parts(intersection(part, square))
    return found


def _grouped(regions: Sequence[Region], side: float) -> list[Region]:
    """The same regions; where they are many, all of a tile as one."""
    if len(regions) <= MOST_APART:
        return list(regions)
    centres = np.array([one.centroid.coords[0] for one in regions])
    _, number = np.unique(np.floor(centres / side), axis=0, return_inverse=True)
    return [
        MultiPolygon([part for k in np.flatnonzero(number.ravel() == n)
                      for part in polygon_parts(regions[int(k)])])
        for n in range(number.max() + 1)
    ]  # fmt: skip


def _moved(region: Region, offset: tuple[float, float]) -> Region:
    return shapely.transform(region, lambda points: points + offset)
