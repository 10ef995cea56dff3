"""Pixels of a coarse picture that edges of shapes pass through, however thin.

Renderers let slivers vanish that are thinner than a sixteenth of a pixel.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.geometry import affine
from packwork.readers.svg_syntax.painted import Painted
from packwork.readers.svg_syntax.shapes import flattened_all

MAX_STEPS = 4_000_000
"""Points along all lines that are looked up; of longer ones fewer. Chosen: a second's work."""

_STEP_PX = 0.5


def touched(
    shapes: Sequence[Painted], part: tuple[float, float, float, float], shape: tuple[int, ...]
) -> BoolArray:
    """Pixels that the edges of shapes pass through, clips passed over.

    Parameters
    ----------
    shapes
        In CSS pixels once placed.
    part
        Left, top, width and height of what the picture shows, in CSS pixels.
    shape
        Rows and columns of the picture.

    Examples
    --------
    >>> touched([], (0.0, 0.0, 4.0, 2.0), (2, 4)).tolist()
    [[False, False, False, False], [False, False, False, False]]
    """
    found = np.zeros(shape[:2], dtype=bool)
    px = max(part[2:]) / max(shape)
    length = sum(sum(painted.lengths) for painted in shapes)
    step = max(_STEP_PX * px, length / MAX_STEPS)
    for painted in shapes:
        if painted.window is not None and painted.window.is_empty:
            continue
        tolerance = px / max(np.abs(painted.matrix[:, :2]).max(), 1e-12)
        lines = flattened_all(painted.pieces, tolerance)
        has_fill = painted.painting.has_fill
        is_closed = np.array([has_fill or piece.is_closed for piece in painted.pieces])
        ends = _edges(painted.matrix, lines, is_closed)
        columns, rows = ((_along(ends, step) - part[:2]) / px).astype(int).T
        is_shown = (rows >= 0) & (rows < shape[0]) & (columns >= 0) & (columns < shape[1])
        found[rows[is_shown], columns[is_shown]] = True
    return found


def _edges(matrix: FloatArray, lines: Sequence[FloatArray], is_closed: BoolArray) -> FloatArray:
    """``(n, 2, 2)`` both ends of each edge; after an open line's last point, that point twice."""
    counts = np.array([len(line) for line in lines])
    is_line = counts >= np.where(is_closed, 1, 2)
    counts, is_closed = counts[is_line], is_closed[is_line]
    if len(counts) == 0:
        return np.empty((0, 2, 2))
    points = np.concatenate([line for line, is_one in zip(lines, is_line, strict=True) if is_one])
    last = np.cumsum(counts) - 1
    after = np.arange(1, len(points) + 1)
    after[last] = np.where(is_closed, last - counts + 1, last)
    placed = affine.apply(matrix, points)
    return np.stack([placed, placed[after]], axis=1)


def _along(ends: FloatArray, step: float) -> FloatArray:
    """Points along edges, a step apart at most, the first end of each among them."""
    counts = 1 + (np.hypot(*(ends[:, 1] - ends[:, 0]).T) / step).astype(int)
    edge = np.repeat(np.arange(len(ends)), counts)
    share = (np.arange(len(edge)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[edge]
    return np.asarray(ends[edge, 0] + share[:, None] * (ends[edge, 1] - ends[edge, 0]))
