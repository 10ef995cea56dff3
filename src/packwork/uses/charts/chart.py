"""A unit chart that was read and laid out."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import IntArray
from packwork.readers.charts.chart import ChartRead
from packwork.readers.charts.options import ChartOptions
from packwork.scene.container import Container
from packwork.uses.charts.cells import Cell
from packwork.uses.charts.framing import LegendFrame


@dataclass(frozen=True, eq=False)
class Chart:
    """Marks of a chart, and where its groups, title and legend go.

    Parameters
    ----------
    cells
        Where groups go; empty if there are none.
    single
        The container of which each group has a copy; None where they are bars.
    """

    read: ChartRead
    frame: LegendFrame
    cells: tuple[Cell, ...]
    single: Container | None

    @property
    def options(self) -> ChartOptions:
        """Options of the chart."""
        return self.read.options

    @property
    def has_bars(self) -> bool:
        """Whether marks lie in bars."""
        return bool(self.cells) and self.single is None

    @property
    def members(self) -> list[IntArray]:
        """Marks of each group, in the order of the cells; empty for steps without any."""
        return [np.flatnonzero(self.read.group_of == k) for k in range(len(self.cells))]

    def subset(self, kept: IntArray) -> Chart:
        """The same of some of the marks, by their indices ``(m,)``."""
        return replace(self, read=self.read.subset(kept))
