"""Room on the canvas for a chart's title and legend."""

from __future__ import annotations

from dataclasses import dataclass, replace

from packwork.geometry import affine
from packwork.readers.charts.chart import ChartRead
from packwork.readers.charts.options import ChartOptions
from packwork.scene.canvas import on_canvas
from packwork.scene.container import Container
from packwork.units import CanvasSize

EM_SHARE = 0.03
"""Height of an em over the container's canvas' width. Smaller cannot be read in a picture of
a few hundred px. Chosen by eye."""

TITLE_EM = 3.4
SIZES_EM = 8.0
LINE_EM = 2.0
RAMP_EM = 4.4
MARGIN_EM = 1.2
"""Heights of the title, the size key, a line of categories, a ramp; free edges. By eye."""


@dataclass(frozen=True)
class Frame:
    """Where what goes, canvas units.

    Parameters
    ----------
    left, width
        Of all that is drawn.
    top
        Of the title.
    below
        Top of the legend.
    em
        Size of its letters.
    """

    left: float
    width: float
    top: float
    below: float
    em: float


def framed(
    container: Container, options: ChartOptions, chart: ChartRead, size: CanvasSize | None
) -> tuple[Container, Frame]:
    """Container with room above and below it, on a canvas of the size asked for."""
    em = EM_SHARE * container.width
    above = (TITLE_EM if options.title else 0.0) * em
    below = legend_ems(options, chart) * em
    margin = MARGIN_EM * em if above or below else 0.0
    moved = replace(
        container,
        outline=container.outline.mapped(affine.similarity(margin, above, 0.0, 1.0)),
        width=container.width + 2 * margin,
        height=container.height + above + below,
    )
    asked = size or CanvasSize(container.side, None, container.unit)
    placed = on_canvas(moved, asked)
    scale = placed.outline.extent / moved.outline.extent
    left = (placed.width - container.width * scale) / 2
    top = (placed.height - moved.height * scale) / 2
    bottom = top + (above + container.height) * scale
    return placed, Frame(left, container.width * scale, top, bottom, em * scale)


def legend_ems(options: ChartOptions, chart: ChartRead) -> float:
    """Height of the legend, in ems; 0 for none."""
    if not options.legend:
        return 0.0
    ems = SIZES_EM if has_sizes(options) else 0.0
    if chart.is_ramp:
        ems += RAMP_EM
    names = [name for names in (chart.colour_of, tuple(chart.marks)) if names for name in names]
    columns = (options.color_by, options.mark_by)
    if not chart.is_ramp and any(columns):
        letters = sum(len(name) + 5 for name in dict.fromkeys(names))
        # Half an em a letter; a line more than that takes, as lines are not full.
        ems += LINE_EM * (2 + letters * 0.62 * EM_SHARE)
    return ems + MARGIN_EM if ems else 0.0


def has_sizes(options: ChartOptions) -> bool:
    """Whether there is a size to tell."""
    return options.size_by is not None or options.unit is not None
