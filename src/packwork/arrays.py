"""Array aliases and the checks that stand before the kernels.

Conventions (docs/reference/units.md): y points down; points are ``(x, y)``,
images ``[row, col]``; pixel ``(row, col)`` is the square
``[col, col + 1] x [row, row + 1]``; positive area is clockwise on screen.
"""

from __future__ import annotations

from typing import Any, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from packwork.errors import ShapeError

Kind = TypeVar("Kind", bound=np.generic)
FloatArray: TypeAlias = npt.NDArray[np.float64]
IntArray: TypeAlias = npt.NDArray[np.int64]
BoolArray: TypeAlias = npt.NDArray[np.bool_]
Image: TypeAlias = npt.NDArray[np.floating[Any]]
"""A picture of one number per pixel, float32 or float64, ``[row, col]``."""


def as_points(points: npt.ArrayLike) -> FloatArray:
    """Contiguous float64 copy (or view) of an (n, 2) array of finite points.

    Examples
    --------
    >>> as_points([[0, 0], [1, 2]]).dtype
    dtype('float64')
    """
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 2:
        raise ShapeError(f"points must have shape (n, 2), not {array.shape}")
    if not np.isfinite(array).all():
        raise ShapeError("points must be finite numbers; some are NaN or infinite")
    return array


def as_starts(starts: npt.ArrayLike, point_count: int) -> IntArray:
    """Ring starts ``(rings + 1,)``: increasing indices from 0 to ``point_count``.

    Examples
    --------
    >>> as_starts([0, 3, 7], 7).tolist()
    [0, 3, 7]
    """
    array = np.ascontiguousarray(starts, dtype=np.int64)
    if array.ndim != 1 or array.size == 0 or array[0] != 0 or array[-1] != point_count:
        raise ShapeError(
            f"ring starts must be a list from 0 to the number of points ({point_count}), "
            f"not {array.tolist()[:6]}"
        )
    if (array[1:] < array[:-1]).any():
        raise ShapeError("ring starts must not decrease")
    return array


def as_image(image: npt.ArrayLike) -> Image:
    """Contiguous float image ``(rows, columns)``; float32 stays, all else becomes float64.

    Examples
    --------
    >>> as_image([[0, 1]]).dtype
    dtype('float64')
    """
    array = np.asarray(image)
    if array.ndim != 2 or array.size == 0:
        raise ShapeError(f"an image must have shape (rows, columns), not {array.shape}")
    dtype = np.float32 if array.dtype == np.float32 else np.float64
    return np.ascontiguousarray(array, dtype=dtype)


def frozen(array: npt.NDArray[Kind]) -> npt.NDArray[Kind]:
    """The array itself, if nobody can change it; else a copy of that kind."""
    if not array.flags.writeable:
        return array
    copied = np.array(array)
    copied.flags.writeable = False
    return copied
