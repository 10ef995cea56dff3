"""A chart on its canvas: its container, or the places of its groups, framed by title and legend."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.errors import RecipeError
from packwork.readers.charts.chart import ChartRead
from packwork.recipe import Recipe
from packwork.scene.container import Container
from packwork.units import DEFAULT_SIDE, CanvasSize, Unit
from packwork.uses.charts.cells import (
    BAR_SHARE,
    BARS_ASPECT,
    FULL,
    MOST_TURNED_EM,
    OVER_BARS_EM,
    ROWS_ASPECT,
    SMALLEST_EM,
    SNUG_SHARE,
    TURNED_EM,
    UNDER_BARS_EM,
    Cell,
    bar_pitch,
    bars,
    copies,
)
from packwork.uses.charts.framing import EM_SHARE, LegendFrame, frame_ems, framed
from packwork.uses.charts.heights import is_alike_and_round, needed_height
from packwork.uses.charts.pen import Pen

LEAST_ASPECT = 0.12
"""Height over width of what shows marks at least, whatever the sheet. Chosen."""


@dataclass(frozen=True, eq=False)
class ChartLayout:
    """Frame that a chart is laid out on.

    Parameters
    ----------
    container
        On its canvas; of several parts where there are groups.
    cells
        Where groups go; empty if there are none.
    single
        The container of which each group has a copy; None for bars, and where there are none.
    """

    container: Container
    frame: LegendFrame
    cells: tuple[Cell, ...] = ()
    single: Container | None = None


def spread_out(recipe: Recipe, chart: ChartRead, single: Container | None) -> ChartLayout:
    """Places for all that a chart shows.

    Parameters
    ----------
    single
        The container to fill, or of which each group has a copy; None for bars.

    Raises
    ------
    RecipeError
        If there are no groups to make bars of.
    """
    if single is None and not chart.groups:
        raise RecipeError("container", "none shows groups as bars: give --by COL, or a container")
    size = recipe.canvas_size
    if single is not None and not chart.groups:
        plain = framed(single, recipe, chart, size)
        return ChartLayout(plain.container, plain.frame)
    aspect = _aspect(recipe, chart, ROWS_ASPECT if single is not None else _bars_aspect(chart))
    if single is None:
        unit: Unit = "px" if size is None else size.unit
        whole, cells = bars(chart.groups, aspect, EM_SHARE, unit, turned_ems(chart))
        size = size or CanvasSize(DEFAULT_SIDE, None, "px")
    else:
        whole, cells = copies(single, chart.groups, aspect, EM_SHARE)
        size = size or CanvasSize(single.side, None, single.unit)
    about = framed(whole, recipe, chart, size)
    placed = tuple(cell.mapped(about.place) for cell in cells)
    return ChartLayout(about.container, about.frame, placed, single)


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


def _aspect(recipe: Recipe, chart: ChartRead, otherwise: float) -> float:
    """Height over width that lets a chart take all of its sheet, if it was asked for one."""
    size = recipe.canvas_size
    if size is None or size.height is None:
        return otherwise
    above, below, margin = frame_ems(recipe, chart)
    whole = size.height / size.width * (1 + 2 * margin * EM_SHARE)
    return max(whole - (above + below) * EM_SHARE, LEAST_ASPECT)
