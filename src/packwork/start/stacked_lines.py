"""Few words in lines, stacked in a container: the lines, their order and the sizes that cover most.

Dynamic programming over the words that are left and the height at which the next line begins (the
scheme of M. Held and R. M. Karp, "A dynamic programming approach to sequencing problems", Journal
of the Society for Industrial and Applied Mathematics 10 (1962), 196-210). A line is as large as the
container is wide all along its height, and may be parted where that is, as by a heart's notch.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import intersection

ROWS = 100
"""Heights at which lines may begin. More take longer, fewer waste room. Chosen."""

ABREAST = 3
"""Words in a line at most. More take longer, and read as running text. By eye."""

UNEVEN = 2.5
"""Scale of the largest line over that of the smallest, at most. Larger covers more, and has words
that are overlooked. By eye."""

SHRINKS, SMALLER = 12, 0.97
"""Times that a line is made smaller which an edge between two rows cuts, and how much. Chosen."""

CAPS = 12
"""Bounds on the largest that are tried, each smaller by a sixth. Chosen."""


@dataclass(frozen=True, eq=False)
class _Bands:
    """Free stretches of bands of rows, ``(ROWS, ROWS + 1)`` by their first row and their end.

    One from ``low`` to ``high``; where there are two, ``left`` is the end of the first and
    ``right`` where the second begins, else ``left`` is not less than ``right``.
    """

    low: FloatArray
    left: FloatArray
    right: FloatArray
    high: FloatArray
    height: FloatArray

    @classmethod
    def of(cls, room: Outline) -> _Bands:
        """Bands of a room between rows at equal distances."""
        _, top, _, bottom = room.bounds
        low, left, right, high = _chords(room).T
        pitch, shape = (bottom - top) / ROWS, (ROWS, ROWS + 1)
        found = np.zeros((5, *shape))
        for row in range(ROWS):
            for k, (ends, joined) in enumerate(
                ((low, np.maximum), (left, np.minimum), (right, np.maximum), (high, np.minimum))
            ):
                found[k, row, row:] = joined.accumulate(ends[row:])
            found[4, row, row:] = pitch * np.arange(ROWS + 1 - row)
        return cls(*found)

    def stretches(self, count: int) -> list[tuple[FloatArray, FloatArray]]:
        """Ends of the widest stretch of each band, or of both of those that are parted."""
        is_parted = self.left < self.right
        if count == 2:
            left = np.where(is_parted, self.left, self.low)
            return [(self.low, left), (np.where(is_parted, self.right, self.high), self.high)]
        is_second = is_parted & (self.high - self.right > self.left - self.low)
        low = np.where(is_second, self.right, self.low)
        return [(low, np.where(is_parted & ~is_second, self.left, self.high))]


@dataclass(frozen=True, eq=False)
class _Line:
    """Words side by side, as boxes about them: one, or one in each stretch of a parted band.

    ``parts``: words of each box; ``widths``, ``height``, ``above``: of the boxes at a scale of 1,
    and from their top to the base line; ``area``: of the words; ``mask``: the words as bits.
    """

    parts: tuple[tuple[int, ...], ...]
    widths: tuple[float, ...]
    height: float
    above: float
    area: float
    mask: int

    @classmethod
    def of(cls, boxes: FloatArray, parts: Sequence[tuple[int, ...]], beside: float) -> _Line:
        """Line of these words."""
        words = [k for part in parts for k in part]
        sides = boxes[:, 2:] - boxes[:, :2]
        above = -float(boxes[words, 1].min())
        widths = [sides[list(part), 0].sum() + beside * (len(part) - 1) for part in parts]
        return cls(
            tuple(parts), tuple(map(float, widths)), above + float(boxes[words, 3].max()), above,
            float(sides[words].prod(axis=1).sum()), sum(1 << k for k in words),
        )  # fmt: skip

    def scales(self, bands: _Bands) -> FloatArray:
        """``(ROWS,)`` largest scale at which the line may begin at each row; 0 for none."""
        scale = bands.height / self.height
        for (low, high), width in zip(bands.stretches(len(self.parts)), self.widths, strict=True):
            scale = np.minimum(scale, (high - low) / width)
        return np.asarray(np.maximum(scale, 0.0).max(axis=1))


def stacked_lines(
    room: Outline, boxes: FloatArray, between: float, beside: float = 0.0
) -> tuple[FloatArray, FloatArray] | None:
    """Scales ``(n,)`` and shifts ``(n, 2)`` of words in lines; None if they do not fit.

    Parameters
    ----------
    room
        What they have to lie in.
    boxes
        ``(n, 4)`` left, top, right and bottom of each at a scale of 1, its base line at y = 0; time
        doubles with each.
    between
        Room between two lines at least.
    beside
        Room between two words of a line, at a scale of 1.

    Examples
    --------
    >>> boxes = np.array([[-2.0, -1, 2, 0], [-1, -1, 1, 0]])
    >>> scale, shifts = stacked_lines(Outline.box(0, 0, 8, 6), boxes, 0.0)
    >>> scale.round(1).tolist(), shifts[:, 0].tolist()
    ([2.0, 4.0], [4.0, 4.0])
    """
    _, top, _, bottom = room.bounds
    pitch, bands, lines = (bottom - top) / ROWS, _Bands.of(room), _lines_of(boxes, beside)
    most = np.array([line.scales(bands) for line in lines])
    cap, best = float(most.max()), (0.0, list[tuple[int, int, float]]())
    for _ in range(CAPS):
        scales = np.where(most * UNEVEN >= cap, np.minimum(most, cap), 0.0)
        area, found = _fullest(lines, scales, pitch, int(np.ceil(between / pitch)))
        if 0 < area < best[0]:
            # Smaller lines cover ever less.
            break
        best = max(best, (area, found), key=lambda one: one[0])
        cap *= 5 / 6
    if not best[1]:
        return None
    placed = [
        (lines[k], part, row, scale, (low[row, end] + high[row, end]) / 2)
        for k, row, scale in best[1]
        for end in [row + int(_rows(scale * lines[k].height, pitch))]
        for part, (low, high) in enumerate(bands.stretches(len(lines[k].parts)))
    ]
    sizes = np.array([(line.widths[part], line.height) for line, part, *_ in placed])
    rows, scale, x = np.array([one[2:] for one in placed]).T
    middles = np.column_stack([x, top + rows * pitch + scale * sizes[:, 1] / 2])
    inside = _inside(room, scale, sizes, _spread(room, scale[:, None] * sizes, middles, rows))
    if inside is None:
        return None
    found_scale, shifts = np.empty(len(boxes)), np.empty((len(boxes), 2))
    for (line, part, *_), own, middle, size in zip(placed, *inside, sizes, strict=True):
        x, y = middle - own * size / 2
        for k in line.parts[part]:
            found_scale[k], shifts[k] = own, (x - own * boxes[k, 0], y + own * line.above)
            x += own * (boxes[k, 2] - boxes[k, 0] + beside)
    return found_scale, shifts


def _lines_of(boxes: FloatArray, beside: float) -> list[_Line]:
    """Lines that words can make: each group of few, in one stretch and in two."""
    sizes = range(1, ABREAST + 1)
    groups = [one for size in sizes for one in combinations(range(len(boxes)), size)]
    parts = [(one[:k], one[k:])[not k :] for one in groups for k in range(len(one))]
    return [_Line.of(boxes, one, beside) for one in parts]


def _rows(height: Any, pitch: float) -> Any:
    """Rows that so many units take."""
    return np.ceil(height / pitch - 1e-9).astype(int)


def _inside(
    room: Outline, scale: FloatArray, sizes: FloatArray, middles: FloatArray
) -> tuple[FloatArray, FloatArray] | None:
    """The same lines, those smaller that an edge between two rows cuts; None if that cuts deep."""
    for _ in range(SHRINKS):
        is_inside = shapely.covers(room.region, _boxes(scale[:, None] * sizes, middles))
        if is_inside.all():
            return scale, middles
        scale = np.where(is_inside, scale, SMALLER * scale)
    return None


def _boxes(sizes: FloatArray, middles: FloatArray) -> Any:
    """Boxes of so many sizes about their middles, less what rounding adds."""
    (x, y), (half_width, half_height) = middles.T, sizes.T / 2 * (1 - 1e-9)
    return shapely.box(x - half_width, y - half_height, x + half_width, y + half_height)


def _spread(room: Outline, sizes: FloatArray, middles: FloatArray, rows: FloatArray) -> FloatArray:
    """The same lines as far apart as there is room above and below, or as far as they stay inside.

    Elsewhere a stack would stand on the ground of its container, or hang from its top.
    """
    _, top, _, bottom = room.bounds
    # Boxes of one row are of one line.
    number = np.unique(rows, return_inverse=True)[1]
    above = float((middles - sizes / 2)[:, 1].min()) - top
    free = above + bottom - float((middles + sizes / 2)[:, 1].max())
    for share in (1.0, 0.75, 0.5, 0.25, 0.0):
        # Centred, and apart by that share of what is free.
        apart = share * free / (number.max() + 2)
        shifts = (free - apart * number.max()) / 2 - above + apart * number
        moved = middles + shifts[:, None] * [0.0, 1.0]
        if shapely.covers(room.region, _boxes(sizes, moved)).all():
            return np.asarray(moved)
    return middles


def _chords(room: Outline) -> FloatArray:
    """``(ROWS + 1, 4)`` ends of the two widest stretches of the room at each height, left first.

    Of a single one its ends, and between them an end that lies beyond the beginning.
    """
    left, top, right, bottom = room.bounds
    heights = np.linspace(top, bottom, ROWS + 1)
    inside = np.clip(heights, top + 1e-9 * (bottom - top), bottom - 1e-9 * (bottom - top))
    across = shapely.linestrings([[(left - 1, y), (right + 1, y)] for y in inside])
    ends = []
    for found in intersection(np.full(len(across), room.region), across):
        parts = shapely.get_parts(found)
        widest = shapely.bounds(parts[np.argsort(-shapely.length(parts), kind="stable")[:2]])
        low, high = np.sort(widest[:, 0]), np.sort(widest[:, 2])
        if len(parts) == 0:
            ends.append([left, np.inf, -np.inf, left])
        elif len(parts) == 1:
            ends.append([low[0], np.inf, -np.inf, high[0]])
        else:
            ends.append([low[0], high[0], low[1], high[1]])
    return np.array(ends)


def _fullest(
    lines: list[_Line], scales: FloatArray, pitch: float, gap: int
) -> tuple[float, list[tuple[int, int, float]]]:
    """Area of all words in the best lines, and these from the top; no lines if none fit.

    Parameters
    ----------
    scales
        ``(lines, ROWS)`` scale of a line that begins at a row; 0 for one that may not.

    Returns
    -------
    Area, and of each line its index, row and scale.
    """
    masks: IntArray = np.array([line.mask for line in lines])
    heights, areas = np.array([(line.height, line.area) for line in lines]).T[:, :, None]
    gain = np.where(scales > 0, areas * scales**2, -np.inf)
    after = np.minimum(np.arange(ROWS) + _rows(scales * heights, pitch) + gap, ROWS)
    # Of each set of words, the most that it covers from each row on, where its first line begins.
    best = np.full((1 << int(masks.max()).bit_length(), ROWS + 1), -np.inf)
    best[0] = 0.0

    there = np.flatnonzero(scales.any(axis=1))

    def totals(left: int) -> tuple[IntArray, FloatArray]:
        own = there[masks[there] & left == masks[there]]
        return own, gain[own] + best[(left ^ masks[own])[:, None], after[own]]

    for left in range(1, len(best)):
        best[left, :ROWS] = totals(left)[1].max(axis=0, initial=-np.inf)
    left, row = len(best) - 1, int(best[-1].argmax())
    total, found = float(best[-1, row]), list[tuple[int, int, float]]()
    while left and np.isfinite(total):
        own, covered = totals(left)
        k = int(own[covered[:, row].argmax()])
        found.append((k, row, float(scales[k, row])))
        left, row = left ^ int(masks[k]), int(after[k, row])
    return max(total, 0.0), found
