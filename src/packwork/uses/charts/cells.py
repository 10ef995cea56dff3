"""Places of a chart's groups on the canvas: bars on one line, or copies of a container in rows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import polygon_parts
from packwork.scene.container import Container
from packwork.units import Unit

BAR_SHARE = 0.86
"""Width of a bar over the way from one to the next. Larger ones run into each other, smaller ones
stand apart. Chosen by eye."""

SNUG_SHARE = 0.96
"""The same of round marks that are alike, at most: hollows at the walls part bars. By eye."""

WIDEST_BAR = 0.24
"""Width of a bar over that of all at most: two bars are no walls. Chosen by eye."""

BARS_ASPECT, ROWS_ASPECT = 0.56, 0.8
"""Height over width of bars and of rows of containers, where no sheet was asked for. By eye."""

GUTTER = 0.07
"""Free edge of a container's copy, as a share of its longer side. Chosen by eye."""

OVER_BARS_EM, UNDER_BARS_EM, OVER_COPY_EM = 1.6, 3.2, 2.2
"""Room for numbers over bars, for names under them and for a name over a container. By eye."""

LINE_UNDER_EM, LINE_OVER_EM = 1.25, 0.7
"""From a bar's foot to the line its name stands on; from that of a copy to its top. By eye."""

SMALLEST_EM = 0.62
"""Letters of names over those of the legend at least; narrower rooms have every second name, or
shorter ones. Smaller cannot be read. Chosen by eye."""

FULL = 0.94
"""Share of a cell's width that its name may take. Chosen by eye."""

TURNED_EM, MOST_TURNED_EM = 0.72, 6.0
"""Letters of names that are read upwards, and their length at most, in ems. Chosen by eye."""

EMPTY_PRICE = 0.6
"""What a share of cells that stay empty counts, against the logarithm of an aspect that is off.
Larger makes long rows. Chosen by eye."""


@dataclass(frozen=True, eq=False)
class Cell:
    """Place of one group.

    Parameters
    ----------
    width
        Of its name, along x.
    line
        What the name stands on: y.
    is_turned
        Whether the name is read upwards, for want of width.
    """

    name: str
    room: Outline
    width: float
    line: float
    is_turned: bool = False

    @property
    def middle(self) -> float:
        """Of the room and the name, along x."""
        left, _, right, _ = self.room.bounds
        return (left + right) / 2

    def mapped(self, matrix: FloatArray) -> Cell:
        """Image under a map that neither turns nor stretches.

        Examples
        --------
        >>> tile = Outline.box(0, 0, 1, 1)
        >>> cell = Cell("a", tile, 1.0, 2.0).mapped(affine.similarity(1.0, 0.0, 0.0, 3.0))
        >>> cell.middle, cell.width, cell.line
        (2.5, 3.0, 6.0)
        """
        scale, down = float(matrix[0, 0]), float(matrix[1, 2])
        return replace(
            self,
            room=self.room.mapped(matrix),
            width=self.width * scale,
            line=self.line * scale + down,
        )


def bars(
    names: Sequence[str], height_share: float, em_share: float, unit: Unit, turned: float = 0.0
) -> tuple[Container, tuple[Cell, ...]]:
    """Rectangles side by side on one line, as high as there is room.

    Parameters
    ----------
    height_share
        Height of all, names included, over the width.
    em_share
        Height of letters over the width.
    turned
        Height of names that are read upwards, in ems; 0 for names that are not.

    Examples
    --------
    >>> container, cells = bars(["a", "b", "c", "d", "e"], 0.5, 0.03, "px")
    >>> [round(cell.middle, 3) for cell in cells], round(cells[0].room.bounds[3], 3)
    ([0.1, 0.3, 0.5, 0.7, 0.9], 0.404)
    """
    pitch = bar_pitch(len(names))
    width = BAR_SHARE * pitch
    top, foot = OVER_BARS_EM * em_share, height_share - (UNDER_BARS_EM + turned) * em_share
    cells = []
    for k, name in enumerate(names):
        middle = 0.5 + (k - (len(names) - 1) / 2) * pitch
        room = Outline.box(middle - width / 2, top, middle + width / 2, foot)
        line = foot + (LINE_UNDER_EM + turned) * em_share
        cells.append(Cell(name, room, pitch, line, turned > 0))
    return Container("bars", "none", joined_rooms(cells), 1.0, height_share, unit), tuple(cells)


def bar_pitch(count: int) -> float:
    """Way from one bar to the next, over the width of all.

    Examples
    --------
    >>> bar_pitch(10)
    0.1
    """
    return min(1 / count, WIDEST_BAR / BAR_SHARE)


def copies(
    container: Container, names: Sequence[str], aspect: float, em_share: float
) -> tuple[Container, tuple[Cell, ...]]:
    """Copies of a container in rows, a name over each, in the units of the container.

    Parameters
    ----------
    aspect
        Height over width that all are to have, about.
    em_share
        Height of letters over the width of all.

    Examples
    --------
    >>> tile = Container("tile", "tile", Outline.box(0, 0, 4, 4), 4.0, 4.0)
    >>> whole, cells = copies(tile, ["a", "b", "c"], 1.0, 0.03)
    >>> len(whole.outline.rings), [round(cell.room.area, 9) for cell in cells]
    (3, [16.0, 16.0, 16.0])
    """
    left, top, right, bottom = container.outline.bounds
    free = GUTTER * container.outline.extent
    width, height = right - left + 2 * free, bottom - top + 2 * free
    columns = _columns(len(names), aspect, width, height, em_share)
    over = OVER_COPY_EM * em_share * columns * width
    rows = math.ceil(len(names) / columns)
    cells = []
    for k, name in enumerate(names):
        row, column = divmod(k, columns)
        x, y = column * width, row * (height + over) + over
        place = affine.similarity(x + free - left, y + free - top, 0.0, 1.0)
        line = y + free - LINE_OVER_EM * em_share * columns * width
        room = container.outline.mapped(place)
        cells.append(Cell(name, room, width - free, line))
    whole = replace(
        container, outline=joined_rooms(cells), width=columns * width, height=rows * (height + over)
    )
    return whole, tuple(cells)


def joined_rooms(cells: Sequence[Cell]) -> Outline:
    """Room of all groups as one outline of several parts."""
    parts = [part for cell in cells for part in polygon_parts(cell.room.region)]
    return Outline.from_region(shapely.MultiPolygon(parts))


def _columns(count: int, aspect: float, width: float, height: float, em_share: float) -> int:
    """Number of cells in a row, so that all are about as high for their width as asked."""

    def price(columns: int) -> float:
        rows = math.ceil(count / columns)
        high = rows * (height / (columns * width) + OVER_COPY_EM * em_share)
        empty = (rows * columns - count) / count
        return abs(math.log(high / aspect)) + EMPTY_PRICE * empty

    return min(range(1, count + 1), key=price)
