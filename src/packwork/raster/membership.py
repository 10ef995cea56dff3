"""Number of items that each pixel belongs to, judged by pixel centres."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from packwork.arrays import as_points, as_starts
from packwork.errors import ShapeError
from packwork.raster.kernels import membership as kernels


def centre_count(
    points_px: npt.ArrayLike, starts: npt.ArrayLike, shape: tuple[int, int]
) -> npt.NDArray[np.int32]:
    """Number of outlines that hold each pixel's centre; rings, in pixels, may leave the image.

    >>> square = [[0, 0], [2, 0], [2, 2], [0, 2]]
    >>> centre_count(square, [0, 4], (2, 3)).tolist()
    [[1, 1, 0], [1, 1, 0]]
    """
    points = as_points(points_px)
    if min(shape) < 1:
        raise ShapeError(f"an image needs at least one row and one column, not {shape}")
    counts = np.zeros((shape[0] + 1, shape[1]), dtype=np.int32)
    kernels.count_centres(points, as_starts(starts, len(points)), counts)
    return counts[:-1]
