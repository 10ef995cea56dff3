"""Title and keys of a chart: what sizes, colours and forms of marks mean."""

from __future__ import annotations

import math

import numpy as np

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.pipeline.chart_colours import UNKNOWN, ChartColours, chart_colours
from packwork.pipeline.framing import LINE_EM, RAMP_EM, SIZES_EM, TITLE_EM, Frame, has_sizes
from packwork.pipeline.job import Job
from packwork.readers.typeface.fonts import Fonts, open_fonts
from packwork.scene.contrast import between, readable
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.note import Note
from packwork.writers.notation import path_data

INK = "#2d3748"
LEAST_CONTRAST = 4.5
"""Of letters and what is behind them, as WCAG asks for."""

DIGITS = 6
STRIPES = 48
"""Rectangles that a ramp is drawn with. Fewer show. Chosen by eye."""

KEYS = 3
"""Sizes that the size key shows."""

SMALLEST_KEY_EM = 0.2
"""Height of the smallest of them. Chosen by eye."""


class _Pen:
    """Collects notes; places are canvas units, letters stand on their line."""

    def __init__(self, fonts: Fonts, ink: str) -> None:
        self.fonts, self.ink = fonts, ink
        self.notes: list[Note] = []

    def width(self, text: str, em: float) -> float:
        left, _, right, _ = self.fonts.lettering([text]).region.bounds
        return float(right - left) * em

    def write(self, text: str, x: float, y: float, em: float) -> float:
        """Letters from ``x`` on; where they end."""
        drawn = self.fonts.lettering([text])
        left, _, right, _ = drawn.region.bounds
        place = affine.similarity(x - float(left) * em, y, 0.0, em / drawn.units)
        self.notes.append(Note(drawn.path, place, self.ink, text))
        return x + float(right - left) * em

    def shape(self, outline: Outline, x: float, y: float, scale: float, fill: str) -> None:
        place = affine.similarity(x, y, 0.0, scale)
        self.notes.append(Note(path_data(outline, DIGITS), place, fill))


def legend_notes(job: Job, layout: Layout) -> tuple[Note, ...]:
    """Title and legend of a chart; nothing for other layouts."""
    chart, frame = job.chart, job.frame
    options = job.recipe.chart
    if chart is None or frame is None or options is None:
        return ()
    pen = _Pen(open_fonts([], 500), readable(INK, options.paper, LEAST_CONTRAST))
    if options.title:
        em = min(1.5 * frame.em, frame.width / max(pen.width(options.title, 1.0), 1.0))
        pen.write(options.title, frame.left, frame.top + 0.7 * TITLE_EM * frame.em, em)
    if not options.legend:
        return tuple(pen.notes)
    colours = chart_colours(job.recipe, chart)
    y = frame.below
    if has_sizes(options):
        _sizes(pen, job, layout, frame, y)
        y += SIZES_EM * frame.em
    if colours.ramp and options.color_by:
        _ramp(pen, colours, options.color_by, frame, y)
        y += RAMP_EM * frame.em
    _categories(pen, job, colours, frame, y)
    return tuple(pen.notes)


def _sizes(pen: _Pen, job: Job, layout: Layout, frame: Frame, y: float) -> None:
    """Marks of round numbers, at the chart's own scale."""
    chart, options, em = job.chart, job.recipe.chart, frame.em
    assert chart is not None and options is not None  # noqa: S101, PT018 - who asks has a chart
    mark = next(iter(chart.marks.values())).outline
    numbers = [options.unit] if options.unit else _round_numbers(float(chart.values.max()))
    heading = options.size_by or "rows"
    room = (SIZES_EM - 3.4) * em
    shown = [(number, _scale(job, layout, mark, number)) for number in numbers]
    heights = [(mark.bounds[3] - mark.bounds[1]) * scale for _, scale in shown]
    fitting = [
        key
        for key, height in zip(shown, heights, strict=True)
        if options.unit is not None or SMALLEST_KEY_EM * em <= height <= room
    ][:KEYS]
    low = y + (SIZES_EM - 1.2) * em
    tallest = max((mark.bounds[3] - mark.bounds[1]) * scale for _, scale in fitting or shown[:1])
    pen.write(heading, frame.left, low - max(tallest, em) - 0.8 * em, em)
    x = frame.left
    for number, scale in fitting:
        left, _, right, bottom = (v * scale for v in mark.bounds)
        pen.shape(mark, x - left, low - bottom, scale, UNKNOWN)
        x = pen.write(_spoken(number), x + right - left + 0.4 * em, low, 0.85 * em) + 1.6 * em


def _scale(job: Job, layout: Layout, mark: Outline, number: float) -> float:
    """Canvas units per unit of a mark that stands for a number."""
    chart, options = job.chart, job.recipe.chart
    assert chart is not None and options is not None  # noqa: S101, PT018 - who asks has a chart
    k = int(np.argmax(chart.values))
    share = number / float(chart.values[k])
    own = layout.items[k].outline
    if options.size_is == "area" or options.unit is not None:
        return float(np.sqrt(share * layout.areas[k] / mark.area))
    side = 1 if options.size_is == "height" else 0
    lengths = [o.bounds[2 + side] - o.bounds[side] for o in (own, mark)]
    return share * float(layout.poses.scale[k]) * lengths[0] / lengths[1]


def _round_numbers(largest: float) -> list[float]:
    """1, 2 or 5 times a power of ten, every second of them, from the largest down."""
    power = math.floor(math.log10(largest))
    steps = [s * 10.0**p for p in range(power, power - 8, -1) for s in (5.0, 1.0)]
    return [step for step in steps if step <= largest]


def _spoken(number: float) -> str:
    """Number as people say it.

    Examples
    --------
    >>> _spoken(5e8), _spoken(2000), _spoken(0.5)
    ('500 million', '2,000', '0.5')
    """
    for name, size in (("billion", 1e9), ("million", 1e6)):
        if abs(number) >= size:
            return f"{number / size:,.4g} {name}"
    # Numbers of four digits may be years.
    return f"{number:,.6g}" if abs(number) >= 1e3 else f"{number:.4g}"


def _ramp(pen: _Pen, colours: ChartColours, column: str, frame: Frame, y: float) -> None:
    em, low, high = frame.em, *colours.ends
    pen.write(column, frame.left, y + 1.2 * em, em)
    step = min(frame.width, 16 * em) / STRIPES
    corners = [[0.0, 0.0], [step, 0.0], [step, 0.8 * em], [0.0, 0.8 * em]]
    tile = Outline.from_rings([np.array(corners)])
    for k in range(STRIPES):
        fill = between(colours.ramp, k / (STRIPES - 1))
        pen.shape(tile, frame.left + k * step, y + 1.8 * em, 1.0, fill)
    texts = [f"{value:.12g}" if abs(value) < 1e4 else _spoken(value) for value in (low, high)]
    pen.write(texts[0], frame.left, y + 3.6 * em, 0.85 * em)
    right = frame.left + STRIPES * step - pen.width(texts[1], 0.85 * em)
    pen.write(texts[1], right, y + 3.6 * em, 0.85 * em)


def _categories(pen: _Pen, job: Job, colours: ChartColours, frame: Frame, y: float) -> None:
    """Names beside marks in their colours, line by line."""
    assert job.chart is not None and job.recipe.chart is not None  # noqa: S101, PT018 - as above
    marks, em = job.chart.marks, frame.em
    first = next(iter(marks.values()))
    entries: dict[str, tuple[Item, str]] = {
        name: (marks.get(name, first), colour) for name, colour in colours.keys
    }
    if job.recipe.chart.mark_by is not None:
        entries |= {name: (mark, UNKNOWN) for name, mark in marks.items() if name not in entries}
    x, line = frame.left, y + 1.2 * em
    for name, (mark, fill) in entries.items():
        text = name if len(name) <= 40 else f"{name[:39]}…"
        if x > frame.left and x + 1.5 * em + pen.width(text, em) > frame.left + frame.width:
            x, line = frame.left, line + LINE_EM * em
        scale = 1.1 * em / mark.outline.extent
        left, top, _, bottom = mark.ink.bounds
        pen.shape(
            mark.ink, x - left * scale, line - 0.35 * em - (top + bottom) / 2 * scale, scale, fill
        )
        x = pen.write(text, x + 1.5 * em, line, em) + 1.6 * em
