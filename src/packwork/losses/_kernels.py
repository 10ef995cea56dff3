"""The built-in losses in one pass over the image."""

from __future__ import annotations

import math

from numba import njit


@njit(cache=True, nogil=True, error_model="numpy")
def linear_adjoint(buffer, container, running, adjoint, outside, excess, reward, one):
    """Running sum, clearing and the adjoint of containment, overlap and filling at once.

    ``buffer`` is the accumulation buffer (one row more than the image), ``running`` one
    row of scratch; ``one`` is the density above which a pixel is covered twice. All
    weights have the images' dtype, so that the loop stays in it.
    """
    height = adjoint.shape[0]
    width = adjoint.shape[1]
    for c in range(width):
        running[c] = 0.0
    for r in range(height):
        for c in range(width):
            density = running[c] + buffer[r, c]
            running[c] = density
            buffer[r, c] = 0.0
            inside = container[r, c]
            base = outside - outside * inside
            adjoint[r, c] = base + (excess if density > one else -reward * inside)
    for c in range(width):
        buffer[height, c] = 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def recall(x, y, areas, px_per_cu, inside, nearest_row, nearest_column, by_x, by_y):
    """Area-weighted distance, in pixels, of each centre from the container.

    ``by_x`` and ``by_y`` receive its derivative; returns the sum.
    """
    rows = inside.shape[0]
    columns = inside.shape[1]
    total = 0.0
    for i in range(x.shape[0]):
        x_px = x[i] * px_per_cu
        y_px = y[i] * px_per_cu
        column = int(min(max(x_px, 0.0), columns - 1.0))
        row = int(min(max(y_px, 0.0), rows - 1.0))
        by_x[i] = 0.0
        by_y[i] = 0.0
        if inside[row, column] and 0.0 <= x_px < columns and 0.0 <= y_px < rows:
            continue
        away_x = x_px - nearest_column[row, column] - 0.5
        away_y = y_px - nearest_row[row, column] - 0.5
        distance = math.sqrt(away_x * away_x + away_y * away_y)
        if distance > 0.0:
            by_x[i] = areas[i] * away_x / distance
            by_y[i] = areas[i] * away_y / distance
            total += areas[i] * distance
    return total
