"""Pixels of a coarse picture that a drawing's lines touch, however thin they are.

Renderers let slivers vanish that are thinner than a sixteenth of a pixel.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import BoolArray
from packwork.geometry import affine
from packwork.readers.svg.painted import Painted
from packwork.readers.svg.shapes import flattened_all

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
        for line, piece in zip(
            flattened_all(painted.pieces, tolerance), painted.pieces, strict=True
        ):
            ends = affine.apply(painted.matrix, line)
            if piece.is_closed or painted.painting.has_fill:
                ends = np.concatenate([ends, ends[:1]])
            if len(ends) < 2:
                continue
            along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(ends, axis=0).T))])
            at = np.linspace(0.0, along[-1], 2 + int(along[-1] / step))
            columns, rows = (
                ((np.interp(at, along, ends[:, k]) - part[k]) / px).astype(int) for k in (0, 1)
            )
            is_shown = (rows >= 0) & (rows < shape[0]) & (columns >= 0) & (columns < shape[1])
            found[rows[is_shown], columns[is_shown]] = True
    return found
