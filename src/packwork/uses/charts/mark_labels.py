"""Labels on the marks of a chart, where they can be read."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import Region, prepared
from packwork.phrasing import number_of
from packwork.readers.tables.cells import MISSING
from packwork.scene.contrast import contrast
from packwork.scene.item import Item
from packwork.scene.layout import Layout, Note
from packwork.scene.recolour import one_colour
from packwork.uses.charts.layout import Chart
from packwork.uses.charts.pen import Pen, lettering

_LOG = logging.getLogger("packwork")

SMALLEST_SHARE = 0.015
"""Height of an em over the canvas' longer side at least: 9 px of 600. Smaller cannot be read
without a glass. Chosen."""

LARGEST_EM = 1.1
"""Height of an em over that of the legend at most. Larger outshouts the title. Chosen by eye."""

LINE_EM = 1.1
"""From line to line. Chosen by eye."""

MOST_LINES = 3
"""Lines of a label at most. Chosen."""

MOST_LETTERS = 20 * MOST_LINES
"""Letters of a label that is tried; longer ones fit on no mark."""

SPACE_EM = 0.25
"""Between words, where lines are broken. Chosen."""

FREE_EM = 0.3
"""Room about a label. Chosen by eye."""

TRIED = 9
"""Heights that are tried from the largest to the smallest, and places of a label each way. Fewer
waste room. Chosen."""

LEAST_CONTRAST = 4.5
"""Of letters and their mark, as WCAG 2.2 asks for, 1.4.3, level AA."""

INKS = ("#ffffff", "#1a202c", "#000000")
"""Colours of letters, the first that can be read is taken: black or white can be on any."""


_JOINED = (
    "; each row leaves a part of a mark over: without --label-by, rows of one group and colour "
    "have one part in all"
)


@dataclass(frozen=True)
class _Block:
    """A label in lines, of one em; its box about the middle of it."""

    lines: tuple[str, ...]
    width: float
    top: float
    bottom: float


def mark_labels(chart: Chart, layout: Layout) -> tuple[Note, ...]:
    """Labels that fit on their marks; how many do not is told.

    One for each row: of several marks of one row the largest on which it fits has it, but all of
    them where nothing else tells them from those of other rows.
    """
    options = chart.options
    if options.label_by is None:
        return ()
    others = (options.color_by, options.mark_by, options.by)
    has_many = options.unit is not None and options.label_by not in others
    ems = np.geomspace(LARGEST_EM * chart.frame.em, SMALLEST_SHARE * layout.container.side, TRIED)
    notes: list[Note] = []
    rows: dict[int, bool] = {}
    for k in np.argsort(-layout.areas, kind="stable"):
        item = layout.items[k]
        if item.datum is None or item.label.name in ("", MISSING):
            continue
        row = int(chart.read.row_of[k])
        if has_many or not rows.get(row):
            drawn = _label(item, layout.inks[k], ems)
            notes += drawn
            rows[row] = rows.get(row, False) or bool(drawn)
    fitting = sum(rows.values())
    if fitting < len(rows):
        _LOG.warning(
            "%d of %s on their marks; in SVG and HTML, %s shown where a pointer rests%s",
            fitting, number_of(len(rows), "label fits", "labels fit"),
            "the others are" if fitting else "all are",
            _JOINED if has_many and options.by is not None and not fitting else "",
        )  # fmt: skip
    return tuple(notes)


def _label(item: Item, ink: Outline, ems: FloatArray) -> list[Note]:
    left, top, right, bottom = ink.bounds
    least = float(ems[-1])
    if right - left < least or bottom - top < least:
        return []
    colour = _ink_on(item)
    if colour is None:
        return []
    blocks = [block for block in _blocks(item.label.name) if block.width * least < right - left]
    region = prepared(ink.region)
    for em in ems.tolist() if blocks else []:
        for block in blocks:
            middle = _place(block, em, ink, region)
            if middle is not None:
                return _drawn(block, em, middle, colour)
    return []


def _ink_on(item: Item) -> str | None:
    """Colour of letters that can be read on an item; None if it is of several colours."""
    channels = one_colour(item.art)
    if channels is None or channels[3] < 255:
        return None
    ground = "#{:02x}{:02x}{:02x}".format(*channels[:3])
    return next((ink for ink in INKS if contrast(ink, ground) >= LEAST_CONTRAST), None)


def _blocks(text: str) -> list[_Block]:
    """A text on one line, and broken into two and three lines as even as they go."""
    words = text.split()
    if len(text) > MOST_LETTERS:
        return []
    most = min(MOST_LINES, len(words))
    return [_block(_broken(words, count)) for count in range(1, most + 1)]


def _broken(words: Sequence[str], count: int) -> tuple[str, ...]:
    """Words in so many lines, the longest as short as goes.

    Examples
    --------
    >>> _broken(["Papua", "New", "Guinea"], 2)
    ('Papua New', 'Guinea')
    """
    ends = np.cumsum([0.0, *(Pen.width(word, 1.0) + SPACE_EM for word in words)])

    def longest(cuts: tuple[int, ...]) -> float:
        return float(np.diff(ends[[0, *cuts, len(words)]]).max())

    best = min(combinations(range(1, len(words)), count - 1), key=longest)
    return tuple(" ".join(words[a:b]) for a, b in pairwise([0, *best, len(words)]))


def _block(lines: tuple[str, ...]) -> _Block:
    bounds = [lettering(line).region.bounds for line in lines]
    width = max(right - left for left, _, right, _ in bounds)
    last = LINE_EM * (len(lines) - 1)
    return _Block(lines, float(width), float(bounds[0][1]), float(bounds[-1][3]) + last)


def _place(block: _Block, em: float, ink: Outline, region: Region) -> FloatArray | None:
    """Middle ``(2,)`` of a block on an ink, as near to the ink's own as goes; None for nowhere."""
    wide = (block.width / 2 + FREE_EM) * em
    high = ((block.bottom - block.top) / 2 + FREE_EM) * em
    left, top, right, bottom = ink.bounds
    if 2 * wide > right - left or 2 * high > bottom - top:
        return None
    x, y = np.meshgrid(
        np.linspace(left + wide, right - wide, TRIED),
        np.linspace(top + high, bottom - high, TRIED),
    )
    points = np.vstack([ink.centroid, np.column_stack([x.ravel(), y.ravel()])])
    boxes = shapely.box(
        points[:, 0] - wide, points[:, 1] - high, points[:, 0] + wide, points[:, 1] + high
    )
    fitting = points[shapely.contains(region, boxes)]
    if len(fitting) == 0:
        return None
    away = np.hypot(*(fitting - ink.centroid).T)
    return np.asarray(fitting[np.argmin(away)])


def _drawn(block: _Block, em: float, middle: FloatArray, colour: str) -> list[Note]:
    pen = Pen(colour)
    line = float(middle[1]) - (block.top + block.bottom) / 2 * em
    for number, text in enumerate(block.lines):
        pen.write_about(text, float(middle[0]), line + number * LINE_EM * em, em)
    return [replace(note, is_on_item=True) for note in pen.notes]
