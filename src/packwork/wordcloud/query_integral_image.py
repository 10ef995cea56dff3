"""Free places of a box in an integral image, under the other package's name."""

from __future__ import annotations

from random import Random
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["query_integral_image"]


def query_integral_image(
    integral_image: npt.NDArray[Any], size_x: int, size_y: int, random_state: Random
) -> tuple[int, int] | None:
    """Row and column of a place, drawn at random, at which a box covers nothing.

    Parameters
    ----------
    integral_image
        ``(rows, columns)``, running sums of an image down and to the right.
    size_x, size_y
        Rows and columns of the box.
    random_state
        Draws the place; one seed, one place.

    Returns
    -------
    tuple of int or None
        The pixel above and left of the box; None where there is no such place.

    Examples
    --------
    >>> image = np.cumsum(np.cumsum(np.pad([[1]], 2), axis=0), axis=1)
    >>> query_integral_image(image, 1, 1, Random(0)) != (1, 1)
    True
    >>> query_integral_image(image, 3, 3, Random(0)) is None
    True
    """
    sums = np.asarray(integral_image, dtype=np.int64)
    rows, columns = max(0, sums.shape[0] - size_x), max(0, sums.shape[1] - size_y)
    before, after = sums[:rows, :columns], sums[size_x:, size_y:]
    covered = before + after - sums[size_x:, :columns] - sums[:rows, size_y:]
    free = np.flatnonzero(covered == 0)
    if len(free) == 0:
        return None
    # Counted from 1 in a draw from 0, as there; 0 is the first too, where there it is no place.
    chosen = int(free[max(random_state.randint(0, len(free)), 1) - 1])
    return chosen // columns, chosen % columns
