"""Labels of a chart's groups: names, and totals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from packwork.geometry.outline import Outline
from packwork.scene.contrast import between, readable
from packwork.scene.layout import Layout
from packwork.uses.charts.cells import (
    FULL,
    MOST_TURNED_EM,
    SMALLEST_EM,
    TURNED_EM,
    Cell,
)
from packwork.uses.charts.chart import Chart
from packwork.uses.charts.framing import LegendFrame
from packwork.uses.charts.numbers import spoken
from packwork.uses.charts.pen import Pen, shortened

NUMBER_EM, NUMBER_GAP_EM = 0.8, 0.45
"""Letters of numbers over bars, and how far over them. Chosen by eye."""

GAP_EM = 0.5
"""Between a name and a number. Chosen by eye."""

LINE_EM = 0.09
"""Width of the line that bars stand on. Chosen by eye."""

PALE = 0.3
"""How much paper is in the ink of what is less important. Chosen by eye."""

LEAST_CONTRAST = 4.5
"""Of that ink and the paper: WCAG 2.2, 1.4.3, level AA."""


def write_groups(pen: Pen, chart: Chart, layout: Layout) -> None:
    """Names of all groups, and their sums; under bars, or over containers."""
    frame, options, cells = chart.frame, chart.options, chart.cells
    sums, decimal = _sums(layout), chart.read.decimal
    written = {cell.name: spoken(sums.get(cell.name, 0.0), decimal) for cell in cells}
    pale = readable(between((pen.ink, options.paper), PALE), options.paper, LEAST_CONTRAST)
    if not chart.has_bars:
        _over_copies(pen, cells, written, frame.em, pale)
        return
    tops = _tops(layout)
    numbers = {name: text for name, text in written.items() if name in tops}
    em = min(NUMBER_EM * frame.em, *(_fitting(text, cells[0].width) for text in numbers.values()))
    for cell in cells:
        if cell.name in tops and em >= SMALLEST_EM * NUMBER_EM * frame.em:
            y = tops[cell.name] - NUMBER_GAP_EM * frame.em
            pen.write_about(numbers[cell.name], cell.middle, y, em, pale)
    foot = cells[0].room.bounds[3]
    _under_bars(pen, cells, frame, chart.read.is_ordered)
    low, high = frame.left, frame.left + frame.width
    line = Outline.box(low, 0.0, high, LINE_EM * frame.em)
    pen.shape(line, 0.0, foot, 1.0, pale)
    middle = frame.left + frame.width / 2
    pen.write_about(options.by or "", middle, cells[0].line + 1.5 * frame.em, 0.85 * frame.em, pale)


def _over_copies(
    pen: Pen, cells: Sequence[Cell], numbers: Mapping[str, str], largest_em: float, pale: str
) -> None:
    """Names over containers, all of one size; sums beside them if there is room for all."""
    room = FULL * cells[0].width
    least = SMALLEST_EM * largest_em

    def largest(widths: Sequence[float]) -> float:
        return min(largest_em, room / max(widths))

    names = [pen.width(cell.name, 1.0) for cell in cells]
    both = [
        pen.width(cell.name, 1.0) + GAP_EM + NUMBER_EM * pen.width(numbers[cell.name], 1.0)
        for cell in cells
    ]
    has_sums = largest(both) >= least
    em = largest(both) if has_sums else max(largest(names), least)
    for cell, width in zip(cells, both, strict=True):
        if not has_sums:
            pen.write_about(shortened(cell.name, em, room), cell.middle, cell.line, em)
            continue
        end = pen.write(cell.name, cell.middle - em * width / 2, cell.line, em)
        pen.write(numbers[cell.name], end + GAP_EM * em, cell.line, NUMBER_EM * em, pale)


def _under_bars(pen: Pen, cells: Sequence[Cell], frame: LegendFrame, is_ordered: bool) -> None:
    """Names of bars, all of one size; of a scale only as many as there is room for."""
    largest_em = frame.em
    if cells[0].is_turned:
        em = min(TURNED_EM * largest_em, cells[0].width)
        for cell in cells:
            text = shortened(cell.name, em, MOST_TURNED_EM * largest_em)
            pen.write_upwards(text, cell.middle, cells[0].room.bounds[3] + 0.5 * largest_em, em)
        return
    names = [cell.name for cell in cells]
    em = min(largest_em, *(_fitting(name, cells[0].width) for name in names))
    every = 1
    if em < SMALLEST_EM * largest_em:
        em = SMALLEST_EM * largest_em
        if is_ordered:
            widest = max(pen.width(name, em) for name in names)
            every = int(np.ceil(widest / (FULL * cells[0].width)))
    due = 0
    for k, cell in enumerate(cells):
        text = shortened(cell.name, em, every * FULL * cell.width)
        half = pen.width(text, em) / 2
        free = min(cell.middle - frame.left, frame.left + frame.width - cell.middle)
        if k >= due and (every == 1 or half <= free):
            pen.write_about(text, cell.middle, cell.line, em)
            due = k + every


def _fitting(text: str, width: float) -> float:
    """Height of an em at which a text is as wide as it may be."""
    return FULL * width / max(Pen.width(text, 1.0), 1e-9)


def _sums(layout: Layout) -> Mapping[str, float]:
    found: dict[str, float] = {}
    for item in layout.items:
        if item.datum is not None:
            found[item.datum.group] = found.get(item.datum.group, 0.0) + item.datum.value
    return found


def _tops(layout: Layout) -> Mapping[str, float]:
    """End of the highest mark of each group."""
    found: dict[str, float] = {}
    for item, outline in zip(layout.items, layout.outlines, strict=True):
        if item.datum is not None:
            group = item.datum.group
            found[group] = min(found.get(group, np.inf), outline.bounds[1])
    return found
