"""Lines of one word each, stacked in a container: the order and the sizes that cover most.

Dynamic programming over the words that are left and the height at which the next one begins (the
scheme of M. Held and R. M. Karp, "A dynamic programming approach to sequencing problems", Journal
of the Society for Industrial and Applied Mathematics 10 (1962), 196-210). A line is as large as the
container is wide all along its height.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import intersection

ROWS = 150
"""Heights at which lines may begin. More take longer, fewer waste room. Chosen."""

UNEVEN = 2.5
"""Scale of the largest line over that of the smallest, at most. Larger covers more, and has words
that are overlooked. By eye."""

SHRINKS, SMALLER = 12, 0.97
"""Times that a line is made smaller which an edge between two rows cuts, and how much. Chosen."""

CAPS = 12
"""Bounds on the largest that are tried, each smaller by a sixth. Chosen."""


@dataclass(frozen=True, eq=False)
class _Line:
    """Place of a word that begins at a row: its scale, middle (x), top (y) and rows taken."""

    scale: float
    x: float
    y: float
    rows: int


def stacked_lines(
    room: Outline, sizes: FloatArray, between: float
) -> tuple[FloatArray, FloatArray] | None:
    """Scales ``(n,)`` and middles ``(n, 2)`` of boxes, one under another; None if they do not fit.

    Parameters
    ----------
    room
        What they have to lie in.
    sizes
        ``(n,)`` widths and heights of the boxes at a scale of 1; time doubles with each.
    between
        Room between two lines at least.

    Examples
    --------
    >>> scale, middles = stacked_lines(Outline.box(0, 0, 8, 6), np.array([[4.0, 1], [2, 1]]), 0.0)
    >>> scale.round(1).tolist(), middles[:, 0].tolist()
    ([2.0, 4.0], [4.0, 4.0])
    """
    left, top, right, bottom = room.bounds
    pitch, low, high = (bottom - top) / ROWS, *_chords(room)
    gap = int(np.ceil(between / pitch))
    cap = float((np.array([right - left, bottom - top]) / sizes).min(axis=1).max())
    best: tuple[float, list[tuple[int, _Line]]] = 0.0, []
    for _ in range(CAPS):
        lines = [
            [_largest(low[row:], high[row:], size, pitch, top + row * pitch, cap) for size in sizes]
            for row in range(ROWS)
        ]
        area, found = _fullest(lines, sizes, gap)
        scales = [line.scale for _, line in found]
        if found and max(scales) <= UNEVEN * min(scales):
            best = max(best, (area, found), key=lambda one: one[0])
        cap = 5 / 6 * min(cap, max(scales, default=cap))
    if not best[1]:
        return None
    order = sorted(best[1], key=lambda one: one[0])
    scale = np.array([line.scale for _, line in order])
    middles = [(line.x, line.y + line.scale * sizes[k, 1] / 2) for k, line in order]
    return _inside(room, scale, sizes, _spread(room, scale[:, None] * sizes, np.array(middles)))


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


def _spread(room: Outline, sizes: FloatArray, middles: FloatArray) -> FloatArray:
    """The same lines as far apart as there is room above and below, or as far as they stay inside.

    Elsewhere a stack would stand on the ground of its container, or hang from its top.
    """
    _, top, _, bottom = room.bounds
    order = np.argsort(middles[:, 1])
    ends = middles[order, 1][:, None] + sizes[order, 1][:, None] * [-0.5, 0.5]
    above, free = ends[0, 0] - top, ends[0, 0] - top + bottom - ends[-1, 1]
    for share in (1.0, 0.75, 0.5, 0.25, 0.0):
        # Centred, and apart by that share of what is free.
        apart = share * free / (len(order) + 1)
        shifts = (free - apart * (len(order) - 1)) / 2 - above + apart * np.arange(len(order))
        moved = middles.copy()
        moved[order, 1] += shifts
        if shapely.covers(room.region, _boxes(sizes, moved)).all():
            return moved
    return middles


def _chords(room: Outline) -> tuple[FloatArray, FloatArray]:
    """``(ROWS + 1,)`` ends of the widest stretch of the room at each height, equal for none."""
    left, top, right, bottom = room.bounds
    heights = np.linspace(top, bottom, ROWS + 1)
    inside = np.clip(heights, top + 1e-9 * (bottom - top), bottom - 1e-9 * (bottom - top))
    across = shapely.linestrings([[(left - 1, y), (right + 1, y)] for y in inside])
    ends = []
    for found in intersection(np.full(len(across), room.region), across):
        parts = shapely.get_parts(found)
        widest = parts[np.argmax(shapely.length(parts))] if len(parts) else shapely.Point(left, top)
        ends.append(shapely.bounds(widest)[[0, 2]])
    low, high = np.array(ends).T
    return low, high


def _largest(
    low: FloatArray, high: FloatArray, size: FloatArray, pitch: float, y: float, cap: float
) -> _Line | None:
    """The largest line whose top is at the first row; None if there is no room."""
    first, last = np.maximum.accumulate(low), np.minimum.accumulate(high)
    heights = pitch * np.arange(len(low))
    scales = np.minimum(np.minimum((last - first) / size[0], heights / size[1]), cap)
    k = int(np.argmax(scales))
    if scales[k] <= 0:
        return None
    rows = int(np.ceil(scales[k] * size[1] / pitch - 1e-9))
    return _Line(float(scales[k]), float(first[k] + last[k]) / 2, y, rows)


def _fullest(
    lines: list[list[_Line | None]], sizes: FloatArray, gap: int
) -> tuple[float, list[tuple[int, _Line]]]:
    """Area of all words in the best order, and their lines from the top; no lines if none fits."""
    areas = sizes.prod(axis=1)

    @cache
    def best(left: int, row: int) -> tuple[float, int, int]:
        """Most area of the words that are left, from a row on; the row and word that come next."""
        if not left:
            return 0.0, row, -1
        if row >= ROWS:
            return -np.inf, row, -1
        found = (-np.inf, row, -1)
        for at in range(ROWS - 1, row - 1, -1) if row == 0 else (row,):
            for k, line in enumerate(lines[at]):
                if left >> k & 1 and line is not None:
                    area = areas[k] * line.scale**2
                    rest = best(left ^ 1 << k, at + line.rows + gap)[0]
                    found = max(found, (area + rest, at, k))
        return found

    left, row, found = (1 << len(sizes)) - 1, 0, []
    total = best(left, 0)[0]
    if not np.isfinite(total):
        return 0.0, []
    while left:
        _, at, k = best(left, row)
        line = lines[at][k]
        assert line is not None  # noqa: S101 - it was the best
        found.append((k, line))
        left, row = left ^ 1 << k, at + line.rows + gap
    return float(total), found
