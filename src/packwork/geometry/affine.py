"""Affine maps of the plane as 2 x 3 matrices.

``matrix @ (x, y, 1)`` maps a point, so the SVG ``matrix(a, b, c, d, e, f)`` is
``[[a, c, e], [b, d, f]]``.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray


def identity() -> FloatArray:
    """Map that leaves every point where it is.

    >>> identity().tolist()
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    """
    return np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def similarity(x: float, y: float, angle_rad: float, scale: float) -> FloatArray:
    """Map that scales, turns clockwise on screen, then moves to ``(x, y)``.

    >>> similarity(5, 7, 0.0, 2.0).tolist()
    [[2.0, -0.0, 5.0], [0.0, 2.0, 7.0]]
    """
    cosine, sine = scale * np.cos(angle_rad), scale * np.sin(angle_rad)
    return np.array([[cosine, -sine, x], [sine, cosine, y]])


def stretched(ratio: float) -> FloatArray:
    """Map that makes a square ``ratio`` times as wide as high; areas stay.

    >>> stretched(4.0).tolist()
    [[2.0, 0.0, 0.0], [0.0, 0.5, 0.0]]
    """
    root = np.sqrt(ratio)
    return np.array([[root, 0.0, 0.0], [0.0, 1.0 / root, 0.0]])


def mirrored() -> FloatArray:
    """Map that mirrors left to right.

    >>> apply(mirrored(), np.array([[2.0, 3.0]])).tolist()
    [[-2.0, 3.0]]
    """
    return np.array([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def compose(outer: FloatArray, inner: FloatArray) -> FloatArray:
    """Map (2 x 3) that does ``inner`` first and ``outer`` after it, in the unit of ``outer``.

    >>> compose(similarity(1, 0, 0, 1), similarity(0, 0, 0, 2)).tolist()
    [[2.0, 0.0, 1.0], [0.0, 2.0, 0.0]]
    """
    result = outer[:, :2] @ inner
    result[:, 2] += outer[:, 2]
    return result


def apply(matrix: FloatArray, points: FloatArray) -> FloatArray:
    """Images of ``(n, 2)`` points under the map.

    >>> apply(similarity(1, 2, 0.0, 3.0), np.array([[1.0, 1.0]])).tolist()
    [[4.0, 5.0]]
    """
    return np.asarray(points @ matrix[:, :2].T + matrix[:, 2])


def inverse(matrix: FloatArray) -> FloatArray:
    """Map (2 x 3) that undoes another, which must not flatten the plane.

    >>> inverse(similarity(4.0, 6.0, 0.0, 2.0)).tolist()
    [[0.5, 0.0, -2.0], [0.0, 0.5, -3.0]]
    """
    back = np.linalg.inv(matrix[:, :2])
    return np.column_stack([back, -back @ matrix[:, 2]])
