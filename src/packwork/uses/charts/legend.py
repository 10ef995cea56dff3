"""Notes about the marks of a chart: title, names of groups, keys of sizes, colours and forms."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from packwork.geometry.outline import Outline
from packwork.readers.charts import ChartOptions
from packwork.readers.tables.cells import any_number
from packwork.scene.contrast import between, readable
from packwork.scene.layout import Layout, Note
from packwork.uses.charts.colours import UNKNOWN, ChartColours
from packwork.uses.charts.framing import (
    EM_SHARE,
    LEAD_EM,
    LINE_EM,
    RAMP_EM,
    TITLE_EM,
    TRAIL_EM,
    UNIT_EM,
    LegendFrame,
    has_sizes,
    in_lines,
    key_names,
    key_scale,
    key_text,
)
from packwork.uses.charts.layout import (
    FULL,
    MOST_TURNED_EM,
    SMALLEST_EM,
    TURNED_EM,
    Cell,
    Chart,
)
from packwork.uses.charts.marks import ChartRead
from packwork.uses.charts.pen import MIDDLE_EM, Pen, places_of, shortened, spoken
from packwork.uses.charts.regions import draw_regions
from packwork.uses.charts.rows import SPECK

INK = "#2d3748"
LEAST_CONTRAST = 7.0
"""Of letters and what is behind them: WCAG 2.2, 1.4.6, level AAA."""

STRIPES = 48
"""Rectangles that a ramp is drawn with. Fewer show. Chosen by eye."""

KEY_EM = 0.85
"""Letters of numbers in keys. Chosen by eye."""

SMALLEST_UNIT_EM = 0.25
"""Side of the mark that is the key to a unit, at least: specks would not be seen. Chosen by eye."""


NUMBER_EM, NUMBER_GAP_EM = 0.8, 0.45
"""Letters of numbers over bars, and how far over them. Chosen by eye."""

GAP_EM = 0.5
"""Between a name and a number. Chosen by eye."""

RULE_EM = 0.09
"""Width of the line that bars stand on. Chosen by eye."""

MOST_PLACES = 4
"""Decimals at most that sums are written with, as their table has them: more are results of
arithmetic. Chosen."""

PALE = 0.3
"""How much paper is in the ink of what is less important. Chosen by eye."""

PALE_CONTRAST = 4.5
"""Of that ink and the paper: WCAG 2.2, 1.4.3, level AA."""


def legend_notes(chart: Chart, layout: Layout) -> tuple[Note, ...]:
    """Title, names of groups and legend of a chart."""
    options, read, frame = chart.options, chart.read, chart.frame
    pen = Pen(readable(INK, options.paper, LEAST_CONTRAST))
    if options.title:
        em = min(1.5 * frame.em, frame.width / max(pen.width(options.title, 1.0), 1.0))
        pen.write(options.title, frame.left, frame.top + 0.75 * TITLE_EM * frame.em, em)
    if chart.cells:
        _groups(pen, chart, layout)
    if not options.legend:
        return tuple(pen.notes)
    y = frame.below
    if has_sizes(options):
        (_sizes if options.unit is None else _unit)(pen, chart, layout, y)
        y += frame.keys_height
    if chart.colours.ramp and options.color_by:
        _ramp(pen, chart.colours, options.color_by, frame, y, read.decimal)
        y += RAMP_EM * frame.em
    _categories(pen, chart, y)
    return tuple(pen.notes)


def _groups(pen: Pen, chart: Chart, layout: Layout) -> None:
    frame, options, cells = chart.frame, chart.options, chart.cells
    sums, places = _sums(chart.read, layout), _places(chart.read)
    decimal = chart.read.size_decimal
    if places is not None:
        places = places_of(round(number, places) for number in sums.values())
    written = {cell.name: spoken(sums.get(cell.name, 0.0), decimal, places) for cell in cells}
    pale = readable(between((pen.ink, options.paper), PALE), options.paper, PALE_CONTRAST)
    if chart.regions:
        draw_regions(pen, chart.regions, layout.container.side, pale)
        return
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
    line = Outline.box(low, 0.0, high, RULE_EM * frame.em)
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
    return FULL * width / max(Pen.width(text, 1.0), 1e-9)


def _sums(read: ChartRead, layout: Layout) -> Mapping[str, float]:
    """Sum of what is drawn of each group, and of specks that no mark was cut for."""
    found: dict[str, float] = {}
    for item in layout.items:
        if item.datum is not None:
            found[item.datum.group] = found.get(item.datum.group, 0.0) + item.datum.value
    of_rows: dict[str, list[float]] = {}
    groups = (read.groups[k] for k in read.group_of)
    for group, amount in dict(
        zip(read.row_of.tolist(), zip(groups, _amounts(read), strict=True), strict=True)
    ).values():
        of_rows.setdefault(group, []).append(amount)
    for group in of_rows.keys() & found.keys():
        whole = math.fsum(of_rows[group])
        specks = SPECK * (read.options.unit or 0.0) * len(of_rows[group])
        if abs(whole - found[group]) <= specks:
            found[group] = whole
    return found


def _amounts(read: ChartRead) -> list[float]:
    """``(n,)`` what the row of each mark says; without a column of sizes, what the mark does."""
    column = read.options.size_by
    if column is None:
        return list(map(float, read.values))
    return [any_number(row.get(column)) for row in read.rows]


def _places(read: ChartRead) -> int | None:
    """Decimals of the column of sizes; None if those are too many to be shown."""
    places = places_of(set(_amounts(read)))
    return places if places <= MOST_PLACES else None


def _tops(layout: Layout) -> Mapping[str, float]:
    """End of the highest mark of each group."""
    found: dict[str, float] = {}
    for item, outline in zip(layout.items, layout.outlines, strict=True):
        if item.datum is not None:
            group = item.datum.group
            found[group] = min(found.get(group, np.inf), outline.bounds[1])
    return found


def _unit(pen: Pen, chart: Chart, layout: Layout, y: float) -> None:
    """A mark and what it stands for."""
    read, options, frame, em = chart.read, chart.options, chart.frame, chart.frame.em
    mark = next(iter(read.marks.values())).outline
    left, top, right, bottom = mark.bounds
    own = _scale(options, layout, mark, options.unit or 1.0)
    room = frame.keys_height - (UNIT_EM - 1.0) * em
    scale = max(own, SMALLEST_UNIT_EM * em / mark.extent)
    if own * (bottom - top) > room:
        # Marks are larger than a key may be.
        scale = em / mark.extent
    line = y + 0.85 * em + max(0.35 * em, (bottom - top) * scale / 2)
    middle = line - 0.35 * em - (top + bottom) / 2 * scale
    pen.shape(mark, frame.left - left * scale, middle, scale, UNKNOWN)
    stands_for = f"= {spoken(options.unit or 1.0, read.size_decimal)} {options.size_by or 'rows'}"
    pen.write(stands_for, frame.left + (right - left) * scale + 0.5 * em, line, em)


def _sizes(pen: Pen, chart: Chart, layout: Layout, y: float) -> None:
    """Marks of round numbers, at the chart's own scale; where none fits, the ends of all."""
    read, options, frame, em = chart.read, chart.options, chart.frame, chart.frame.em
    mark = next(iter(read.marks.values())).outline
    scales = [_scale(options, layout, mark, number) for number in frame.keys]
    heading = options.size_by or "rows"
    if not frame.keys:
        # Marks are larger than a key may be, or specks.
        ends = _ends(dict.fromkeys(read.ends), read.size_decimal, _places(read))
        heading += ": " + " – ".join(ends)
    pen.write(heading, frame.left, y + 1.2 * em, em)
    tallest = (mark.bounds[3] - mark.bounds[1]) * max(scales, default=0.0)
    middle, x = y + 1.9 * em + max(tallest, em) / 2, frame.left
    line = middle + MIDDLE_EM * KEY_EM * em
    for number, scale in zip(frame.keys, scales, strict=True):
        left, top, right, bottom = (v * scale for v in mark.bounds)
        pen.shape(mark, x - left, middle - (top + bottom) / 2, scale, UNKNOWN)
        begin = x + right - left + 0.4 * em
        x = pen.write(spoken(number, read.size_decimal), begin, line, KEY_EM * em) + 1.6 * em


def _scale(options: ChartOptions, layout: Layout, mark: Outline, number: float) -> float:
    """Canvas units per unit of a mark that stands for a number."""
    values = [0.0 if item.datum is None else item.datum.value for item in layout.items]
    k = int(np.argmax(values))
    own = layout.items[k].outline
    return key_scale(options, mark, number / values[k], own, float(layout.poses.scale[k]))


def _ends(values: Iterable[float], decimal: str, places: int | None) -> list[str]:
    """Ends of a range of numbers, whole ones without decimals."""
    return [
        spoken(value, decimal, 0 if places and float(value).is_integer() else places)
        for value in values
    ]


def _ramp(
    pen: Pen, colours: ChartColours, column: str, frame: LegendFrame, y: float, decimal: str
) -> None:
    em, low, high = frame.em, *colours.ends
    pen.write(column, frame.left, y + 1.2 * em, em)
    step = min(frame.width, 16 * em) / STRIPES
    for k in range(STRIPES):
        fill = between(colours.ramp, k / (STRIPES - 1))
        # Each reaches under the next: the paper would show between edges that only meet.
        tile = Outline.box(0.0, 0.0, step * (1.5 if k < STRIPES - 1 else 1.0), 0.8 * em)
        pen.shape(tile, frame.left + k * step, y + 1.8 * em, 1.0, fill)
    places = places_of((low, high))
    texts = _ends((low, high), decimal, places if places <= MOST_PLACES else None)
    if places == 0 and max(abs(low), abs(high)) < 1e4:
        # They may be years, which have no groups.
        texts = [f"{low:.0f}", f"{high:.0f}"]
    pen.write(texts[0], frame.left, y + 3.6 * em, KEY_EM * em)
    right = frame.left + STRIPES * step - pen.width(texts[1], KEY_EM * em)
    pen.write(texts[1], right, y + 3.6 * em, KEY_EM * em)


def _categories(pen: Pen, chart: Chart, y: float) -> None:
    frame, em = chart.frame, chart.frame.em
    marks, fills = chart.read.marks, dict(chart.colours.keys)
    first = next(iter(marks.values()))
    line = y + 1.2 * em
    for names in in_lines(key_names(chart.read, chart.colours), 1 / EM_SHARE):
        x = frame.left
        for name in names:
            ink = marks.get(name, first).ink
            scale = 1.1 * em / ink.extent
            left, top, _, bottom = ink.bounds
            middle = line - 0.35 * em - (top + bottom) / 2 * scale
            pen.shape(ink, x - left * scale, middle, scale, fills.get(name, UNKNOWN))
            x = pen.write(key_text(name), x + LEAD_EM * em, line, em) + TRAIL_EM * em
        line += LINE_EM * em
