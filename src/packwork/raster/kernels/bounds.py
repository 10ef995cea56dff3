"""Bounds of rings in an image, and the longest record of their walk."""

from __future__ import annotations

from packwork.compiled import kernel


@kernel
def record_bounds(points, starts, height, width, rows, bounds):
    """Write the first and the last row of each ring, and how long its record is at most.

    ``rows``: ``(rings, 2)``, on the canvas; ``bounds``: ``(rings,)``. A walk crosses a grid line
    once for each pixel it spans; eight cover cuts and rounding of an edge. Returns their sum.
    """
    total = 0.0
    for ring in range(starts.shape[0] - 1):
        begin, end = starts[ring], starts[ring + 1]
        top, bottom, spanned = float(height), 0.0, 0.0
        if end > begin:
            last_x = min(max(points[end - 1, 0], 0.0), float(width))
            last_y = min(max(points[end - 1, 1], 0.0), float(height))
        for v in range(begin, end):
            x = min(max(points[v, 0], 0.0), float(width))
            y = min(max(points[v, 1], 0.0), float(height))
            spanned += abs(x - last_x) + abs(y - last_y)
            top, bottom = min(top, y), max(bottom, y)
            last_x, last_y = x, y
        rows[ring, 0], rows[ring, 1] = int(top), int(bottom)
        bounds[ring] = int(spanned) + 8 * (end - begin) + 1
        total += bounds[ring]
    return total
