"""A chart on its canvas: bars on one line, copies of a container in rows, or one container.

All of it is framed by room for the title and the legend.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.errors import RecipeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import polygon_parts
from packwork.readers.charts import ChartOptions
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.units import DEFAULT_SIDE, CanvasSize, Unit
from packwork.uses.charts.colours import ChartColours
from packwork.uses.charts.framing import EM_SHARE, LegendFrame, frame_ems, framed
from packwork.uses.charts.marks import ChartRead
from packwork.uses.charts.pen import Pen
from packwork.uses.charts.regions import NamedRegion

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

LEAST_ASPECT = 0.12
"""Height over width of what shows marks at least, whatever the sheet. Chosen."""

COVER = 0.66
"""Share of a bar that marks are thought to cover before that is known. Larger lets marks come out
smaller than the width allows, smaller leaves paper over bars. Chosen."""

ROUND = 0.98
"""Share of the disc that holds it which a round mark covers at least. Chosen."""

HOLLOW = 3**0.5 / 2
"""Height of a row of discs that lies in the hollows of the one below, over their distance."""

UNEVEN = 1.06
"""Height of heaps of such rows over that of perfect ones. Measured."""


@dataclass(frozen=True, eq=False)
class Cell:
    """Place of one group; its name is so wide, stands on a line (y), and may be read upwards."""

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


@dataclass(frozen=True, eq=False)
class Chart:
    """Marks of a chart, their colours, and where its groups, title and legend go.

    There are no ``cells`` where there are no groups; ``single`` is the container of which each
    group has a copy, None where they are bars. ``regions``: parts of it that are drawn, the first
    of which are the cells.
    """

    read: ChartRead
    colours: ChartColours
    frame: LegendFrame
    cells: tuple[Cell, ...] = ()
    single: Container | None = None
    regions: tuple[NamedRegion, ...] = ()

    @property
    def options(self) -> ChartOptions:
        """Options of the chart."""
        return self.read.options

    @property
    def has_bars(self) -> bool:
        """Whether marks lie in bars."""
        return bool(self.cells) and self.single is None

    @property
    def least_share(self) -> float | None:
        """Least area that a mark of a group has in its part of a map; None without parts."""
        shared = zip(self.cells, self.members, strict=True) if self.regions else ()
        return min((cell.room.area / len(own) for cell, own in shared if len(own)), default=None)

    @property
    def members(self) -> list[IntArray]:
        """Marks of each group, in the order of the cells; empty for steps without any."""
        return [np.flatnonzero(self.read.group_of == k) for k in range(len(self.cells))]

    def subset(self, kept: IntArray) -> Chart:
        """The same of some of the marks, by their indices ``(m,)``."""
        return replace(self, read=self.read.subset(kept), colours=self.colours.subset(kept))


def spread_out(
    recipe: Recipe,
    chart: ChartRead,
    colours: ChartColours,
    single: Container | None,
    regions: Sequence[NamedRegion] = (),
) -> tuple[Chart, Container]:
    """A chart on its canvas, and all that is filled: of several parts where there are groups.

    ``single`` is the container to fill, or of which each group has a copy; None for bars.
    ``regions``: parts of it that groups fill instead, in their order, and then those of no group.
    """
    if single is None and not chart.groups:
        raise RecipeError("container", "none shows groups as bars: give --by COL, or a container")
    size = recipe.canvas_size
    if single is not None and not chart.groups:
        container, frame, _ = framed(single, chart, colours, size)
        return Chart(chart, colours, frame), container
    if single is not None and regions:
        # Borders are drawn beside the marks, rooms are not.
        whole = replace(single, outline=joined_rooms(_cells(regions, chart)), walls=())
        container, frame, place = framed(whole, chart, colours, size)
        there = tuple(one.mapped(place) for one in regions)
        return Chart(chart, colours, frame, _cells(there, chart), single, there), container
    usual = ROWS_ASPECT if single is not None else _bars_aspect(chart)

    def in_room_of(whole: Container | None) -> tuple[Container, tuple[Cell, ...]]:
        aspect = _aspect(size, chart, colours, usual, whole)
        if single is not None:
            return copies(single, chart.groups, aspect, EM_SHARE)
        unit: Unit = "px" if size is None else size.unit
        return bars(chart.groups, aspect, EM_SHARE, unit, turned_ems(chart))

    # How high keys are is known from what marks have room in.
    whole, cells = in_room_of(in_room_of(None)[0])
    if size is None:
        plain = CanvasSize(DEFAULT_SIDE, None, "px")
        size = plain if single is None else CanvasSize(single.side, None, single.unit)
    container, frame, place = framed(whole, chart, colours, size)
    placed = tuple(cell.mapped(place) for cell in cells)
    return Chart(chart, colours, frame, placed, single), container


def _cells(regions: Sequence[NamedRegion], chart: ChartRead) -> tuple[Cell, ...]:
    """Cells of those parts that have a group."""
    return tuple(Cell(one.name, one.room, 0.0, 0.0) for one in regions[: len(chart.groups)])


def _bars_aspect(chart: ChartRead) -> float:
    """Height over width of bars, their names included: no more than the fullest needs."""
    names = (OVER_BARS_EM + UNDER_BARS_EM + turned_ems(chart)) * EM_SHARE
    pitch = bar_pitch(len(chart.groups))
    share = SNUG_SHARE if is_alike_and_round(chart) else BAR_SHARE
    most = BARS_ASPECT - (OVER_BARS_EM + UNDER_BARS_EM) * EM_SHARE
    return names + max(needed_height(chart, share * pitch, most), LEAST_ASPECT)


def turned_ems(chart: ChartRead) -> float:
    """Height of names under bars where they have to be read upwards, in ems; else 0."""
    room = FULL * bar_pitch(len(chart.groups)) / EM_SHARE
    longest = max(Pen.width(name, SMALLEST_EM) for name in chart.groups)
    if chart.is_ordered or longest <= room:
        return 0.0
    return min(longest * TURNED_EM / SMALLEST_EM, MOST_TURNED_EM)


def _aspect(
    size: CanvasSize | None,
    chart: ChartRead,
    colours: ChartColours,
    otherwise: float,
    room: Container | None,
) -> float:
    """Height over width that lets a chart take all of its sheet, if it was asked for one.

    ``room`` is what marks have room in, as far as that is known.
    """
    if size is None or size.height is None:
        return otherwise
    above, below, margin = frame_ems(chart, colours, room)
    whole = size.height / size.width * (1 + 2 * margin * EM_SHARE)
    return max(whole - (above + below) * EM_SHARE, LEAST_ASPECT)


def bars(
    names: Sequence[str], height_share: float, em_share: float, unit: Unit, turned: float = 0.0
) -> tuple[Container, tuple[Cell, ...]]:
    """Rectangles side by side on one line, as high as there is room; all lengths over the width.

    ``turned`` is the height of names that are read upwards, in ems; 0 for names that are not.

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

    All are about ``aspect`` times as high as wide; letters are ``em_share`` of the width of
    all.

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


def is_alike_and_round(chart: ChartRead) -> bool:
    """Whether all marks are one and the same disc."""
    first = chart.items[0].outline
    is_round = first.area > ROUND * np.pi * first.radius**2
    is_alike = all(item.outline is first for item in chart.items)
    return is_round and is_alike and bool(np.ptp(chart.areas) == 0)


def rows_in_hollows(most: int, width: float, height: float, gap: float) -> tuple[int, float]:
    """Number of discs in a row, and their distance, so that those of the fullest bar are largest.

    Bars are as wide as so many discs and a half: rows then lie in the hollows of those below.

    Examples
    --------
    >>> rows_in_hollows(52, 1.0, 6.0, 0.0)
    (3, 0.2857142857142857)
    """

    def distance(across: int) -> float:
        by_width = (width - gap) / (across + 0.5)
        by_height = (height - gap) / height_over_distance(most, across)
        return float(min(by_width, by_height))

    across = max(range(1, most + 1), key=distance)
    return across, distance(across)


def height_over_distance(most: int, across: int) -> float:
    """Height of so many discs in rows of so many, over their distance."""
    rows = -(-most // across)
    return UNEVEN * (1 + (rows - 1) * HOLLOW)


def needed_height(chart: ChartRead, width: float, height: float) -> float:
    """Height that the fullest bar needs, at most the one given; its width is that of the bars."""
    if is_alike_and_round(chart):
        most = int(np.bincount(chart.group_of).max())
        across, distance = rows_in_hollows(most, width, height, 0.0)
        return min(height, distance * height_over_distance(most, across))
    radii = np.array([item.outline.radius for item in chart.items])
    own = np.array([item.outline.area for item in chart.items])
    widest = width / (2 * float((radii * np.sqrt(chart.areas / own)).max()))
    fullest = float(np.bincount(chart.group_of, weights=chart.areas).max())
    return float(min(height, max(fullest * widest**2 / (COVER * width), width)))
