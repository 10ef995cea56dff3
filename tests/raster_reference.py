"""The renderer's slow, obvious twin: polygon clipping pixel by pixel.

For tests only. It also composites truly (translucent items over each other), to bound
what the sum of coverages leaves out.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from packwork.arrays import FloatArray, Image


def clipped_area(ring: FloatArray, col: int, row: int) -> float:
    """Signed area of a ring inside pixel ``(row, col)``, by clipping to four lines.

    Sutherland and Hodgman, "Reentrant polygon clipping" (1974).

    Examples
    --------
    >>> clipped_area(np.array([[0, 0], [2, 0], [2, 0.5], [0, 0.5]]), 1, 0)
    0.5
    """
    points = [(float(x), float(y)) for x, y in ring]
    for axis, bound, sign in [(0, col, 1), (0, col + 1, -1), (1, row, 1), (1, row + 1, -1)]:
        clipped: list[tuple[float, float]] = []
        for a, b in zip(points, points[1:] + points[:1], strict=True):
            a_in = sign * (a[axis] - bound) >= 0
            b_in = sign * (b[axis] - bound) >= 0
            if a_in:
                clipped.append(a)
            if a_in != b_in:
                u = (bound - a[axis]) / (b[axis] - a[axis])
                clipped.append((a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1])))
        points = clipped
        if not points:
            return 0.0
    return 0.5 * sum(
        a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1], strict=True)
    )


def coverage_image(ring: FloatArray, shape: tuple[int, int]) -> Image:
    """Coverage of every pixel by one ring.

    Examples
    --------
    >>> coverage_image(np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]), (1, 2)).tolist()
    [[1.0, 0.0]]
    """
    return np.array(
        [[clipped_area(ring, col, row) for col in range(shape[1])] for row in range(shape[0])]
    )


def composite(coverages: Sequence[Image], opacity: float) -> Image:
    """Opacity of translucent layers over each other: 1 - prod(1 - opacity * c).

    Wang and Lu 2025, section 3.2, draw all items so; on 0/1 coverages, opacity one,
    it equals min(S, 1).

    Examples
    --------
    >>> composite([np.array([[1.0, 0.5]]), np.array([[1.0, 0.5]])], 1.0).tolist()
    [[1.0, 0.75]]
    """
    clear = np.ones_like(coverages[0])
    for image in coverages:
        clear = clear * (1 - opacity * image)
    return np.asarray(1 - clear)


def colour_image(
    rings: Sequence[FloatArray],
    colours: FloatArray,
    background: FloatArray,
    shape: tuple[int, int],
) -> Image:
    """Colours mixed by coverage, ring by ring, pixel by pixel.

    Examples
    --------
    >>> ring = np.array([[0, 0], [1.5, 0], [1.5, 1], [0, 1.0]])
    >>> colour_image([ring], np.array([[3.0]]), np.array([1.0]), (1, 2))[0, :, 0].tolist()
    [3.0, 2.0]
    """
    image = np.tile(background, (*shape, 1))
    for ring, colour in zip(rings, colours, strict=True):
        image += coverage_image(ring, shape)[..., None] * (colour - background)
    return image
