"""Box means of an image by running sums, at any size for the same price.

M. McDonnell, "Box-filtering techniques", Computer Graphics and Image Processing 17 (1981), 65-70.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import Image
from packwork.errors import ShapeError
from packwork.fields import _kernels


def box_mean(image: Image, size: int) -> Image:
    """Mean over the square of ``size`` pixels centred on each pixel; zero off the image.

    Linear and its own adjoint, so it also carries derivatives back.

    Parameters
    ----------
    image
        ``(rows, columns)``, float32 or float64, contiguous.
    size
        Odd, at least 1.

    Raises
    ------
    ShapeError
        If the size is even or below 1.

    Examples
    --------
    >>> box_mean(np.array([[0.0, 9.0, 0.0]]), 3).tolist()
    [[1.0, 1.0, 1.0]]
    """
    if size < 1 or size % 2 == 0:
        raise ShapeError(f"a box must have an odd size of at least 1 px, not {size}")
    across = np.empty_like(image)
    result = np.empty_like(image)
    _kernels.box_sum_across(image, size // 2, across)
    _kernels.box_sum_down(across, size // 2, 1.0 / (size * size), result)
    return result
