"""Room on the canvas for a chart's title and legend."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.charts import ChartOptions
from packwork.scene.container import Container, on_canvas
from packwork.units import CanvasSize
from packwork.uses.charts.colours import ChartColours
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

DENSEST = 0.88
"""Share of a container that marks cover at most, as far as room for their keys goes: smaller may
leave out the largest key, larger leaves more paper under keys. Chosen."""

LEAD_EM, TRAIL_EM = 1.5, 1.6
"""From a key's left end to its name, and from there to the next key. Chosen by eye."""

LONGEST_NAME = 40
"""Letters of a category's name that are shown. Chosen."""


@dataclass(frozen=True)
class LegendFrame:
    """Places about what is drawn, canvas units: of the title, of the legend, and its em."""

    left: float
    width: float
    top: float
    below: float
    em: float


def framed(
    container: Container, chart: ChartRead, colours: ChartColours, size: CanvasSize | None
) -> tuple[Container, LegendFrame, FloatArray]:
    """Container with room above and below it, on a canvas of the size asked for.

    Beside it the room, and a 2 x 3 map from the units that the container had before.
    """
    em = EM_SHARE * container.width
    above, below, margin = (ems * em for ems in frame_ems(chart, colours, container))
    into = affine.similarity(margin, above, 0.0, 1.0)
    moved = replace(
        container,
        outline=container.outline.mapped(into),
        width=container.width + 2 * margin,
        height=container.height + above + below,
    )
    asked = size or CanvasSize(container.side, None, container.unit)
    placed = on_canvas(moved, asked)
    scale = placed.outline.extent / moved.outline.extent
    left = (placed.width - container.width * scale) / 2
    top = (placed.height - moved.height * scale) / 2
    bottom = top + (above + container.height) * scale
    frame = LegendFrame(left, container.width * scale, top, bottom, em * scale)
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
    ems = 0.0
    if has_sizes(options):
        room = KEY_ROOM_EM if container is None else _key_room_ems(chart, container)
        ems += room + ABOUT_KEYS_EM if options.unit is None else UNIT_EM
    if chart.is_ramp:
        ems += RAMP_EM
    ems += LINE_EM * len(in_lines(key_names(chart, colours), 1 / EM_SHARE))
    return ems + MARGIN_EM if ems else 0.0


def _key_room_ems(chart: ChartRead, container: Container) -> float:
    """Height of the largest key to sizes at most: no mark comes out larger."""
    groups = max(len(chart.groups), 1)
    room = DENSEST * container.outline.area / groups
    fullest = float(np.bincount(chart.group_of, weights=chart.areas).max())
    k = int(np.argmax(chart.areas))
    outline = chart.items[k].outline
    scale = np.sqrt(float(chart.areas[k]) / fullest * room / outline.area)
    height = float(scale) * (outline.bounds[3] - outline.bounds[1])
    return min(KEY_ROOM_EM, max(height / (EM_SHARE * container.width), 1.0))


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
