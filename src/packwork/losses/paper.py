"""Losses as Wang and Lu 2025, section 3.3, have them (doi:10.1145/3721238.3730690)."""

from __future__ import annotations

import numpy as np

from packwork.arrays import Image
from packwork.fields.filters import box_mean
from packwork.losses.term import Term

OUTSIDE = 100.0
"""Weight of an error outside the container, against 1 inside (the paper's)."""


def paper_containment(density: Image, container: Image) -> Term:
    """Mean squared difference of covered and container, outside a hundred times dearer.

    Of images ``(rows, columns)``.

    Wang and Lu 2025, section 3.3. Inside, covered is min(density, 1), as black items on
    white compose; outside it is the density itself, so that coincident items there are
    still pushed back.

    Examples
    --------
    >>> term = paper_containment(np.array([[0.5, 2.0]]), np.array([[1.0, 0.0]]))
    >>> term.value, term.adjoint.tolist()
    (200.125, [[-0.5, 200.0]])
    """
    short = np.minimum(density - container, 1 - container)
    inside = container * short
    beyond = density * (1 - container)
    value = float(np.mean(inside * short)) + OUTSIDE * float(np.mean(beyond * density))
    free = density < 1
    adjoint = (2 / density.size) * (inside * free + OUTSIDE * beyond)
    return Term(value, adjoint.astype(density.dtype))


WINDOWS_PX = (5, 11, 17, 23, 29, 35)
"""Sides of the windows, pixels of the level: 5 px is a tenth of an image of 50 px (the
paper's)."""

WEIGHTS = (1, 2, 3, 4, 5, 6)
"""Weight of each window (the paper's code)."""

ALMOST_EMPTY = 0.999
"""Emptiness from which a window counts (the paper's code)."""

GAIN = 1_000.0
"""Factor on what is above that (the paper's code)."""


def paper_evenness(density: Image, container: Image) -> Term:
    """Share of windows that hold nothing but empty container, larger ones weighing more.

    Of images ``(rows, columns)``.

    Wang and Lu 2025, section 3.3: the empty space is dilated by kernels of growing size
    and only what is almost wholly empty is kept. A window that sticks out of the image
    or the container is not wholly empty container.

    Examples
    --------
    >>> empty, full = np.zeros((9, 9)), np.ones((9, 9))
    >>> paper_evenness(full, full).value, paper_evenness(empty, full).value > 0.1
    (0.0, True)
    """
    free = density < 1
    room = container * free
    empty = np.ascontiguousarray(room * (1 - density))
    total, by_empty = 0.0, np.zeros_like(empty)
    for size, weight in zip(WINDOWS_PX, WEIGHTS, strict=True):
        above = box_mean(empty, size) - ALMOST_EMPTY
        counts = above > 0
        if not counts.any():
            break  # A larger window is no emptier.
        total += weight * GAIN * float(above[counts].sum())
        by_empty += weight * GAIN * box_mean(counts.astype(empty.dtype), size)
    return Term(total / density.size, (-room * by_empty / density.size).astype(density.dtype))
