"""Room on the canvas for a chart's title and legend."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.readers.charts import ChartOptions
from packwork.scene.container import Container, on_canvas
from packwork.units import CanvasSize
from packwork.uses.charts.colours import ChartColours
from packwork.uses.charts.groups import ROUNDING
from packwork.uses.charts.marks import ChartRead
from packwork.uses.charts.pen import Pen

EM_SHARE = 0.03
"""Height of an em over the container's canvas' width. Smaller cannot be read in a picture of
a few hundred px. Chosen by eye."""

TITLE_EM = 3.0
KEY_ROOM_EM = 4.2
ABOUT_KEYS_EM = 2.9
UNIT_EM = 2.4
LINE_EM = 2.0
RAMP_EM = 4.6
MARGIN_EM = 1.2
"""Heights of the title, of the largest key to sizes at most and what is about it, of the key to a
unit, a line of categories, a ramp; free edges. By eye."""

KEYS = 3
"""Sizes that the size key shows."""

SMALLEST_KEY_EM = 0.2
"""Height of the smallest of them. Chosen by eye."""

DENSEST = 0.88
"""Share of a container that marks cover at most, as far as keys to them go: smaller lets keys out
of their room, larger leaves more paper under keys and out the largest. Chosen."""

AIR_EM = 0.6
"""Paper of a container's own that is kept over and under it, at most. Chosen by eye."""

LEAD_EM, TRAIL_EM = 1.5, 1.6
"""From a key's left end to its name, and from there to the next key. Chosen by eye."""

LONGEST_NAME = 40
"""Letters of a category's name that are shown. Chosen."""


@dataclass(frozen=True)
class LegendFrame:
    """Places about what is drawn, canvas units: of the title, of the legend, and its em.

    ``keys`` are the numbers that have keys to sizes, all keys to sizes being so high.
    """

    left: float
    width: float
    top: float
    below: float
    em: float
    keys: tuple[float, ...]
    keys_height: float


def framed(
    container: Container, chart: ChartRead, colours: ChartColours, size: CanvasSize | None
) -> tuple[Container, LegendFrame, FloatArray]:
    """Container with room above and below it, on a canvas of the size asked for.

    Beside it the room, and a 2 x 3 map from the units that the container had before.
    """
    em = EM_SHARE * container.width
    above, below, margin = (ems * em for ems in frame_ems(chart, colours, container))
    first, height = 0.0, container.height
    if above + below and not chart.groups:
        # More paper of its own over and under a container would part it from title and legend.
        first = max(container.outline.bounds[1] - AIR_EM * em, 0.0)
        height = min(container.outline.bounds[3] + AIR_EM * em, height) - first
    into = affine.similarity(margin, above - first, 0.0, 1.0)
    moved = replace(
        container,
        outline=container.outline.mapped(into),
        width=container.width + 2 * margin,
        height=height + above + below,
    )
    asked = size or CanvasSize(container.side, None, container.unit)
    placed = on_canvas(moved, asked)
    scale = placed.outline.extent / moved.outline.extent
    left = (placed.width - container.width * scale) / 2
    top = (placed.height - moved.height * scale) / 2
    bottom = top + (above + height) * scale
    keys, ems = size_keys(chart, container) if chart.options.legend else ((), 0.0)
    width = container.width * scale
    frame = LegendFrame(left, width, top, bottom, em * scale, keys, ems * em * scale)
    onto = affine.similarity((placed.width - moved.width * scale) / 2, top, 0.0, scale)
    return placed, frame, affine.compose(onto, into)


def frame_ems(
    chart: ChartRead, colours: ChartColours, container: Container | None = None
) -> tuple[float, float, float]:
    """Room above and below a container and free edges, in ems; an em is ``EM_SHARE`` of it.

    Where the container is not known yet, as much as may be needed.
    """
    above = TITLE_EM if chart.options.title else 0.0
    below = legend_ems(chart, colours, container)
    if not (above or below or chart.groups):
        return 0.0, 0.0, 0.0
    return above, max(below, MARGIN_EM), MARGIN_EM


def legend_ems(chart: ChartRead, colours: ChartColours, container: Container | None) -> float:
    """Height of the legend, in ems; 0 for none."""
    options = chart.options
    if not options.legend:
        return 0.0
    _, ems = size_keys(chart, container)
    if chart.is_ramp:
        ems += RAMP_EM
    ems += LINE_EM * len(in_lines(key_names(chart, colours), 1 / EM_SHARE))
    return ems + MARGIN_EM if ems else 0.0


def size_keys(chart: ChartRead, container: Container | None) -> tuple[tuple[float, ...], float]:
    """Numbers that have keys to sizes, and the height of all in ems at most; 0 for none.

    Marks come out no larger than where they cover as much as they can; keys to some are larger
    than keys may be, or specks.
    """
    options = chart.options
    if not has_sizes(options):
        return (), 0.0
    if container is None:
        return (), KEY_ROOM_EM + ABOUT_KEYS_EM
    room = DENSEST * container.outline.area / max(len(chart.groups), 1)
    fullest = float(np.bincount(chart.group_of, weights=chart.areas).max())
    k = int(np.argmax(chart.values))
    own, mark = chart.items[k].outline, next(iter(chart.marks.values())).outline
    largest = math.sqrt(float(chart.areas[k]) / fullest * room / own.area)
    ems = (mark.bounds[3] - mark.bounds[1]) / (EM_SHARE * container.width)
    if options.unit is not None:
        height = ems * key_scale(options, mark, options.unit / float(chart.values[k]), own, largest)
        return (), UNIT_EM + (height - 1.0 if 1.0 < height <= KEY_ROOM_EM else 0.0)
    heights = {
        number: ems * key_scale(options, mark, number / float(chart.values[k]), own, largest)
        for number in round_numbers(*chart.ends)
    }
    fitting = [n for n, height in heights.items() if SMALLEST_KEY_EM <= height <= KEY_ROOM_EM]
    if not fitting:
        return (), LINE_EM
    # Every second of 1, 2, 5, 10 ...: sizes that are told apart at a glance.
    keys = fitting if len(fitting) <= KEYS else fitting[::2][:KEYS]
    return tuple(keys), ABOUT_KEYS_EM + max(heights[keys[0]], 1.0)


def key_scale(
    options: ChartOptions, mark: Outline, share: float, own: Outline, scale: float
) -> float:
    """Scale of a mark that stands for a share of what an item at its scale does."""
    if options.size_is == "area" or options.unit is not None:
        return scale * math.sqrt(share * own.area / mark.area)
    side = 1 if options.size_is == "height" else 0
    lengths = [o.bounds[2 + side] - o.bounds[side] for o in (own, mark)]
    return share * scale * lengths[0] / lengths[1]


def round_numbers(smallest: float, largest: float) -> list[float]:
    """Numbers to show of a range, from the largest down: 1, 2 or 5 times powers of ten.

    Where the range has fewer than two, multiples of the widest such step of which it has two; of
    one number that alone.

    Examples
    --------
    >>> round_numbers(3.0, 30.0), round_numbers(1773.0, 5140.0), round_numbers(61.0, 84.0)
    ([20.0, 10.0, 5.0], [5000.0, 2000.0], [80.0, 70.0])
    """
    power = math.floor(math.log10(largest))
    steps = [s * 10.0**p for p in range(power, power - 8, -1) for s in (5.0, 2.0, 1.0)]
    there = [step for step in steps if smallest <= step <= largest]
    if len(there) > 1:
        return there
    for step in steps:
        least = math.ceil(smallest / step - ROUNDING)
        several = range(math.floor(largest / step + ROUNDING), least - 1, -1)
        if len(several) > 1:
            return [float(f"{k * step:.12g}") for k in several]
    return [largest]


def has_sizes(options: ChartOptions) -> bool:
    """Whether there is a size to tell."""
    return options.size_by is not None or options.unit is not None


def key_names(chart: ChartRead, colours: ChartColours) -> list[str]:
    """Categories that have keys, in their order: those of colours, then those of marks alone."""
    options = chart.options
    names: dict[str, None] = {}
    # Names of groups stand beside them.
    if options.color_by is not None and options.color_by != options.by:
        names |= dict.fromkeys(name for name, _ in colours.keys)
    if options.mark_by is not None and options.mark_by != options.by:
        names |= dict.fromkeys(chart.marks)
    return list(names)


def in_lines(names: Sequence[str], room: float) -> list[list[str]]:
    """Names of keys as they fit side by side into a width in ems, line by line.

    Examples
    --------
    >>> in_lines(["one", "two", "three"], 9.0)
    [['one', 'two'], ['three']]
    """
    lines: list[list[str]] = []
    x = room + 1.0
    for name in names:
        width = LEAD_EM + Pen.width(key_text(name), 1.0)
        if x > 0 and x + width > room:
            lines.append([])
            x = 0.0
        lines[-1].append(name)
        x += width + TRAIL_EM
    return lines


def key_text(name: str) -> str:
    """Name of a category as its key has it."""
    return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"
