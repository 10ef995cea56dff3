"""Large empty places cost more than many small ones."""

from __future__ import annotations

import numpy as np

from packwork.arrays import Image
from packwork.fields.boxes import box_mean
from packwork.losses.term import Term

WINDOWS = (0.02, 0.03, 0.045)
"""Sides of the windows, as shares of the image's longer side: about the gaps that an eye
notices between a hundred items. Larger ones even out whole regions. Tried."""

SHARPNESS = 8
"""Power of a window's emptiness: 1 would be a plain reward for coverage, larger looks at
nothing but windows that are almost wholly empty. Tried."""

COARSE_PX = 150
"""Longer side of the image that the windows slide over; finer is slower. Tried."""


def evenness(density: Image, container: Image) -> Term:
    """Mean emptiness of windows of growing size, to a high power.

    Wang and Lu 2025, section 3.3 (the uniform loss), keep only windows whose mean
    emptiness is above 0.999; the power is a smooth form of that. Windows are means over
    boxes at reduced resolution, so they cost the same at any size, and the derivative
    is carried back by the same boxes.

    Examples
    --------
    >>> empty, full = np.zeros((9, 9)), np.ones((9, 9))
    >>> evenness(full, full).value, evenness(empty, full).value > 0.1
    (0.0, True)
    """
    factor = max(1, max(density.shape) // COARSE_PX)
    rows, columns = (side // factor * factor for side in density.shape)
    is_free = density[:rows, :columns] < 1
    room = container[:rows, :columns] * is_free
    emptiness = _blocks(room * (1 - density[:rows, :columns]), factor)
    value, by_emptiness = 0.0, np.zeros_like(emptiness)
    for share in WINDOWS:
        size = int(share * max(emptiness.shape)) // 2 * 2 + 1
        mean = box_mean(emptiness, size)
        value += float(np.mean(mean**SHARPNESS)) / len(WINDOWS)
        steepness = (SHARPNESS / len(WINDOWS) / emptiness.size) * mean ** (SHARPNESS - 1)
        by_emptiness += box_mean(steepness, size)
    adjoint = np.zeros_like(density)
    spread = by_emptiness.repeat(factor, axis=0).repeat(factor, axis=1)
    adjoint[:rows, :columns] = -room * spread / factor**2
    return Term(value, adjoint)


def _blocks(image: Image, factor: int) -> Image:
    """Means over squares of ``factor`` pixels."""
    rows, columns = image.shape
    blocks = image.reshape(rows // factor, factor, columns // factor, factor)
    return np.ascontiguousarray(blocks.mean(axis=(1, 3)))
