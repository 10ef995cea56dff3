"""Compiled loop that counts centres inside rings."""

from __future__ import annotations

from packwork.compiled import kernel


@kernel
def count_centres(points, starts, counts):
    """Add, for each pixel, the winding of all rings round its centre.

    ``counts`` has one row more than the image: differences down the columns, and all zero before,
    of which running sums are made. A boundary through a centre counts the item below and to the
    right of it.
    """
    height = counts.shape[0] - 1
    width = counts.shape[1]
    for ring in range(starts.shape[0] - 1):
        begin = starts[ring]
        end = starts[ring + 1]
        for v in range(begin, end):
            w = v + 1 if v + 1 < end else begin
            sign = 1
            a = v
            b = w
            if points[w, 0] < points[v, 0]:
                sign = -1
                a = w
                b = v
            left = points[a, 0] - 0.5
            right = points[b, 0] - 0.5
            if right <= 0.0 or left >= width or left == right:
                continue
            column = max(int(left), 0)
            if column < left:
                column += 1
            slope = (points[b, 1] - points[a, 1]) / (points[b, 0] - points[a, 0])
            while column < width and column < right:
                y = points[a, 1] + slope * (column - left) - 0.5
                row = 0
                if y >= height:
                    row = height
                elif y > 0.0:
                    row = int(y)
                    if row < y:
                        row += 1
                counts[row, column] += sign
                column += 1
    # Row by row: down single columns takes ten times as long.
    for row in range(1, height):
        for column in range(width):
            counts[row, column] += counts[row - 1, column]
