"""A glyph's curves: as points, as flattened rings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.bezier import flatten_cubic
from packwork.readers.fonts.face import Segment


def points_of(segment: Segment) -> FloatArray:
    """``(k, 2)`` points of a segment.

    Examples
    --------
    >>> points_of(("L", (1.0, 2.0))).tolist()
    [[1.0, 2.0]]
    """
    return np.array(segment[1], dtype=np.float64).reshape(-1, 2)


def rings_of(segments: Sequence[Segment], tolerance: float) -> list[FloatArray]:
    """Contours as rings whose chords lie within ``tolerance`` of the curves.

    Examples
    --------
    >>> rings_of([("M", (0.0, 0.0)), ("L", (2.0, 0.0)), ("L", (2.0, 1.0)), ("Z", ())], 0.1)
    [array([[0., 0.],
           [2., 0.],
           [2., 1.]])]
    """
    rings: list[list[FloatArray]] = []
    for segment in segments:
        letter, points = segment[0], points_of(segment)
        if letter == "M":
            rings.append([points])
        elif letter == "L":
            rings[-1].append(points)
        elif letter in {"Q", "C"}:
            start = rings[-1][-1][-1]
            rings[-1].append(flatten_cubic(start, *_cubic(start, points), tolerance))
    return [np.concatenate(ring) for ring in rings]


def _cubic(start: FloatArray, points: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Handles and end of a curve as a cubic's."""
    if len(points) == 3:
        return points[0], points[1], points[2]
    handle, end = points
    return (start + 2 * handle) / 3, (end + 2 * handle) / 3, end
