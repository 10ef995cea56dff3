"""White patches enclosed by a dark shape on clear ground, as holes."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.readers.pictures.decode import Pixels

LEAST_WHITE = 240
"""Each channel of white, of 255, at least, in pictures and of sheets behind SVGs. Smaller takes
pale tiles for paper, larger keeps ivory paper. Chosen."""

MOST_WHITE = 1 / 3
"""Share of what is painted that white patches are holes up to. More are the body of a drawing
in outlines. Chosen."""


def without_enclosed_white(pixels: Pixels, solid: FloatArray) -> FloatArray:
    """Opacities, those of white patches that other paint surrounds brought to nothing.

    Parameters
    ----------
    pixels
        RGBA.
    solid
        Their opacities, 0..1.

    Examples
    --------
    >>> seal = np.zeros((9, 9, 4), np.uint8); seal[1:8, 1:8, 3] = 255; seal[4, 4, :3] = 255
    >>> float(without_enclosed_white(seal, seal[:, :, 3] / 255).sum())
    48.0
    """
    from scipy.ndimage import binary_dilation, label, maximum_filter

    least = pixels[:, :, :3].min(axis=2)
    painted = solid >= 0.5
    white = painted & (least >= LEAST_WHITE)
    if not white.any():
        return solid
    labels, count = label(white, np.ones((3, 3)))
    beside = np.pad(~painted, 1, constant_values=True)
    near_clear = binary_dilation(beside, np.ones((3, 3)))[1:-1, 1:-1]
    is_open = np.zeros(count + 1, dtype=bool)
    is_open[np.unique(labels[near_clear])] = True
    holes = white & ~is_open[labels]
    if not 0 < np.count_nonzero(holes) <= MOST_WHITE * np.count_nonzero(painted):
        return solid
    result = np.where(holes, 0.0, solid)
    # The pixels of the edge mix white and the paint beside it.
    edge = binary_dilation(holes, np.ones((3, 3))) & ~holes
    distance = 255.0 - least
    result[edge] *= distance[edge] / np.maximum(maximum_filter(distance, 3)[edge], 1.0)
    return result
